// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mid_level/base/heading.h"

namespace lodesman::nmea {
namespace {

constexpr double kKnot_m_s = 1852.0 / 3600.0;
constexpr int kPivotYear = 70;  // 70 to 99 are of the last century

[[nodiscard]] bool is_digit(char letter) noexcept { return letter >= '0' && letter <= '9'; }

[[nodiscard]] bool all_digits(std::string_view text) noexcept {
  return std::all_of(text.begin(), text.end(), is_digit);
}

// A sign, digits, a point, digits: nothing else that some library takes for a number.
[[nodiscard]] std::optional<double> parsed(std::string_view text) noexcept {
  const bool is_plain = std::all_of(text.begin(), text.end(), [](char letter) {
    return is_digit(letter) || letter == '.' || letter == '-';
  });
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return is_plain && whole && std::isfinite(value) ? std::optional{value} : std::nullopt;
}

// Digits alone, at most nine of them.
[[nodiscard]] int whole(std::string_view digits) noexcept {
  int value = 0;
  for (const char digit : digits) {
    value = 10 * value + (digit - '0');
  }
  return value;
}

}  // namespace

Fields::Fields(std::string_view sentence) noexcept : left_{sentence} {
  static_cast<void>(next());  // the address
}

std::string_view Fields::next() noexcept {
  if (ended_) {
    return {};
  }
  const std::size_t end = left_.find(',');
  const std::string_view field = left_.substr(0, end);
  ended_ = end == std::string_view::npos;
  left_.remove_prefix(ended_ ? left_.size() : end + 1);
  return field;
}

std::optional<double> Fields::number(double least, double most) noexcept {
  const std::string_view text = next();
  if (text.empty()) {
    return std::nullopt;
  }
  const std::optional<double> value = parsed(text);
  require(value && *value >= least && *value <= most);
  return value;
}

std::optional<int> Fields::count(int most) noexcept {
  const std::string_view text = next();
  if (text.empty()) {
    return std::nullopt;
  }
  const bool fits = text.size() <= 4 && all_digits(text);
  require(fits && whole(text) <= most);
  return fits ? std::optional{whole(text)} : std::nullopt;
}

char Fields::letter(std::string_view of) noexcept {
  const std::string_view text = next();
  if (text.empty()) {
    return '\0';
  }
  require(text.size() == 1 && of.find(text[0]) != std::string_view::npos);
  return text[0];
}

std::optional<Duration> Fields::time_of_day() noexcept {
  const std::string_view text = next();
  if (text.empty()) {
    return std::nullopt;
  }
  const bool shaped = text.size() >= 6 && text.size() <= 16 && all_digits(text.substr(0, 6)) &&
                      (text.size() == 6 || (text[6] == '.' && all_digits(text.substr(7))));
  require(shaped);
  if (!shaped) {
    return std::nullopt;
  }
  const int hours = whole(text.substr(0, 2));
  const int minutes = whole(text.substr(2, 2));
  // 60 in a leap second.
  require(hours < 24 && minutes < 60 && whole(text.substr(4, 2)) <= 60);
  const double seconds = parsed(text.substr(4)).value_or(0.0);
  return std::chrono::hours{hours} + std::chrono::minutes{minutes} + from_seconds(seconds);
}

std::optional<std::int64_t> Fields::date_ns() noexcept {
  const std::string_view text = next();
  if (text.empty()) {
    return std::nullopt;
  }
  const bool shaped = text.size() == 6 && all_digits(text);
  require(shaped);
  if (!shaped) {
    return std::nullopt;
  }
  const int year = whole(text.substr(4, 2));
  const std::chrono::year_month_day date{
      std::chrono::year{year + (year < kPivotYear ? 2000 : 1900)},
      std::chrono::month{static_cast<unsigned>(whole(text.substr(2, 2)))},
      std::chrono::day{static_cast<unsigned>(whole(text.substr(0, 2)))}};
  require(date.ok());
  if (!date.ok()) {
    return std::nullopt;
  }
  const Duration since = std::chrono::sys_days{date}.time_since_epoch();
  return since.count();
}

std::optional<double> Fields::angle_deg(std::size_t degree_digits, double most) noexcept {
  const std::string_view text = next();
  if (text.empty()) {
    return std::nullopt;
  }
  const std::size_t whole_digits = degree_digits + 2;
  const bool shaped = text.size() >= whole_digits && all_digits(text.substr(0, whole_digits)) &&
                      (text.size() == whole_digits || text[whole_digits] == '.');
  const std::optional<double> minutes = shaped ? parsed(text.substr(degree_digits)) : std::nullopt;
  require(minutes && *minutes < 60.0);
  if (!minutes) {
    return std::nullopt;
  }
  const double deg = whole(text.substr(0, degree_digits)) + *minutes / 60.0;
  require(deg <= most);
  return deg;
}

std::optional<Place> Fields::place() noexcept {
  const std::optional<double> latitude_deg = angle_deg(2, 90.0);
  const char north = letter("NS");
  const std::optional<double> longitude_deg = angle_deg(3, 180.0);
  const char east = letter("EW");
  if (!latitude_deg || !longitude_deg || north == '\0' || east == '\0') {
    return std::nullopt;
  }
  return Place{north == 'S' ? -*latitude_deg : *latitude_deg,
               east == 'W' ? -*longitude_deg : *longitude_deg};
}

std::optional<double> Fields::knots() noexcept {
  const std::optional<double> value = number(0.0, 1900.0);
  return value ? std::optional{*value * kKnot_m_s} : std::nullopt;
}

std::optional<double> Fields::course_rad() noexcept {
  const std::optional<double> deg = number(0.0, 360.0);
  return deg ? std::optional{wrap_to_pi(to_rad(*deg))} : std::nullopt;
}

std::optional<double> Fields::east_rad() noexcept {
  const std::optional<double> deg = number(-180.0, 180.0);
  const char side = letter("EW");
  if (!deg || side == '\0') {
    return std::nullopt;
  }
  return to_rad(side == 'W' ? -*deg : *deg);
}

}  // namespace lodesman::nmea
