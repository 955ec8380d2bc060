// SPDX-License-Identifier: Apache-2.0
// How every program ends: the contract's exit statuses. Any thread.
#pragma once

namespace lodesman {

inline constexpr int kExitDone = 0;
inline constexpr int kExitNoGoal = 1;
inline constexpr int kExitRefused = 2;
inline constexpr int kExitCollision = 3;
inline constexpr int kExitFault = 4;
inline constexpr int kExitNotYet = 75;  // EX_TEMPFAIL: what is needed is not there yet

}  // namespace lodesman
