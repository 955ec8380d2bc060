// SPDX-License-Identifier: Apache-2.0
// From the helm's two references to the thrusters' two commands: eqs 13-14 of the paper. Pure
// functions; any thread.
#pragma once

#include "mid_level/messages/command.h"

namespace lodesman {

inline constexpr int kMaxReference = 100;  // SurgeRef and HeadRef lie in [-100, 100]

// f(Th) = 12.8 sqrt((SurgeRef +- HeadRef) / 2) + 128, with the sign taken out of the root for
// negative sums; truncated to a whole number as the paper's worked example is (156.62 -> 156,
// 37.49 -> 37) and clamped to [0, 255], since 100 and 100 would give 256. The square root makes
// thrust, which grows with the square of the offset from 128, linear in the references.
// References outside [-100, 100] are clamped.
[[nodiscard]] ThrustCommand map_thrust(int surge_ref, int head_ref) noexcept;

}  // namespace lodesman
