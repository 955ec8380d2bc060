// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/replanner.h"

#include <memory>

#include "mid_level/geometry/sonar_view.h"
#include "tests/support/catch.h"
#include "tests/unit/guidance/support.h"

using namespace lodesman;

namespace {

Time s(double seconds) { return Time{from_seconds(seconds)}; }

ReplannerOptions paper() {
  return {from_seconds(1.6), from_seconds(0.5), from_seconds(3.6), 1.3, from_seconds(1e6), {}};
}

// A boat that sails north at 1 m/s along x = 3, heading north, for 20 s.
PoseHistory northward() {
  PoseHistory poses;
  for (int i = 0; i <= 200; ++i) {
    VehicleState state;
    state.valid_at = s(0.1 * i);
    state.x_m = 3.0;
    state.y_m = 0.1 * i;
    poses.add(state);
  }
  return poses;
}

std::unique_ptr<SonarPath> found(const PathRequest& request) {
  auto path = std::make_unique<SonarPath>();
  path->request = request.id;
  path->frame = request.frame;
  path->range_m = 30.0;
  path->reason = PathReason::kFound;
  for (int i = 0; i <= 50; ++i) {
    path->pixels[path->pixel_count++] = {static_cast<std::int16_t>(kApexColumn),
                                         static_cast<std::int16_t>(kApexRow - i)};
  }
  return path;
}

std::unique_ptr<SonarPath> refused(const PathRequest& request, PathReason reason) {
  auto path = std::make_unique<SonarPath>();
  path->request = request.id;
  path->reason = reason;
  return path;
}

}  // namespace

TEST_CASE("pose history: poses between two estimates are interpolated, others unknown",
          "[high_level][guidance]") {
  const PoseHistory poses = northward();
  CHECK(poses.at(s(15.05))->p_WV.xy_m.y() == Approx(15.05));
  CHECK(poses.at(s(20.05))->p_WV.xy_m.y() == Approx(20.0));
  CHECK_FALSE(poses.at(s(20.2)));
  CHECK_FALSE(poses.at(s(1.0)));  // forgotten
  CHECK_FALSE(PoseHistory{}.at(s(1.0)));
}

TEST_CASE("replanner: the goal is asked for in the vehicle frame at the frame's capture",
          "[high_level][guidance]") {
  Replanner replanner{paper()};
  const auto request = replanner.request(s(20), 7, s(18), {{4.0, 28.0}}, northward());
  REQUIRE(request);
  CHECK(request->frame == 7);
  CHECK(request->goal_x_m == Approx(1.0));
  CHECK(request->goal_y_m == Approx(10.0));
}

TEST_CASE("replanner: a path is taken into the world at the pose of its frame, not the newest",
          "[high_level][guidance]") {
  Replanner replanner{paper()};
  const auto request = replanner.request(s(20), 7, s(18), {{3.0, 21.0}}, northward());
  const Plan* plan = replanner.answer(s(20.1), *found(*request));
  REQUIRE(plan != nullptr);
  CHECK(plan->source == WaypointSource::kCurrent);
  REQUIRE(plan->waypoint_count == 3);
  CHECK(plan->waypoints[0].x_m == Approx(3.0));
  CHECK(plan->waypoints[0].y_m == Approx(18.0 + 1.3).margin(0.06));
  CHECK(plan->waypoints[2].y_m == Approx(21.0));
}

TEST_CASE("replanner: it asks once a period, one question at a time, each frame once",
          "[high_level][guidance]") {
  Replanner replanner{paper()};
  const PoseHistory poses = northward();
  const WorldPoint goal{{3.0, 30.0}};
  const auto first = replanner.request(s(18.0), 1, s(18.0), goal, poses);
  REQUIRE(first);
  const std::uint64_t first_id = first->id;  // the next request is written over it
  CHECK_FALSE(replanner.request(s(19.7), 2, s(19.6), goal, poses));  // no answer yet
  (void)replanner.answer(s(18.1), *found(*first));
  CHECK_FALSE(replanner.request(s(19.5), 2, s(19.5), goal, poses));  // too early
  CHECK_FALSE(replanner.request(s(19.7), 1, s(18.0), goal, poses));  // planned in already
  const auto second = replanner.request(s(19.65), 2, s(19.6), goal, poses);
  REQUIRE(second);
  CHECK(second->id == first_id + 1);
}

TEST_CASE("replanner: without a path the previous waypoints stand (step 12.4)",
          "[high_level][guidance]") {
  Replanner replanner{paper()};
  const PoseHistory poses = northward();
  const auto first = replanner.request(s(17.0), 1, s(17.0), {{3.0, 20.0}}, poses);
  const Plan before = *replanner.answer(s(17.1), *found(*first));
  const auto second = replanner.request(s(19.0), 2, s(19.0), {{3.0, 20.0}}, poses);
  const Plan* after = replanner.answer(s(19.1), *refused(*second, PathReason::kStartBlocked));
  REQUIRE(after != nullptr);
  CHECK(after->reason == PathReason::kStartBlocked);
  CHECK(after->source == WaypointSource::kPrevious);
  CHECK(after->path_id == before.id);
  CHECK(after->waypoint_count == before.waypoint_count);
}

TEST_CASE("replanner: previous waypoints have an age limit where one is set",
          "[high_level][guidance]") {
  ReplannerOptions options = paper();
  options.previous_path_max_age = from_seconds(1.0);
  Replanner replanner{options};
  const PoseHistory poses = northward();
  const auto first = replanner.request(s(17.0), 1, s(17.0), {{3.0, 20.0}}, poses);
  (void)replanner.answer(s(17.1), *found(*first));
  const auto second = replanner.request(s(19.0), 2, s(19.0), {{3.0, 20.0}}, poses);
  const Plan* after = replanner.answer(s(19.1), *refused(*second, PathReason::kNoPath));
  REQUIRE(after != nullptr);
  CHECK(after->source == WaypointSource::kNone);
  CHECK(after->waypoint_count == 0);
}

TEST_CASE("replanner: an answer to another question is none", "[high_level][guidance]") {
  Replanner replanner{paper()};
  const auto request = replanner.request(s(18), 1, s(18), {{3.0, 20.0}}, northward());
  PathRequest other = *request;
  other.id += 5;
  CHECK(replanner.answer(s(18.1), *found(other)) == nullptr);
  CHECK(replanner.answer(s(18.1), *found(*request)) != nullptr);
  CHECK(replanner.answer(s(18.2), *found(*request)) == nullptr);
}

TEST_CASE("replanner: a request without an answer is given up and asked again, with a new number",
          "[high_level][guidance]") {
  Replanner replanner{paper(), 40};
  replanner.start(s(16.0));
  const PoseHistory poses = northward();
  const auto first = replanner.request(s(17.0), 1, s(17.0), {{3.0, 20.0}}, poses);
  REQUIRE(first);
  CHECK(first->id == 40);
  (void)replanner.silence(s(17.4), {});
  CHECK_FALSE(replanner.request(s(19.0), 2, s(19.0), {{3.0, 20.0}}, poses));
  (void)replanner.silence(s(17.6), {});
  const auto second = replanner.request(s(19.0), 2, s(19.0), {{3.0, 20.0}}, poses);
  REQUIRE(second);
  CHECK(second->id == 41);
}

TEST_CASE("replanner: without any answer for too long nothing is followed, whatever the cause",
          "[high_level][guidance]") {
  Replanner replanner{paper()};
  replanner.start(s(14.0));
  const PoseHistory poses = northward();
  const auto request = replanner.request(s(15.0), 1, s(15.0), {{3.0, 20.0}}, poses);
  CHECK(replanner.answer(s(15.1), *found(*request))->waypoint_count > 0);
  CHECK(replanner.silence(s(18.7), {}) == nullptr);
  // Frames come, but none that can be placed: their capture time is unknown.
  CHECK_FALSE(replanner.request(s(18.71), 2, s(3.0), {{3.0, 20.0}}, poses));
  const Plan* blind = replanner.silence(s(18.71), {PathReason::kNoPosition, s(16.0)});
  REQUIRE(blind != nullptr);
  CHECK(blind->reason == PathReason::kNoPosition);
  CHECK(blind->lost_since == s(16.0));
  CHECK(blind->source == WaypointSource::kNone);
  CHECK(blind->waypoint_count == 0);
  CHECK(blind->captured == Time{});
  CHECK(replanner.silence(s(18.8), {}) == nullptr);  // said once
  const auto again = replanner.request(s(19.7), 3, s(19.6), {{3.0, 20.0}}, poses);
  REQUIRE(again);
  CHECK(replanner.answer(s(19.8), *found(*again))->source == WaypointSource::kCurrent);
}

TEST_CASE("replanner: in the world it asks once a frame, from tracks, and follows the answer",
          "[high_level][guidance]") {
  ReplannerOptions options = paper();
  options.replan_period = {};
  options.pilot = PilotOptions{};
  options.pilot->response = testing::default_response();
  options.pilot->manoeuvres = testing::default_manoeuvres();
  Replanner replanner{options, 8};
  replanner.start(s(1.0));
  Tracks tracks;
  tracks.frame = 5;
  tracks.captured = s(0.9);
  VehicleState state;
  state.valid_at = s(1.0);
  const auto request = replanner.request(s(1.0), tracks, s(1.0), state, {{{0.0, 20.0}}, false, {}});
  REQUIRE(request != nullptr);
  CHECK(request->id == 8);
  CHECK(request->frame == 5);
  CHECK(request->space == PathSpace::kWorld);
  CHECK(replanner.request(s(1.05), tracks, s(1.0), state, {{{0.0, 20.0}}, false, {}}) == nullptr);
  auto path = refused(*request, PathReason::kFound);
  path->points[0] = {0.0, 0.0};
  path->points[1] = {0.0, 20.0};
  path->point_count = 2;
  const Plan* plan = replanner.answer(s(1.1), *path, tracks, nullptr, state);
  REQUIRE(plan != nullptr);
  CHECK(plan->id == 8);
  CHECK(plan->path_id == 8);
  CHECK(plan->path_captured == s(0.9));
  CHECK(plan->steer_by == SteerBy::kLine);
  CHECK(plan->waypoint_count == 2);
  CHECK(replanner.answer(s(1.15), *path, tracks, nullptr, state) == nullptr);
  CHECK(replanner.request(s(1.2), tracks, s(1.0), state, {{{0.0, 20.0}}, false, {}}) ==
        nullptr);  // the same frame
  tracks.frame = 6;
  CHECK(replanner.request(s(1.2), tracks, s(1.2), state, {{{0.0, 20.0}}, false, {}}) != nullptr);
}

TEST_CASE("replanner: without frames it is slower at once, then stays where it stops, and says so",
          "[high_level][guidance]") {
  ReplannerOptions options = paper();
  options.replan_period = {};
  options.silence_limit = std::chrono::seconds{2};
  options.pilot = PilotOptions{};
  options.pilot->response = testing::default_response();
  options.pilot->manoeuvres = testing::default_manoeuvres();
  options.pilot->narrow_speed_share = 0.5;
  Replanner replanner{options};
  replanner.start(s(1.0));
  Tracks tracks;
  tracks.captured = s(0.9);
  VehicleState state;
  state.surge_m_s = 1.0;
  const Destination goal{{{0.0, 20.0}}, false, {}};
  // At `now`, of a frame that came at 1.0 s.
  const auto plan_at = [&](double now_s) {
    tracks.frame = 5;
    state.valid_at = s(now_s);
    state.y_m = now_s - 1.0;
    const auto* request = replanner.request(s(now_s), tracks, s(1.0), state, goal);
    REQUIRE(request != nullptr);
    auto path = refused(*request, PathReason::kFound);
    path->points[0] = {request->start_x_m, request->start_y_m};
    path->points[1] = {request->goal_x_m, request->goal_y_m};
    path->point_count = 2;
    return *replanner.answer(s(now_s + 0.01), *path, tracks, nullptr, state);
  };
  CHECK(plan_at(1.0).rung == PlanRung::kOnRoute);
  const Plan late = plan_at(1.6);
  CHECK(late.rung == PlanRung::kSlow);
  CHECK(late.speed_share == Approx(0.5));
  CHECK(late.reason == PathReason::kFound);
  CHECK(late.lost_since == s(0.9));
  CHECK(replanner.request(s(1.7), tracks, s(1.0), state, goal) == nullptr);
  const Plan lost = plan_at(3.1);
  CHECK(lost.rung == PlanRung::kStop);  // by thrust astern
  CHECK(lost.steer_by == SteerBy::kCourse);
  CHECK(lost.speed_share <= -1.0);
  CHECK(lost.lost_since == s(0.9));
  CHECK(lost.goal_y_m == Approx(2.5));  // 2.1 m of way, and what it takes to stop
  CHECK(lost.reason == PathReason::kNoFrame);
  state.surge_m_s = 0.0;
  const Plan kept = plan_at(4.0);
  CHECK(kept.goal_y_m == Approx(2.5));
  CHECK(kept.stay_at_end);
  CHECK(kept.steer_by == SteerBy::kLine);
  // Carried off, or driven by hand: it does not go back there without seeing.
  CHECK(plan_at(9.5).goal_y_m == Approx(8.5));
  // Seen again, it goes on.
  tracks.frame = 6;
  const auto* again = replanner.request(s(10.0), tracks, s(9.95), state, goal);
  REQUIRE(again != nullptr);
  CHECK(again->goal_y_m == Approx(20.0));
}

TEST_CASE("replanner: without a pilot it never asks in the world", "[high_level][guidance]") {
  Replanner replanner{paper()};
  CHECK(replanner.request(s(1.0), Tracks{}, s(1.0), VehicleState{}, {{{0.0, 20.0}}, false, {}}) ==
        nullptr);
}
