// SPDX-License-Identifier: Apache-2.0
// Steering in water that moves. Pure functions; any thread.
#pragma once

#include "mid_level/base/frames.h"

namespace lodesman {

// The velocity through the water, that fast, whose way over ground runs along a direction of length
// 1 [world]. Where the current across is faster than that, the one that is set off least.
[[nodiscard]] Eigen::Vector2d velocity_for_course(const Eigen::Vector2d& direction,
                                                  double speed_m_s,
                                                  const Eigen::Vector2d& current_m_s) noexcept;

}  // namespace lodesman
