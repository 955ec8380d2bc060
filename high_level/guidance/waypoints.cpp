// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/waypoints.h"

#include <algorithm>
#include <limits>

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

SteeringPoint point_to_steer_for(std::span<const Waypoint> waypoints, const WorldPoint& position,
                                 double look_ahead_m) noexcept {
  LODESMAN_CHECK(!waypoints.empty());
  const auto at = [&](std::size_t i) {
    return Eigen::Vector2d{waypoints[i].x_m, waypoints[i].y_m};
  };
  std::size_t leg = 0;
  double share = 0.0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const Eigen::Vector2d way = at(i + 1) - at(i);
    const double length2 = way.squaredNorm();
    const double s =
        length2 > 0.0 ? std::clamp(way.dot(position.xy_m - at(i)) / length2, 0.0, 1.0) : 0.0;
    const double distance_m = (position.xy_m - at(i) - s * way).norm();
    if (distance_m < nearest_m) {
      nearest_m = distance_m;
      leg = i;
      share = s;
    }
  }
  double ahead_m = look_ahead_m;
  for (; leg + 1 < waypoints.size(); ++leg, share = 0.0) {
    const Eigen::Vector2d way = at(leg + 1) - at(leg);
    const double left_m = (1.0 - share) * way.norm();
    if (ahead_m < left_m) {
      return {{at(leg) + (share + ahead_m / way.norm()) * way},
              static_cast<std::uint32_t>(leg + 1),
              false};
    }
    ahead_m -= left_m;
  }
  return {{at(waypoints.size() - 1)}, static_cast<std::uint32_t>(waypoints.size() - 1), true};
}

}  // namespace lodesman
