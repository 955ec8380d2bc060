// SPDX-License-Identifier: Apache-2.0
#include "high_level/control/heading_control.h"

#include <algorithm>
#include <cmath>

namespace lodesman {

int head_ref(Heading heading, Heading reference, double gain_per_deg) noexcept {
  // psi_b = -heading and psi_r = -reference (clockwise to counter-clockwise), so psi_b - psi_r is
  // the turn to the right that leads from the heading to the reference.
  const double psi_rad = heading.turn_to_rad(reference);
  const double wanted = std::clamp(gain_per_deg * to_deg(psi_rad), -100.0, 100.0);
  return static_cast<int>(std::lround(wanted));
}

}  // namespace lodesman
