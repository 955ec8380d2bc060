// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/mounting.h"

#include <algorithm>
#include <cmath>

#include "mid_level/base/heading.h"

namespace lodesman {

namespace {

[[nodiscard]] bool is_nought(double value) noexcept { return std::fpclassify(value) == FP_ZERO; }

}  // namespace

void move_to_vehicle(const SonarMounting& mounting, SonarObstacles& obstacles) noexcept {
  if (is_nought(mounting.x_m) && is_nought(mounting.y_m) && is_nought(mounting.turn_rad)) {
    return;
  }
  const double c = std::cos(mounting.turn_rad);
  const double s = std::sin(mounting.turn_rad);
  const auto move = [&](double& x_m, double& y_m) {
    const double ahead_m = c * y_m - s * x_m;
    x_m = c * x_m + s * y_m + mounting.x_m;
    y_m = ahead_m + mounting.y_m;
  };
  const std::size_t count = std::min<std::size_t>(obstacles.count, kMaxObstacles);
  for (std::size_t i = 0; i < count; ++i) {
    Obstacle& obstacle = obstacles.obstacles[i];
    move(obstacle.centre_x_m, obstacle.centre_y_m);
    obstacle.angle_rad = wrap_to_pi(obstacle.angle_rad + mounting.turn_rad);
    const std::size_t vertices = std::min<std::size_t>(obstacle.vertex_count, kMaxVertices);
    for (std::size_t k = 0; k < vertices; ++k) {
      move(obstacle.vertices[k].x_m, obstacle.vertices[k].y_m);
    }
  }
}

}  // namespace lodesman
