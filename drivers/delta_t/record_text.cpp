// SPDX-License-Identifier: Apache-2.0
// The texts of a record's header: its place and its time.
#include <array>
#include <chrono>

#include "drivers/delta_t/record.h"

namespace lodesman::delta_t {
namespace {

constexpr std::array<std::string_view, 12> kMonths{"JAN", "FEB", "MAR", "APR", "MAY", "JUN",
                                                   "JUL", "AUG", "SEP", "OCT", "NOV", "DEC"};

// Takes digits from the front; nothing where there are none, or more than fit.
[[nodiscard]] std::optional<int> take_number(std::string_view& text) noexcept {
  constexpr std::size_t kMostDigits = 6;
  std::size_t count = 0;
  int number = 0;
  while (count < text.size() && text[count] >= '0' && text[count] <= '9' && count < kMostDigits) {
    number = 10 * number + (text[count] - '0');
    ++count;
  }
  text.remove_prefix(count);
  return count > 0 ? std::optional{number} : std::nullopt;
}

[[nodiscard]] bool take(std::string_view& text, char expected) noexcept {
  if (text.empty() || text.front() != expected) {
    return false;
  }
  text.remove_prefix(1);
  return true;
}

// ".25" is a quarter.
[[nodiscard]] std::optional<double> take_fraction(std::string_view& text) noexcept {
  if (!take(text, '.')) {
    return std::nullopt;
  }
  const std::size_t before = text.size();
  const std::optional<int> number = take_number(text);
  if (!number) {
    return std::nullopt;
  }
  double fraction = *number;
  for (std::size_t digits = before - text.size(); digits > 0; --digits) {
    fraction /= 10.0;
  }
  return fraction;
}

[[nodiscard]] std::optional<std::chrono::sys_days> day_of(std::string_view text) noexcept {
  const std::optional<int> day = take_number(text);
  if (!day || !take(text, '-') || text.size() < 4) {
    return std::nullopt;
  }
  unsigned month = 1;
  while (month <= kMonths.size() && !text.starts_with(kMonths[month - 1])) {
    ++month;
  }
  text.remove_prefix(3);
  const std::optional<int> year = take(text, '-') ? take_number(text) : std::nullopt;
  constexpr int kLastYear = 2200;  // so that its nanoseconds can be counted
  if (month > kMonths.size() || !year || *year < 1970 || *year > kLastYear) {
    return std::nullopt;
  }
  const std::chrono::year_month_day date{std::chrono::year{*year}, std::chrono::month{month},
                                         std::chrono::day{static_cast<unsigned>(*day)}};
  return date.ok() ? std::optional{std::chrono::sys_days{date}} : std::nullopt;
}

[[nodiscard]] std::optional<std::chrono::seconds> time_of_day(std::string_view text) noexcept {
  const std::optional<int> hours = take_number(text);
  const std::optional<int> minutes = hours && take(text, ':') ? take_number(text) : std::nullopt;
  const std::optional<int> seconds = minutes && take(text, ':') ? take_number(text) : std::nullopt;
  if (!seconds || *hours > 23 || *minutes > 59 || *seconds > 60) {
    return std::nullopt;
  }
  return std::chrono::hours{*hours} + std::chrono::minutes{*minutes} +
         std::chrono::seconds{*seconds};
}

}  // namespace

std::optional<double> degrees_in(std::string_view text) noexcept {
  while (take(text, ' ')) {
  }
  const std::optional<int> degrees = take_number(text);
  const std::optional<int> minutes = degrees && take(text, '.') ? take_number(text) : std::nullopt;
  const std::optional<double> fraction = minutes ? take_fraction(text) : std::nullopt;
  if (!fraction || !take(text, ' ') || text.empty()) {
    return std::nullopt;
  }
  const bool is_latitude = text[0] == 'N' || text[0] == 'S';
  const bool is_longitude = text[0] == 'E' || text[0] == 'W';
  const double value = *degrees + (*minutes + *fraction) / 60.0;
  if (!(is_latitude || is_longitude) || *minutes > 59 || value > (is_latitude ? 90.0 : 180.0)) {
    return std::nullopt;
  }
  return text[0] == 'S' || text[0] == 'W' ? -value : value;
}

std::optional<Duration> written_at(const Header& header) noexcept {
  const auto day = day_of(text_of(header.date));
  const auto time = time_of_day(text_of(header.time));
  if (!day || !time) {
    return std::nullopt;
  }
  // Milliseconds are of a later version than hundredths; who has neither has whole seconds.
  std::string_view fine = text_of(header.milliseconds);
  std::string_view coarse = text_of(header.hundredths);
  std::optional<double> fraction = take_fraction(fine);
  fraction = fraction ? fraction : take_fraction(coarse);
  return Duration{day->time_since_epoch()} + Duration{*time} + from_seconds(fraction.value_or(0.0));
}

}  // namespace lodesman::delta_t
