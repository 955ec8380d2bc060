// SPDX-License-Identifier: Apache-2.0
// Numbers as text, the same whatever the user's locale. Pure functions; any thread.
#pragma once

#include <cmath>
#include <optional>
#include <string>

namespace lodesman::cli {

// With that many decimals and never a "-0.00"; empty when the value is not finite.
[[nodiscard]] std::string fixed(double value, int decimals);

// Nothing for what is no number, or for infinity.
[[nodiscard]] inline std::optional<double> if_finite(double value) noexcept {
  return std::isfinite(value) ? std::optional{value} : std::nullopt;
}

// The nearest value with that many decimals, for JSON, which prints no digits after those.
[[nodiscard]] double rounded(double value, int decimals);

}  // namespace lodesman::cli
