// SPDX-License-Identifier: Apache-2.0
// The evidence of the grid as others are told it: which water was seen, and what was there. Pure
// functions; any thread; nothing allocates.
#pragma once

#include <Eigen/Core>

#include "low_level/tracking/evidence_grid.h"
#include "mid_level/messages/coverage.h"

namespace lodesman {

// [s] What was free so long ago is not known to be free now: boats come.
inline constexpr double kFreeFor_s = 60.0;

// Round the head [odometry] at a time of the grid's clock: of cells that lie in one of the
// coverage's, an occupied one counts first, then an unknown one. Where the boat itself is, and so
// near that nothing is heard, what nobody saw is free.
// Sets corner and cells; the corner is in the odometry frame too.
void describe_water(const EvidenceGrid& grid, const Eigen::Vector2d& head, double now_s,
                    double nearest_m, Coverage& out) noexcept;

}  // namespace lodesman
