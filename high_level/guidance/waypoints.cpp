// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/waypoints.h"

#include <algorithm>

#include "mid_level/base/check.h"

namespace lodesman {

void place_waypoints(std::span<const PathPixel> path, const SonarView& view,
                     const VehiclePose& pose, const WorldPoint& goal, double interval_m,
                     Plan& plan) noexcept {
  plan.waypoint_count = 0;
  const auto add = [&](const WorldPoint& p) {
    plan.waypoints[plan.waypoint_count++] = {p.xy_m.x(), p.xy_m.y()};
  };
  double next_m = interval_m;
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size() && plan.waypoint_count + 1 < kMaxWaypoints; ++i) {
    const Eigen::Vector2d step = view.to_vehicle(path[i]).xy_m - view.to_vehicle(path[i - 1]).xy_m;
    length_m += step.norm();
    const bool at_goal = i + 1 == path.size();
    if (length_m >= next_m && !at_goal) {
      add(pose.to_world(view.to_vehicle(path[i])));
      next_m += interval_m;
    }
  }
  add(goal);
}

std::uint32_t WaypointTracker::update(std::span<const Waypoint> waypoints, std::uint64_t path_id,
                                      const WorldPoint& position) noexcept {
  LODESMAN_CHECK(!waypoints.empty());
  if (path_id != path_id_) {
    path_id_ = path_id;
    index_ = 0;
  }
  const auto last = static_cast<std::uint32_t>(waypoints.size() - 1);
  while (index_ < last) {
    const Waypoint& here = waypoints[index_];
    const Waypoint& next = waypoints[index_ + 1];
    const Eigen::Vector2d from_here = position.xy_m - Eigen::Vector2d{here.x_m, here.y_m};
    const Eigen::Vector2d leg{next.x_m - here.x_m, next.y_m - here.y_m};
    const bool reached = from_here.norm() <= radius_m_;
    const bool passed = from_here.dot(leg) > 0.0;
    if (!reached && !passed) {
      break;
    }
    ++index_;
  }
  return std::min(index_, last);
}

}  // namespace lodesman
