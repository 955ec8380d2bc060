// SPDX-License-Identifier: Apache-2.0
// A point that goes with an obstacle: what it has moved by between two pings, the obstacle has.
// Pure; any thread.
#pragma once

#include <algorithm>
#include <span>

#include "low_level/thrust/edge_points.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

// Of what is as it is in the next ping too: a known obstacle, not a blob that grows as it nears.
[[nodiscard]] inline EdgePoint middle_of(const Obstacle& obstacle) noexcept {
  const std::uint32_t count = std::min<std::uint32_t>(obstacle.vertex_count, kMaxVertices);
  if (obstacle.shape == ObstacleShape::kEllipse || count == 0) {
    return {obstacle.centre_x_m, obstacle.centre_y_m};
  }
  EdgePoint middle;
  for (const Vertex& vertex : std::span{obstacle.vertices}.first(count)) {
    middle.x_m += vertex.x_m / count;
    middle.y_m += vertex.y_m / count;
  }
  return middle;
}

}  // namespace lodesman
