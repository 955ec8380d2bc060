// SPDX-License-Identifier: Apache-2.0
// The fields of one NMEA sentence, taken one after another. Each gives its value, nothing where it
// is empty or the sentence has ended, and notes what cannot be: then the sentence is not sound. One
// thread; nothing allocates.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "drivers/nmea/sentences.h"

namespace lodesman::nmea {

class Fields {
 public:
  // From the field behind the address on.
  explicit Fields(std::string_view sentence) noexcept;

  [[nodiscard]] bool sound() const noexcept { return sound_; }

  [[nodiscard]] std::optional<double> number(double least, double most) noexcept;
  [[nodiscard]] std::optional<int> count(int most) noexcept;
  // One of these letters; '\0' where it is empty.
  [[nodiscard]] char letter(std::string_view of) noexcept;

  [[nodiscard]] std::optional<Duration> time_of_day() noexcept;  // hhmmss[.s...]
  [[nodiscard]] std::optional<std::int64_t> date_ns() noexcept;  // ddmmyy, of its midnight
  [[nodiscard]] std::optional<Place> place() noexcept;           // four fields
  [[nodiscard]] std::optional<double> knots() noexcept;          // [m/s]
  [[nodiscard]] std::optional<double> course_rad() noexcept;     // degrees from 0 to 360
  [[nodiscard]] std::optional<double> east_rad() noexcept;       // degrees, and E or W

 private:
  [[nodiscard]] std::string_view next() noexcept;
  // Degrees and minutes, so many digits of degrees in front of two of minutes.
  [[nodiscard]] std::optional<double> angle_deg(std::size_t degree_digits, double most) noexcept;
  void require(bool sound) noexcept { sound_ = sound_ && sound; }

  std::string_view left_;
  bool ended_ = false;
  bool sound_ = true;
};

}  // namespace lodesman::nmea
