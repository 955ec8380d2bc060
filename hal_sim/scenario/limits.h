// SPDX-License-Identifier: Apache-2.0
// What a scenario may ask for (ours): far beyond any sensible run, and small enough that no sum or
// square of it loses its meaning. Constants; any thread.
#pragma once

namespace lodesman {

inline constexpr double kMaxCoordinate_m = 1e5;
inline constexpr double kMaxSpeed_m_s = 10.0;

}  // namespace lodesman
