// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/protection.h"

#include <span>

namespace lodesman {

void make_own_zones(const OwnZones& zones, SonarObstacles& obstacles) noexcept {
  const double clear_m = zones.hull_radius_m + zones.margin_m;
  for (auto& obstacle : std::span{obstacles.obstacles}.first(obstacles.count)) {
    const bool ellipse = obstacle.shape == ObstacleShape::kEllipse;
    obstacle.protection_first_m = clear_m + (ellipse ? obstacle.semi_axis_first_m : 0.0);
    obstacle.protection_second_m = clear_m + (ellipse ? obstacle.semi_axis_second_m : 0.0);
  }
}

}  // namespace lodesman
