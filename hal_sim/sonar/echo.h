// SPDX-License-Identifier: Apache-2.0
// Where the sound of one beam first meets an obstacle. Pure functions; any thread.
#pragma once

#include "mid_level/base/frames.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

// From `from_W`, along the unit vector, to the first point of the obstacle's edge; infinity when
// the ray misses it. From inside of an obstacle, its far side is heard.
[[nodiscard]] double ray_range_m(const Obstacle& obstacle, const WorldPoint& from_W,
                                 const Eigen::Vector2d& direction_W) noexcept;

}  // namespace lodesman
