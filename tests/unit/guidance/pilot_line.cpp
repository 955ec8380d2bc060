// SPDX-License-Identifier: Apache-2.0
// The pilot on legs whose line is to be kept.
#include "tests/support/catch.h"
#include "tests/unit/guidance/bridge.h"

namespace lodesman::testing {
namespace {

const Leg kNorth{{0, 0}, {0, 60}};

[[nodiscard]] Eigen::Vector2d goal_of(const PathRequest& request) {
  return {request.goal_x_m, request.goal_y_m};
}
[[nodiscard]] Eigen::Vector2d point_of(const Waypoint& waypoint) {
  return {waypoint.x_m, waypoint.y_m};
}
[[nodiscard]] Eigen::Vector2d end_of(const Plan& plan) {
  return point_of(plan.waypoints[plan.waypoint_count - 1]);
}

}  // namespace

TEST_CASE("pilot: a line that is clear is the way, from abeam to its end", "[guidance]") {
  Bridge bridge;
  const Tracks none = tracks_of({});
  const VehicleState state = state_at(1.0, 10.0);
  bridge.ask(none, state, kNorth);
  CHECK(goal_of(*bridge.request).x() == Approx(0.0).margin(1e-9));
  CHECK(goal_of(*bridge.request).y() > 30.0);
  const double goal_y_m = goal_of(*bridge.request).y();
  bridge.decide(none, state, PathReason::kFound, {{1, 10}, {0, goal_y_m}});
  const Plan& plan = *bridge.plan;
  CHECK(plan.rung == PlanRung::kOnRoute);
  CHECK(plan.steer_by == SteerBy::kLine);
  CHECK((point_of(plan.waypoints[0]) - Eigen::Vector2d{0, 10}).norm() < 1e-6);
  CHECK((end_of(plan) - kNorth.to_W).norm() < 1e-6);
}

TEST_CASE("pilot: what lies on a line is gone round from the line, and the line gone back to",
          "[guidance]") {
  Bridge bridge;
  const Tracks stone = tracks_of({disc_track(1, 0.2, 26.0)});
  const VehicleState state = state_at(0.5, 4.0);
  bridge.ask(stone, state, kNorth);
  const PathRequest& request = *bridge.request;
  CHECK(request.start_x_m == Approx(0.0).margin(1e-9));
  CHECK(request.start_y_m > 10.0);
  CHECK(request.start_y_m < 24.0);
  const Eigen::Vector2d rejoin = goal_of(request);
  CHECK(rejoin.x() == Approx(0.0).margin(1e-9));
  CHECK(rejoin.y() > 28.0);
  CHECK(rejoin.y() < 40.0);
  bridge.decide(stone, state, PathReason::kFound,
                {{0, request.start_y_m}, {-3, 26}, {rejoin.x(), rejoin.y()}});
  CHECK((end_of(*bridge.plan) - kNorth.to_W).norm() < 1e-6);
}

TEST_CASE("pilot: a line that cannot be gone back to is left alone for a while", "[guidance]") {
  Bridge bridge;
  const Tracks none = tracks_of({});
  const VehicleState state = state_at(0.0, 10.0);
  bridge.ask(none, state, kNorth);
  CHECK((goal_of(*bridge.request) - kNorth.to_W).norm() > 1.0);
  bridge.decide(none, state, PathReason::kNoPath, {});
  CHECK_FALSE(bridge.plan->stay_at_end);
  CHECK(bridge.plan->reason == PathReason::kNoPath);  // no way is there yet
  CHECK((end_of(*bridge.plan) - kNorth.to_W).norm() < 1e-6);
  int free_asks = 0;
  do {
    bridge.ask(none, state, kNorth);
    bridge.decide(none, state, PathReason::kFound, {{0, 10}, {0, 60}});
    ++free_asks;
  } while ((goal_of(*bridge.request) - kNorth.to_W).norm() < 1.0 && free_asks < 100);
  CHECK(free_asks > 5);
  CHECK(free_asks < 30);
  // Now there is one, and it stays.
  bridge.decide(none, state, PathReason::kNoPath, {});
  CHECK(bridge.plan->reason == PathReason::kFound);
}

TEST_CASE("pilot: at a waypoint in a zone a line ends where there is room", "[guidance]") {
  Bridge bridge;
  const Tracks rock = tracks_of({disc_track(1, 0.0, 60.0)});
  const VehicleState state = state_at(0.0, 50.0);
  bridge.ask(rock, state, kNorth);
  const Eigen::Vector2d free = goal_of(*bridge.request);
  CHECK((free - kNorth.to_W).norm() > 1.0);
  bridge.decide(rock, state, PathReason::kFound, {{0, 50}, {free.x(), free.y()}});
  CHECK((end_of(*bridge.plan) - free).norm() < 1e-6);
  CHECK(bridge.plan->stay_at_end);
  CHECK(bridge.plan->reason == PathReason::kGoalBlocked);
}

}  // namespace lodesman::testing
