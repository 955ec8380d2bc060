// SPDX-License-Identifier: Apache-2.0
// Where the sound of one beam first meets an obstacle, and how. Pure functions; any thread.
#pragma once

#include <limits>

#include "mid_level/base/frames.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

// From `from_W`, along the unit vector, to the first point of the obstacle's edge; infinity when
// the ray misses it. From inside of an obstacle, its far side is heard.
[[nodiscard]] double ray_range_m(const Obstacle& obstacle, const WorldPoint& from_W,
                                 const Eigen::Vector2d& direction_W) noexcept;

// How a ray meets an edge there.
struct SurfaceHit {
  double range_m = std::numeric_limits<double>::infinity();
  double leaves_m = std::numeric_limits<double>::infinity();  // an ellipse again; a wall at once
  double cos_incidence = 0.0;  // [-] [0, 1]; 1: the ray stands square on the surface
  double along_m = 0.0;        // along the edge, from a point that is always the same
};
[[nodiscard]] SurfaceHit surface_hit(const Obstacle& obstacle, const WorldPoint& from_W,
                                     const Eigen::Vector2d& direction_W) noexcept;

}  // namespace lodesman
