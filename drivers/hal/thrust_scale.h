// SPDX-License-Identifier: Apache-2.0
// What a command byte of eqs 13-14 means, once for every box: a share u of full thrust in [-1, 1],
// astern negative. 127 and 128 both are stop, so each side has 127 steps. Pure functions; any
// thread.
#pragma once

#include <cmath>
#include <cstdint>

#include "mid_level/messages/command.h"

namespace lodesman {

inline constexpr int kThrustSteps = 127;  // to either side of stop

[[nodiscard]] constexpr double thrust_share(std::uint8_t command) noexcept {
  const int step = (command <= kThrustSteps ? command : command - 1) - kThrustSteps;
  return static_cast<double>(step) / kThrustSteps;
}

// The nearest command; what lies outside is clamped, and stop is 128. No number is stop.
[[nodiscard]] inline std::uint8_t thrust_command(double share) noexcept {
  if (std::isnan(share)) {
    return kNeutralThrust.left;
  }
  const double within = std::fmin(std::fmax(share, -1.0), 1.0);
  const int step = static_cast<int>(std::lround(within * kThrustSteps));
  return static_cast<std::uint8_t>(kThrustSteps + step + (step >= 0 ? 1 : 0));
}

[[nodiscard]] constexpr bool is_neutral(std::uint8_t command) noexcept {
  return command == kThrustSteps || command == kThrustSteps + 1;
}
[[nodiscard]] constexpr bool is_neutral(const ThrustCommand& command) noexcept {
  return is_neutral(command.left) && is_neutral(command.right);
}

// [%] The paper's duty of an H-bridge that stands still at 50: rounded it is 0-49 astern, 50 at
// stop and 51-100 ahead.
[[nodiscard]] constexpr double duty_percent(std::uint8_t command) noexcept {
  return command * 100.0 / 255.0;
}

}  // namespace lodesman
