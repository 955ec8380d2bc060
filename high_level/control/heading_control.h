// SPDX-License-Identifier: Apache-2.0
// The P controller of the heading: eqs 2, 8 and 9 of the paper. Pure functions; any thread.
#pragma once

#include "mid_level/base/heading.h"

namespace lodesman {

// HeadRef = Kh psi with psi = psi_b - psi_r, both counted counter-clockwise as in the paper: a boat
// that points to the left of its reference has psi > 0 and turns right. Rounded to the nearest
// whole number and clamped to [-100, 100].
// heading: psi_b, where the boat points. reference: psi_r, where the ahead waypoint lies.
// gain_per_deg: Kh [1/deg] > 0.
[[nodiscard]] int head_ref(Heading heading, Heading reference, double gain_per_deg) noexcept;

}  // namespace lodesman
