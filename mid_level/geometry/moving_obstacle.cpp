// SPDX-License-Identifier: Apache-2.0
#include "mid_level/geometry/moving_obstacle.h"

#include <algorithm>

namespace lodesman {

Obstacle MovingObstacle::at(double scenario_time_s) const noexcept {
  const double moved_s = std::clamp(scenario_time_s, 0.0, stops_at_s);
  return translated(at_start, velocity_x_m_s * moved_s, velocity_y_m_s * moved_s);
}

Obstacle translated(const Obstacle& obstacle, double dx_m, double dy_m) noexcept {
  Obstacle moved = obstacle;
  moved.centre_x_m += dx_m;
  moved.centre_y_m += dy_m;
  for (std::uint32_t i = 0; i < moved.vertex_count; ++i) {
    moved.vertices[i].x_m += dx_m;
    moved.vertices[i].y_m += dy_m;
  }
  return moved;
}

}  // namespace lodesman
