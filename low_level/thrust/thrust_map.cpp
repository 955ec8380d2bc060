// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/thrust_map.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

[[nodiscard]] std::uint8_t command_of(int reference_sum) noexcept {
  const double offset = 12.8 * std::sqrt(std::abs(reference_sum) / 2.0);
  const double command = 128.0 + (reference_sum < 0 ? -offset : offset);
  return static_cast<std::uint8_t>(std::clamp(command, 0.0, 255.0));
}

}  // namespace

ThrustCommand map_thrust(int surge_ref, int head_ref) noexcept {
  const int surge = std::clamp(surge_ref, -kMaxReference, kMaxReference);
  const int head = std::clamp(head_ref, -kMaxReference, kMaxReference);
  return {command_of(surge + head), command_of(surge - head)};
}

}  // namespace lodesman
