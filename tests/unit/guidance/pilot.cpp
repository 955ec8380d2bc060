// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/pilot.h"

#include <memory>

#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/guidance/bridge.h"

namespace lodesman::testing {
namespace {

using Vec = Eigen::Vector2d;

}  // namespace

TEST_CASE("pilot: with nothing in the way the path is followed to the goal",
          "[high_level][guidance]") {
  Bridge bridge;
  const Tracks none = tracks_of({});
  bridge.ask(none, state_at(1, 2), {1, 30});
  CHECK(bridge.request->space == PathSpace::kWorld);
  CHECK(bridge.request->zone_count == 0);
  CHECK(bridge.request->side_gain_m == Approx(1.5));
  CHECK(bridge.request->start_x_m == Approx(1.0));
  CHECK(bridge.request->goal_y_m == Approx(30.0));
  bridge.decide(none, state_at(1, 2), PathReason::kFound, {{1, 2}, {1, 30}});
  const Plan& plan = *bridge.plan;
  CHECK(plan.rung == PlanRung::kOnRoute);
  CHECK(plan.reason == PathReason::kFound);
  CHECK(plan.steer_by == SteerBy::kLine);
  CHECK(plan.speed_share == Approx(1.0));
  CHECK_FALSE(plan.stay_at_end);
  REQUIRE(plan.waypoint_count == 2);
  CHECK(plan.waypoints[1].y_m == Approx(30.0));
}

TEST_CASE("pilot: it plans from where the vehicle will be when the plan takes effect",
          "[high_level][guidance]") {
  PilotOptions options = pilot_options();
  options.latency = from_seconds(0.15);
  Bridge bridge;
  bridge.pilot = std::make_unique<Pilot>(options);
  VehicleState state = state_at(0, 0, 1.0);
  state.valid_at = at_s(5.0);
  state.heading_rad = to_rad(90.0);
  bridge.pilot->ask(at_s(5.1), tracks_of({}), state, {{{20.0, 0.0}}, false, {}}, *bridge.request);
  CHECK(bridge.request->start_x_m == Approx(0.25));
  CHECK(bridge.request->start_y_m == Approx(0.0).margin(1e-9));
}

TEST_CASE("pilot: doubt of the own place widens the zones by the share that is set",
          "[high_level][guidance]") {
  const auto zone_m = [](double share, double sigma_m) {
    PilotOptions options = pilot_options();
    options.zones.own_doubt_share = share;
    Bridge bridge;
    bridge.pilot = std::make_unique<Pilot>(options);
    VehicleState state = state_at(0, 0);
    state.position_xx_m2 = sigma_m * sigma_m;  // along one axis alone
    bridge.ask(tracks_of({disc_track(1, 0.0, 15.0)}), state, {0, 30});
    return bridge.request->zones[0].shape.protection_first_m;
  };
  CHECK(zone_m(0.0, 0.3) == Approx(zone_m(1.0, 0.0)));
  CHECK(zone_m(1.0, 0.3) == Approx(zone_m(1.0, 0.0) + 0.3 * pilot_options().zones.doubt_sigmas));
  CHECK(zone_m(0.5, 0.3) == Approx(zone_m(1.0, 0.15)));
}

TEST_CASE("pilot: the side that a path took is asked for again, until a new start",
          "[high_level][guidance]") {
  const Tracks tracks = tracks_of({disc_track(7, 0, 12)});
  Bridge bridge;
  bridge.ask(tracks, state_at(0, 0), {0, 25});
  REQUIRE(bridge.request->zone_count == 1);
  CHECK(bridge.request->zones[0].may_keep_to_port);
  CHECK(bridge.request->zones[0].may_keep_to_starboard);
  // East of it: it stays to port.
  bridge.decide(tracks, state_at(0, 0), PathReason::kFound, {{0, 0}, {3.6, 12}, {0, 25}});
  bridge.ask(tracks, state_at(0, 1), {0, 25});
  CHECK(bridge.request->zones[0].may_keep_to_port);
  CHECK_FALSE(bridge.request->zones[0].may_keep_to_starboard);
  // A path that took the other side changes what is asked for.
  bridge.decide(tracks, state_at(0, 1), PathReason::kFound, {{0, 1}, {-3.6, 12}, {0, 25}});
  bridge.ask(tracks, state_at(0, 2), {0, 25});
  CHECK_FALSE(bridge.request->zones[0].may_keep_to_port);
  CHECK(bridge.request->zones[0].may_keep_to_starboard);
  // Without a path nothing is learnt, and nothing forgotten.
  bridge.decide(tracks, state_at(0, 2), PathReason::kNoPath, {{0, 2}, {3.6, 12}, {0, 13}});
  bridge.ask(tracks, state_at(0, 3), {0, 25});
  CHECK_FALSE(bridge.request->zones[0].may_keep_to_port);
  bridge.pilot->start();
  bridge.ask(tracks, state_at(0, 3), {0, 25});
  CHECK(bridge.request->zones[0].may_keep_to_port);
  CHECK(bridge.request->zones[0].may_keep_to_starboard);
}

TEST_CASE("pilot: an obstacle that is passed is asked for on neither side",
          "[high_level][guidance]") {
  const Tracks tracks = tracks_of({disc_track(7, 0, 12)});
  Bridge bridge;
  bridge.ask(tracks, state_at(0, 0), {0, 25});
  bridge.decide(tracks, state_at(0, 0), PathReason::kFound, {{0, 0}, {3.6, 12}, {0, 25}});
  bridge.ask(tracks, state_at(3, 16), {0, 25});
  bridge.decide(tracks, state_at(3, 16), PathReason::kFound, {{3, 16}, {0, 25}});
  bridge.ask(tracks, state_at(3, 16), {0, 25});
  REQUIRE(bridge.request->zone_count == 1);
  CHECK(bridge.request->zones[0].may_keep_to_port);
  CHECK(bridge.request->zones[0].may_keep_to_starboard);
}

TEST_CASE("pilot: out of a zone that it is in it escapes, and says so", "[high_level][guidance]") {
  const Tracks tracks = tracks_of({disc_track(7, -2.5, 0)});
  const VehicleState inside = state_at(0, 0);  // 2 m off an obstacle whose zone is 3 m wide
  Bridge bridge;
  bridge.ask(tracks, inside, {10, 10});
  const Vec start{bridge.request->start_x_m, bridge.request->start_y_m};
  CHECK(zone_clearance_m(*bridge.request, {0, 0}) < -0.5);
  CHECK(zone_clearance_m(*bridge.request, start) > 0.0);
  CHECK(start.x() > 0.9);
  bridge.decide(tracks, inside, PathReason::kFound, {{start.x(), start.y()}, {10, 10}});
  CHECK(bridge.plan->reason == PathReason::kStartBlocked);
  CHECK(bridge.plan->rung == PlanRung::kEscape);
  REQUIRE(bridge.plan->waypoint_count == 3);
  CHECK(bridge.plan->waypoints[1].x_m == Approx(start.x()));
  CHECK_FALSE(bridge.plan->stay_at_end);
}

TEST_CASE("pilot: a goal in a zone is gone near to, and waited at", "[high_level][guidance]") {
  const Tracks tracks = tracks_of({disc_track(7, 0, 20)});
  Bridge bridge;
  bridge.ask(tracks, state_at(0, 0), {0, 20});
  const PathPoint near{bridge.request->goal_x_m, bridge.request->goal_y_m};
  CHECK(zone_clearance_m(*bridge.request, {near.x_m, near.y_m}) > 0.0);
  CHECK(near.y_m == Approx(20.0 - 3.5 - 0.42).margin(0.3));
  bridge.decide(tracks, state_at(0, 0), PathReason::kFound, {{0, 0}, near});
  CHECK(bridge.plan->reason == PathReason::kGoalBlocked);
  CHECK(bridge.plan->rung == PlanRung::kNearGoal);
  CHECK(bridge.plan->stay_at_end);
  CHECK(bridge.plan->speed_share == Approx(1.0));
  CHECK(bridge.plan->goal_y_m == Approx(0.0).margin(1e-12));  // not the pilot's to say
  // There it waits.
  const VehicleState there = state_at(near.x_m, near.y_m - 0.3);
  bridge.ask(tracks, there, {0, 20});
  bridge.decide(tracks, there, PathReason::kFound, {{there.x_m, there.y_m}, near});
  CHECK(bridge.plan->stay_at_end);
  CHECK(bridge.plan->rung == PlanRung::kHold);
  CHECK(bridge.plan->reason == PathReason::kGoalBlocked);
  // A little drift changes nothing, much of it does.
  const VehicleState adrift = state_at(near.x_m, near.y_m - 1.5);
  bridge.decide(tracks, adrift, PathReason::kFound, {{adrift.x_m, adrift.y_m}, near});
  CHECK(bridge.plan->rung == PlanRung::kHold);
  const VehicleState away = state_at(near.x_m, near.y_m - 4.0);
  bridge.ask(tracks, away, {0, 20});
  bridge.decide(tracks, away, PathReason::kFound, {{away.x_m, away.y_m}, near});
  CHECK(bridge.plan->rung == PlanRung::kNearGoal);
}

TEST_CASE("pilot: a goal that zones can make room for is made for itself, slowly at the end",
          "[high_level][guidance]") {
  const Tracks tracks = tracks_of({disc_track(7, 0, 22)});
  const Vec goal{0, 22 - 0.5 - 0.6 - 0.45 - 0.2};  // hull, least margin and a little off the stone
  Bridge bridge;
  bridge.ask(tracks, state_at(0, 0), goal);
  CHECK(bridge.request->goal_y_m == Approx(goal.y()));
  CHECK(zone_clearance_m(*bridge.request, goal) > 0.0);
  bridge.decide(tracks, state_at(0, 0), PathReason::kFound, {{0, 0}, {goal.x(), goal.y()}});
  CHECK(bridge.plan->reason == PathReason::kFound);
  CHECK_FALSE(bridge.plan->stay_at_end);
  CHECK(bridge.plan->speed_share == Approx(1.0));
  const VehicleState near = state_at(0, goal.y() - 3.0);
  bridge.ask(tracks, near, goal);
  bridge.decide(tracks, near, PathReason::kFound, {{0, near.y_m}, {goal.x(), goal.y()}});
  CHECK(bridge.plan->rung == PlanRung::kSlow);
  CHECK(bridge.plan->speed_share <= 0.5);
}

TEST_CASE("pilot: a place to stay at is held, and left for what comes", "[high_level][guidance]") {
  Bridge bridge;
  const VehicleState here = state_at(3, 4);
  bridge.ask(tracks_of({}), here, {3, 4}, true);
  bridge.decide(tracks_of({}), here, PathReason::kFound, {{3, 4}});
  CHECK(bridge.plan->rung == PlanRung::kHold);
  CHECK(bridge.plan->reason == PathReason::kFound);
  CHECK(bridge.plan->stay_at_end);
  CHECK(bridge.plan->steer_by == SteerBy::kLine);
  const Tracks mover = tracks_of({disc_track(3, 3, 12, 0.0, -0.5)});
  bridge.ask(mover, here, {3, 4}, true);
  bridge.decide(mover, here, PathReason::kFound, {{3, 4}});
  CHECK(bridge.plan->rung != PlanRung::kHold);
  CHECK(bridge.plan->cause == 3);
}

TEST_CASE("pilot: without a path it goes to the best point and waits", "[high_level][guidance]") {
  const Tracks none = tracks_of({});
  Bridge bridge;
  bridge.ask(none, state_at(0, 0), {0, 30});
  bridge.decide(none, state_at(0, 0), PathReason::kNoPath, {{0, 0}, {2, 8}});
  CHECK(bridge.plan->reason == PathReason::kNoPath);
  CHECK(bridge.plan->rung == PlanRung::kBestPoint);
  CHECK(bridge.plan->stay_at_end);
  REQUIRE(bridge.plan->waypoint_count == 2);
  CHECK(bridge.plan->waypoints[1].x_m == Approx(2.0));
  CHECK(bridge.plan->waypoints[1].y_m == Approx(8.0));
  // With no point at all it stays where it is.
  bridge.decide(none, state_at(0, 0), PathReason::kStartBlocked, {});
  CHECK(bridge.plan->stay_at_end);
  CHECK(bridge.plan->rung == PlanRung::kHold);
}

TEST_CASE("pilot: a search that met its bound leaves the way that there was, and says so",
          "[high_level][guidance]") {
  const Tracks none = tracks_of({});
  Bridge bridge;
  bridge.ask(none, state_at(0, 0), {0, 30});
  bridge.decide(none, state_at(0, 0), PathReason::kLimit, {});
  CHECK(bridge.plan->rung == PlanRung::kHold);  // there was none yet
  bridge.decide(none, state_at(0, 0), PathReason::kFound, {{0, 0}, {3, 15}, {0, 30}});
  bridge.decide(none, state_at(0.2, 1), PathReason::kLimit, {});
  CHECK(bridge.plan->reason == PathReason::kLimit);
  CHECK(bridge.plan->rung == PlanRung::kOnRoute);
  CHECK_FALSE(bridge.plan->stay_at_end);
  CHECK(bridge.plan->speed_share == Approx(1.0));
  REQUIRE(bridge.plan->waypoint_count >= 3);
  CHECK(bridge.plan->waypoints[bridge.plan->waypoint_count - 1].y_m == Approx(30.0));
  // A narrow one stays one, and is gone through slowly.
  bridge.path->narrow = true;
  bridge.decide(none, state_at(0.2, 1), PathReason::kFound, {{0, 0}, {3, 15}, {0, 30}});
  bridge.path->narrow = false;
  bridge.decide(none, state_at(0.2, 1), PathReason::kLimit, {});
  CHECK(bridge.plan->narrow);
  CHECK(bridge.plan->speed_share <= 0.5);
  // It led to that goal, and leads to no other.
  bridge.ask(none, state_at(0.2, 1), {9, -9});
  bridge.decide(none, state_at(0.2, 1), PathReason::kLimit, {});
  CHECK(bridge.plan->rung == PlanRung::kHold);
}

TEST_CASE("pilot: a goal beyond the reach of a search is made for, however far it is",
          "[high_level][guidance]") {
  for (const double distance_m : {1999.0, 2500.0, 90'000.0}) {
    INFO(distance_m);
    Bridge bridge;
    bridge.ask(tracks_of({}), state_at(10, 20), {10 + 0.6 * distance_m, 20 + 0.8 * distance_m});
    const Vec way{bridge.request->goal_x_m - 10.0, bridge.request->goal_y_m - 20.0};
    CHECK(way.cwiseAbs().maxCoeff() < kPathReach_m);
    CHECK(way.norm() > 0.9 * kPathReach_m);
    CHECK(way.normalized().dot(Vec{0.6, 0.8}) == Approx(1.0));
  }
  // Nor is it waited for where what is asked for lies in a zone.
  Bridge bridge;
  const Tracks stone = tracks_of({disc_track(3, 0, 1900)});
  bridge.ask(stone, state_at(0, 0), {0, 5000});
  REQUIRE(zone_clearance_m(*bridge.request, {0, 1900}) < 0.0);
  bridge.decide(stone, state_at(0, 0), PathReason::kFound,
                {{0, 0}, {bridge.request->goal_x_m, bridge.request->goal_y_m}});
  CHECK(bridge.plan->reason == PathReason::kFound);
  CHECK(bridge.plan->rung == PlanRung::kOnRoute);
  CHECK_FALSE(bridge.plan->stay_at_end);
}

TEST_CASE(
    "pilot: of points that are as near to a closed goal one is made for, until another is better",
    "[high_level][guidance]") {
  const Tracks none = tracks_of({});
  Bridge bridge;
  const auto asked_y_m = [&](double own_x_m) {
    bridge.ask(none, state_at(own_x_m, 0), {0, 30});
    return bridge.request->goal_y_m;
  };
  CHECK(asked_y_m(0) == Approx(30));
  bridge.decide(none, state_at(0, 0), PathReason::kNoPath, {{0, 0}, {-8, 30}});
  // On the way there it is asked for itself, the goal now and then.
  CHECK(asked_y_m(0) == Approx(30));
  CHECK(bridge.request->goal_x_m == Approx(-8));
  bridge.decide(none, state_at(0, 0), PathReason::kFound, {{0, 0}, {-8, 30}});
  CHECK(bridge.plan->rung == PlanRung::kBestPoint);
  CHECK(bridge.plan->reason == PathReason::kNoPath);
  int until_goal = 0;
  do {
    (void)asked_y_m(0);
    ++until_goal;
  } while (std::abs(bridge.request->goal_x_m) > 1.0 && until_goal < 100);
  CHECK(until_goal <= 10);
  // A little better, on the other side: no reason to go there.
  bridge.decide(none, state_at(0, 0), PathReason::kNoPath, {{0, 0}, {7.5, 30}});
  CHECK(bridge.plan->waypoints[bridge.plan->waypoint_count - 1].x_m == Approx(-8));
  // Much better: it is.
  while (std::abs(bridge.request->goal_x_m) > 1.0) {
    (void)asked_y_m(0);
  }
  bridge.decide(none, state_at(0, 0), PathReason::kNoPath, {{0, 0}, {4, 30}});
  CHECK(bridge.plan->waypoints[bridge.plan->waypoint_count - 1].x_m == Approx(4));
  // And once the goal can be reached, that is forgotten.
  do {
    (void)asked_y_m(0);
  } while (std::abs(bridge.request->goal_x_m) > 1.0);
  bridge.decide(none, state_at(0, 0), PathReason::kFound, {{0, 0}, {0, 30}});
  CHECK(bridge.plan->rung == PlanRung::kOnRoute);
  (void)asked_y_m(0);
  CHECK(bridge.request->goal_x_m == Approx(0).margin(1e-9));
}

TEST_CASE("pilot: the best point for one goal is none for a place to hold",
          "[high_level][guidance]") {
  const Tracks none = tracks_of({});
  Bridge bridge;
  bridge.ask(none, state_at(0, 0), {0, 30});
  bridge.decide(none, state_at(0, 0), PathReason::kNoPath, {{0, 0}, {-8, 30}});
  bridge.ask(none, state_at(0, 0), {0, 30});
  REQUIRE(bridge.request->goal_x_m == Approx(-8));  // on the way there
  bridge.ask(none, state_at(0, 1), {0, 1}, true);
  CHECK(bridge.request->goal_x_m == Approx(0).margin(1e-9));
  CHECK(bridge.request->goal_y_m == Approx(1));
}

TEST_CASE("pilot: narrow water is gone through slowly", "[high_level][guidance]") {
  const Tracks none = tracks_of({});
  Bridge bridge;
  bridge.ask(none, state_at(0, 0), {0, 30});
  bridge.path->narrow = true;
  bridge.decide(none, state_at(0, 0), PathReason::kFound, {{0, 0}, {0, 30}});
  CHECK(bridge.plan->narrow);
  CHECK(bridge.plan->rung == PlanRung::kSlow);
  CHECK(bridge.plan->speed_share == Approx(0.5));
}

TEST_CASE("pilot: a mover head-on is steered round on a course, and named",
          "[high_level][guidance]") {
  const Tracks tracks = tracks_of({disc_track(3, 0, 16, 0.0, -0.5)});
  const VehicleState state = state_at(0, 0, 1.0);
  Bridge bridge;
  bridge.ask(tracks, state, {0, 25});
  CHECK(bridge.request->zone_count == 0);  // too fast for a zone
  bridge.decide(tracks, state, PathReason::kFound, {{0, 0}, {0, 25}});
  CHECK(bridge.plan->rung == PlanRung::kAside);
  CHECK(bridge.plan->steer_by == SteerBy::kCourse);
  CHECK(bridge.plan->course_rad > 0.1);
  CHECK(bridge.plan->cause == 3);
  CHECK(bridge.plan->changed);
}

TEST_CASE("pilot: neither asking nor deciding allocates", "[high_level][guidance]") {
  const Tracks tracks =
      tracks_of({disc_track(1, 0, 16, 0.0, -0.5), disc_track(2, 2, 12), disc_track(4, 0, 25),
                 disc_track(5, -2.5, 0), wall_track(6, {{-9, 20}, {-5, 22}, {-5, 30}})});
  const VehicleState state = state_at(0, 0, 1.0);
  Bridge bridge;
  const AllocationScope scope;
  for (int i = 0; i < 3; ++i) {
    bridge.ask(tracks, state, {0, 25});
    bridge.decide(tracks, state, i < 2 ? PathReason::kFound : PathReason::kNoPath,
                  {{0, 0}, {5, 12}, {0, 22}});
  }
  const auto allocations = scope.count();
  CHECK(bridge.request->zone_count == 4);
  CHECK(bridge.plan->waypoint_count > 2);
  CHECK(allocations == 0);
}

}  // namespace lodesman::testing
