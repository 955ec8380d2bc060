// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/waypoints.h"

#include <vector>

#include "tests/support/catch.h"

using namespace lodesman;

namespace {

std::vector<PathPixel> straight_ahead(int pixels) {
  std::vector<PathPixel> path;
  for (int i = 0; i <= pixels; ++i) {
    path.push_back(
        {static_cast<std::int16_t>(kApexColumn), static_cast<std::int16_t>(kApexRow - i)});
  }
  return path;
}

}  // namespace

TEST_CASE("waypoints: one every C along the path, and the goal last", "[high_level][guidance]") {
  const VehiclePose pose{{{10.0, 20.0}}, Heading::clockwise_from_y_rad(to_rad(90))};
  Plan plan;
  place_waypoints(straight_ahead(100), SonarView{30.0}, pose, {{16.0, 20.0}}, 1.3, plan);
  REQUIRE(plan.waypoint_count == 5);  // 6 m: at 1.3, 2.6, 3.9, 5.2, and the goal
  for (std::uint32_t i = 0; i < 4; ++i) {
    CHECK(plan.waypoints[i].x_m == Approx(10.0 + 1.3 * (i + 1)).margin(0.06));
    CHECK(plan.waypoints[i].y_m == Approx(20.0));
  }
  CHECK(plan.waypoints[4].x_m == Approx(16.0));
}

TEST_CASE("waypoints: a path shorter than C is the goal alone", "[high_level][guidance]") {
  Plan plan;
  place_waypoints(straight_ahead(3), SonarView{30.0}, {}, {{0.0, 0.2}}, 1.3, plan);
  REQUIRE(plan.waypoint_count == 1);
  CHECK(plan.waypoints[0].y_m == Approx(0.2));
}

TEST_CASE("waypoints: more than a plan holds keeps the first ones and the goal",
          "[high_level][guidance]") {
  Plan plan;
  place_waypoints(straight_ahead(499), SonarView{300.0}, {}, {{0.0, 299.4}}, 0.6, plan);
  REQUIRE(plan.waypoint_count == kMaxWaypoints);
  CHECK(plan.waypoints[kMaxWaypoints - 1].y_m == Approx(299.4));
}

TEST_CASE("waypoint tracker: the ahead waypoint is the first neither reached nor passed",
          "[high_level][guidance]") {
  const std::vector<Waypoint> line{{0, 1.3}, {0, 2.6}, {0, 3.9}};
  WaypointTracker tracker{0.5};
  CHECK(tracker.update(line, 1, {{0, 0}}) == 0);
  CHECK(tracker.update(line, 1, {{0, 0.85}}) == 1);   // within the radius of the first
  CHECK(tracker.update(line, 1, {{2.0, 2.7}}) == 2);  // far abeam of the second, but past it
  CHECK(tracker.update(line, 1, {{0, 0}}) == 2);      // never back
  CHECK(tracker.update(line, 1, {{0, 9}}) == 2);      // the goal is never passed
  CHECK(tracker.update(line, 2, {{0, 0}}) == 0);      // a new path starts anew
}

TEST_CASE("steering point: it runs ahead along the line, round its corners, to its end",
          "[high_level][guidance]") {
  const std::vector<Waypoint> line{{0, 0}, {0, 10}, {10, 10}};
  const SteeringPoint ahead = point_to_steer_for(line, {{1.0, 4.0}}, 2.0);
  CHECK(ahead.point.xy_m.x() == Approx(0.0).margin(1e-12));
  CHECK(ahead.point.xy_m.y() == Approx(6.0));
  CHECK(ahead.waypoint == 1);
  CHECK_FALSE(ahead.is_end);
  const SteeringPoint round_the_corner = point_to_steer_for(line, {{0.0, 9.0}}, 3.0);
  CHECK(round_the_corner.point.xy_m.x() == Approx(2.0));
  CHECK(round_the_corner.waypoint == 2);
  const SteeringPoint end = point_to_steer_for(line, {{9.0, 11.0}}, 3.0);
  CHECK(end.point.xy_m.x() == Approx(10.0));
  CHECK(end.is_end);
  CHECK(point_to_steer_for(std::vector<Waypoint>{{3, 4}}, {{0.0, 0.0}}, 2.0).is_end);
}
