// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/numbers.h"

#include <array>
#include <charconv>
#include <cmath>

namespace lodesman::cli {

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) {
    return {};
  }
  std::array<char, 512> digits{};  // the largest double has 309 digits before its point
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                          std::chars_format::fixed, decimals);
  if (error != std::errc{}) {
    return {};
  }
  std::string text(digits.data(), end);
  if (text.front() == '-' && text.find_first_of("123456789") == std::string::npos) {
    text.erase(0, 1);
  }
  return text;
}

double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  const double scaled = std::round(value * scale);
  // Beyond 2^53 every double is whole already, and the product may have overflowed.
  return std::abs(scaled) < 9e15 ? scaled / scale + 0.0 : value;
}

}  // namespace lodesman::cli
