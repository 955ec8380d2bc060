// SPDX-License-Identifier: Apache-2.0
// From a path to waypoints, and along them: section 4.2 and Fig. 3 of the paper. Plain values; one
// thread each.
#pragma once

#include <cstdint>
#include <span>

#include "mid_level/base/frames.h"
#include "mid_level/geometry/sonar_view.h"
#include "mid_level/messages/command.h"
#include "mid_level/messages/path.h"

namespace lodesman {

// Takes a path's pixels into the world at the pose of its sonar frame (eqs 5-6), keeps a waypoint
// every interval_m of its length (the paper's C) and, last, the goal itself. Writes them into the
// plan; a path that needs more than kMaxWaypoints keeps the first ones and still ends at the goal.
void place_waypoints(std::span<const PathPixel> path, const SonarView& view,
                     const VehiclePose& pose, const WorldPoint& goal, double interval_m,
                     Plan& plan) noexcept;

// Follows the waypoints of one path, always the first that is neither reached nor passed. The last
// one is never passed: it is the goal.
class WaypointTracker {
 public:
  // radius_m: a waypoint is reached within this distance [m] > 0.
  explicit WaypointTracker(double radius_m) noexcept : radius_m_{radius_m} {}

  // The index of the waypoint ahead. Starts again at the first one when `path_id` changes.
  // waypoints must not be empty.
  std::uint32_t update(std::span<const Waypoint> waypoints, std::uint64_t path_id,
                       const WorldPoint& position) noexcept;

 private:
  double radius_m_;
  std::uint64_t path_id_ = 0;
  std::uint32_t index_ = 0;
};

// What to steer for by line of sight: the point look_ahead_m along the line through the waypoints
// from its point nearest to the vehicle, or its end.
struct SteeringPoint {
  WorldPoint point;
  std::uint32_t waypoint = 0;  // the next one after it
  bool is_end = false;
};
// waypoints must not be empty.
[[nodiscard]] SteeringPoint point_to_steer_for(std::span<const Waypoint> waypoints,
                                               const WorldPoint& position,
                                               double look_ahead_m) noexcept;

}  // namespace lodesman
