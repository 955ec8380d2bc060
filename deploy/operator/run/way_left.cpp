// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/way_left.h"

#include <algorithm>
#include <span>

namespace lodesman::cli {

double way_left_m(const ScenarioMission& mission, std::size_t goal_index, const WorldPoint& from) {
  double left_m = 0.0;
  WorldPoint at = from;
  const std::span<const Goal> waypoints = mission.waypoints();
  for (const Goal& waypoint : waypoints.subspan(std::min(goal_index, waypoints.size()))) {
    const WorldPoint to{{waypoint.x_m, waypoint.y_m}};
    left_m += (to.xy_m - at.xy_m).norm();
    at = to;
  }
  return left_m + (mission.goal().xy_m - at.xy_m).norm();
}

}  // namespace lodesman::cli
