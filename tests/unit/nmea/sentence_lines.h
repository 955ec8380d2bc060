// SPDX-License-Identifier: Apache-2.0
// Sentences of a receiver as it writes them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace lodesman::testing {

// A line with its checksum and its end; the sum is counted here on its own.
[[nodiscard]] inline std::string line_of(const std::string& sentence) {
  unsigned sum = 0;
  for (std::size_t i = 1; i < sentence.size(); ++i) {
    sum ^= static_cast<unsigned char>(sentence[i]);
  }
  return fmt::format("{}*{:02X}\r\n", sentence, sum);
}

// 1 to 9 digits of hhmmss.ss, from a second of the day.
[[nodiscard]] inline std::string clock_of(double second_of_day) {
  const double wrapped = std::fmod(second_of_day, 86400.0);
  const int whole = static_cast<int>(wrapped);
  return fmt::format("{:02}{:02}{:05.2f}", whole / 3600, whole / 60 % 60,
                     wrapped - whole / 60 * 60);
}

struct Fixed {
  double second_of_day = 45300.0;
  double latitude_minutes = 1.632;  // north of 35
  double longitude_minutes = 54.0;  // east of 138
  int quality = 1;
  double hdop = 0.9;
  double knots = 0.972;
  std::string date = "211126";
  char status = 'A';
};

[[nodiscard]] inline std::string rmc_line(const Fixed& fix) {
  return line_of(fmt::format("$GPRMC,{},{},35{:07.4f},N,138{:07.4f},E,{:.3f},054.7,{},007.6,W,A",
                             clock_of(fix.second_of_day), fix.status, fix.latitude_minutes,
                             fix.longitude_minutes, fix.knots, fix.date));
}
[[nodiscard]] inline std::string gga_line(const Fixed& fix) {
  return line_of(fmt::format("$GPGGA,{},35{:07.4f},N,138{:07.4f},E,{},08,{:.1f},12.4,M,39.7,M,,",
                             clock_of(fix.second_of_day), fix.latitude_minutes,
                             fix.longitude_minutes, fix.quality, fix.hdop));
}

}  // namespace lodesman::testing
