// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/nmea_sentence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace lodesman::emulated {
namespace {

constexpr double kKnot_m_s = 1852.0 / 3600.0;
constexpr double kKilometreAnHour_m_s = 1000.0 / 3600.0;

template <class... Values>
[[nodiscard]] std::string printed(const char* format, Values... values) {
  std::array<char, 96> text{};
  const int size = std::snprintf(text.data(), text.size(), format, values...);
  return {text.data(), static_cast<std::size_t>(std::clamp(size, 0, 95))};
}

[[nodiscard]] std::string whole(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) {
    sum ^= static_cast<unsigned char>(c);
  }
  return "$" + body + printed("*%02X\r\n", sum);
}

[[nodiscard]] std::string clock_of(const CivilTime& time) {
  return printed("%02d%02d%02d.%02d", time.hour, time.minute, time.second, time.millisecond / 10);
}

// "3501.6320": degrees in so many digits, minutes in two and their decimals. Counted in whole
// units of the last decimal, so that 59.99999 minutes never become 60.
[[nodiscard]] std::string angle(double deg, int degree_digits, int decimals) {
  std::int64_t unit = 1;
  for (int i = 0; i < decimals; ++i) {
    unit *= 10;
  }
  const std::int64_t count = std::llround(std::abs(deg) * 60.0 * static_cast<double>(unit));
  return printed("%0*d%02d.%0*d", degree_digits, static_cast<int>(count / (60 * unit)),
                 static_cast<int>(count / unit % 60), decimals, static_cast<int>(count % unit));
}

// "3501.6320,N,13854.0000,E"; without a fix the commas alone.
[[nodiscard]] std::string place_of(const NmeaFix& fix, const NmeaManner& manner) {
  if (fix.quality == NmeaQuality::kNone) {
    return ",,,";
  }
  return angle(fix.latitude_deg, 2, manner.minute_decimals) +
         (fix.latitude_deg < 0.0 ? ",S," : ",N,") +
         angle(fix.longitude_deg, 3, manner.minute_decimals) +
         (fix.longitude_deg < 0.0 ? ",W" : ",E");
}

// A direction that rounds to 360 is 0.
[[nodiscard]] double direction_deg(double deg) noexcept {
  const double within = std::fmod(deg + 720.0, 360.0);
  return within >= 359.95 ? 0.0 : within;
}

[[nodiscard]] bool has_fix(const NmeaFix& fix) noexcept {
  return fix.quality != NmeaQuality::kNone;
}

// N: none, A: by itself; later versions tell RTK apart too.
[[nodiscard]] char mode_of(const NmeaFix& fix) noexcept {
  switch (fix.quality) {
    case NmeaQuality::kNone: return 'N';
    case NmeaQuality::kRtkFixed: return 'R';
    case NmeaQuality::kRtkFloat: return 'F';
    case NmeaQuality::kOrdinary: break;
  }
  return 'A';
}

[[nodiscard]] std::string begin_of(const NmeaManner& manner, const char* type) {
  return std::string{manner.talker} + type + ",";
}

}  // namespace

std::string gga(const NmeaFix& fix, const NmeaManner& manner) {
  std::string body = begin_of(manner, "GGA") + clock_of(fix.time) + "," + place_of(fix, manner);
  if (!has_fix(fix)) {
    return whole(body + ",0,00,,,M,,M,,");
  }
  body += printed(",%d,%02d,%.1f,%.1f,M,%.1f,M,,", static_cast<int>(fix.quality), fix.satellites,
                  fix.hdop, fix.altitude_m, fix.geoid_m);
  return whole(body);
}

std::string rmc(const NmeaFix& fix, const NmeaManner& manner) {
  std::string body = begin_of(manner, "RMC") + clock_of(fix.time) + (has_fix(fix) ? ",A," : ",V,") +
                     place_of(fix, manner) + ",";
  if (has_fix(fix)) {
    body += printed("%.3f", fix.speed_m_s / kKnot_m_s);
  }
  body += ",";
  if (has_fix(fix) && fix.course_deg) {
    body += printed("%05.1f", direction_deg(*fix.course_deg));
  }
  body += printed(",%02d%02d%02d,", fix.time.day, fix.time.month, fix.time.year % 100);
  if (has_fix(fix) && fix.variation_deg) {
    body +=
        printed("%05.1f,%c", std::abs(*fix.variation_deg), *fix.variation_deg < 0.0 ? 'W' : 'E');
  } else {
    body += ",";
  }
  return whole(body + "," + mode_of(fix));
}

std::string vtg(const NmeaFix& fix, const NmeaManner& manner) {
  std::string body = begin_of(manner, "VTG");
  if (!has_fix(fix)) {
    return whole(body + ",T,,M,,N,,K,N");
  }
  if (fix.course_deg) {
    body += printed("%05.1f", direction_deg(*fix.course_deg));
  }
  body += ",T,";
  if (fix.course_deg && fix.variation_deg) {
    body += printed("%05.1f", direction_deg(*fix.course_deg - *fix.variation_deg));
  }
  body += printed(",M,%.3f,N,%.3f,K,%c", fix.speed_m_s / kKnot_m_s,
                  fix.speed_m_s / kKilometreAnHour_m_s, mode_of(fix));
  return whole(body);
}

std::string hdt(const NmeaFix& fix, const NmeaManner& manner) {
  return whole(begin_of(manner, "HDT") + printed("%06.2f,T", fix.heading_deg));
}

std::size_t sum_at(std::string_view sentence) noexcept {
  return std::min(sentence.rfind('*'), sentence.size());
}

}  // namespace lodesman::emulated
