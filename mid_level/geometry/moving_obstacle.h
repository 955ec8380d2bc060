// SPDX-License-Identifier: Apache-2.0
// An obstacle of a scenario with its course: known to the world that simulates it and to the
// known-obstacle source that draws it, and to nobody who must find out. Plain values; any thread.
#pragma once

#include <limits>

#include "mid_level/messages/obstacle.h"

namespace lodesman {

struct MovingObstacle {
  Obstacle at_start;            // [world] as it lies at scenario time 0
  double velocity_x_m_s = 0.0;  // [m/s] [world]
  double velocity_y_m_s = 0.0;  // [m/s] [world]
  double stops_at_s = std::numeric_limits<double>::infinity();     // [s] scenario time; rests then
  double appears_at_s = 0.0;                                       // [s] exists from here ...
  double vanishes_at_s = std::numeric_limits<double>::infinity();  // [s] ... up to before here

  [[nodiscard]] bool exists(double scenario_time_s) const noexcept {
    return scenario_time_s >= appears_at_s && scenario_time_s < vanishes_at_s;
  }
  // [world] where it is at that time, whether or not it exists then.
  [[nodiscard]] Obstacle at(double scenario_time_s) const noexcept;
};

// The same obstacle, moved.
[[nodiscard]] Obstacle translated(const Obstacle& obstacle, double dx_m, double dy_m) noexcept;

}  // namespace lodesman
