// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/planner.h"

#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

[[nodiscard]] PlannerOptions paper_options() {
  PlannerOptions options;
  options.replanner.replan_period = milliseconds{1600};
  options.replanner.answer_patience = seconds{1};
  options.replanner.waypoint_interval_m = 1.3;
  options.mission.waypoint_radius_m = 0.5;
  options.progress = {seconds{15}, 0.5};
  return options;
}

struct Planner {
  Planner() : task{*board, Role::kHigh, paper_options()} {
    definitions.publish(mission_through({{0.0, 10.0}}), kStart);
  }

  void estimate(double y_m, Time at) {
    VehicleState here;
    here.valid_at = at;
    here.y_m = y_m;
    state.publish(here, at);
  }
  void see(std::uint64_t frame, Time at) {
    auto seen = std::make_unique<SonarObstacles>();
    seen->frame = frame;
    seen->captured = at;
    seen->range_m = 30.0;
    obstacles.publish(*seen, at);
  }
  void order(OperatorOrder what, Time at) {
    aborts += what == OperatorOrder::kAbort ? 1U : 0U;
    OperatorCommand command;
    command.order = what;
    command.aborts = aborts;
    orders.publish(command, at);
  }
  [[nodiscard]] MissionState after_step(Time now) {
    task.step(now);
    const auto* newest = statuses.latest();
    REQUIRE(newest != nullptr);
    CHECK(newest->stamp == now);
    return newest->value.state;
  }

  std::uint64_t aborts = 0;
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  PlannerTask task;
  Writer<VehicleState> state{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Writer<SonarObstacles> obstacles{board->sonar_obstacles, Role::kLow, "sonar_obstacles"};
  Writer<MissionDefinition> definitions{board->mission_definition, Role::kHigh, "definitions"};
  Writer<OperatorCommand> orders{board->operator_command, Role::kHigh, "operator_command"};
  Reader<MissionStatus> statuses{board->mission_status};
  Reader<PathRequest> requests{board->path_request};
  Reader<Plan> plans{board->plan};
};

TEST_CASE("planner task: only another state of the mission rings for the controller",
          "[high_level][tasks]") {
  Planner planner;
  const auto rings_of_step = [&](Time now) {
    const Bell<>& bell = planner.board->bell_of(TaskId::kController);
    const std::uint32_t before = look_at(bell);
    (void)planner.after_step(now);
    return look_at(bell) - before;
  };
  planner.estimate(0.0, kStart);
  CHECK(rings_of_step(kStart) == 0);
  planner.order(OperatorOrder::kStart, kStart);
  CHECK(rings_of_step(kStart) == 1);
  CHECK(rings_of_step(kStart + milliseconds{50}) == 0);
  planner.order(OperatorOrder::kAbort, kStart + milliseconds{60});
  CHECK(rings_of_step(kStart + milliseconds{60}) == 1);
  CHECK(rings_of_step(kStart + milliseconds{70}) == 0);
}

TEST_CASE("planner task: woken for nothing it asks nothing and plans nothing",
          "[high_level][tasks]") {
  Planner planner;
  planner.order(OperatorOrder::kStart, kStart);
  planner.estimate(0.0, kStart);
  planner.see(1, kStart);
  CHECK(planner.after_step(kStart) == MissionState::kUnderWay);
  CHECK(all_of(planner.requests).size() == 1);
  for (int i = 1; i <= 20; ++i) {
    (void)planner.after_step(kStart + i * milliseconds{1});
  }
  CHECK(all_of(planner.requests).empty());
  CHECK(all_of(planner.plans).empty());
}

TEST_CASE("planner task: after a long absence it holds where it is and waits to be told",
          "[high_level][tasks]") {
  Planner planner;
  planner.estimate(0.0, kStart);
  planner.order(OperatorOrder::kStart, kStart);
  REQUIRE(planner.after_step(kStart) == MissionState::kUnderWay);
  Time now = kStart + kLongestAbsence;
  planner.estimate(1.0, now);
  CHECK(planner.after_step(now) == MissionState::kUnderWay);  // not yet
  now += kLongestAbsence + Duration{1};
  // It is held where the boat is, and so only once that is known again.
  CHECK(planner.after_step(now) == MissionState::kUnderWay);
  now += milliseconds{50};
  planner.estimate(3.0, now);
  CHECK(planner.after_step(now) == MissionState::kHolding);
  CHECK(planner.statuses.latest()->value.goal_y_m == Approx(3.0));
  now += milliseconds{50};
  planner.estimate(3.0, now);
  planner.order(OperatorOrder::kResume, now);
  CHECK(planner.after_step(now) == MissionState::kUnderWay);
}

TEST_CASE("planner task: a start or an abort after a long absence is obeyed",
          "[high_level][tasks]") {
  for (const auto& [order, state] : {std::pair{OperatorOrder::kStart, MissionState::kUnderWay},
                                     std::pair{OperatorOrder::kAbort, MissionState::kAborted}}) {
    Planner planner;
    planner.estimate(0.0, kStart);
    planner.order(OperatorOrder::kStart, kStart);
    REQUIRE(planner.after_step(kStart) == MissionState::kUnderWay);
    const Time now = kStart + 2 * kLongestAbsence;
    planner.estimate(0.0, now);
    planner.order(order, now);
    CHECK(planner.after_step(now) == state);
  }
}

TEST_CASE("planner task: it starts and aborts as it is told and stays aborted",
          "[high_level][tasks]") {
  Planner planner;
  planner.estimate(0.0, kStart);
  CHECK(planner.after_step(kStart) == MissionState::kIdle);
  planner.order(OperatorOrder::kStart, kStart);
  CHECK(planner.after_step(kStart) == MissionState::kUnderWay);
  planner.order(OperatorOrder::kAbort, kStart);
  CHECK(planner.after_step(kStart) == MissionState::kAborted);
  CHECK(planner.after_step(kStart + milliseconds{100}) == MissionState::kAborted);
}

TEST_CASE("planner task: orders from before it was made are not for it", "[high_level][tasks]") {
  const auto board = std::make_unique<Blackboard>();
  Writer<OperatorCommand> orders{board->operator_command, Role::kHigh, "operator_command"};
  orders.publish({OperatorOrder::kStart}, kStart);
  PlannerTask task{*board, Role::kHigh, paper_options()};
  task.step(kStart);
  Reader<MissionStatus> statuses{board->mission_status};
  REQUIRE(statuses.latest() != nullptr);
  CHECK(statuses.latest()->value.state == MissionState::kIdle);
}

TEST_CASE("planner task: a path is asked for in a fresh frame and in no other",
          "[high_level][tasks]") {
  Planner planner;
  planner.order(OperatorOrder::kStart, kStart);
  planner.estimate(0.0, kStart);
  CHECK(planner.after_step(kStart) == MissionState::kUnderWay);
  CHECK(planner.requests.next() == nullptr);  // no frame yet
  planner.see(1, kStart);
  const Time late = kStart + max_age::kSonarFrame + Duration{1};
  planner.estimate(0.0, late);
  CHECK(planner.after_step(late) == MissionState::kUnderWay);
  CHECK(planner.requests.next() == nullptr);  // it is stale
  planner.see(2, late);
  CHECK(planner.after_step(late) == MissionState::kUnderWay);
  const auto* request = planner.requests.next();
  REQUIRE(request != nullptr);
  CHECK(request->value.frame == 2);
}

TEST_CASE(
    "planner task: a goal is reached where the estimate says so and not where it is no number",
    "[high_level][tasks]") {
  Planner planner;
  planner.order(OperatorOrder::kStart, kStart);
  planner.estimate(0.0, kStart);
  CHECK(planner.after_step(kStart) == MissionState::kUnderWay);
  planner.estimate(kNaN, kStart);
  CHECK(planner.after_step(kStart) == MissionState::kUnderWay);
  planner.estimate(9.7, kStart);
  CHECK(planner.after_step(kStart) == MissionState::kReached);
}

TEST_CASE("planner task: a sonar that falls silent is said in a plan", "[high_level][tasks]") {
  Planner planner;
  planner.order(OperatorOrder::kStart, kStart);
  for (Time now = kStart; now < kStart + seconds{10}; now += milliseconds{100}) {
    planner.estimate(0.0, now);
    CHECK(planner.after_step(now) == MissionState::kUnderWay);
  }
  const auto* plan = planner.plans.latest();
  REQUIRE(plan != nullptr);
  CHECK(plan->value.waypoint_count == 0);
  CHECK(plan->value.source == WaypointSource::kNone);
}

TEST_CASE("planner task: it says when no way is made and that the thrusters are why",
          "[high_level][tasks]") {
  const struct {
    ThrustReason reason;
    NoWayCause cause;
  } rows[] = {{ThrustReason::kDeviceFailed, NoWayCause::kThrusters},
              {ThrustReason::kNoThrusters, NoWayCause::kThrusters},
              {ThrustReason::kDisarmed, NoWayCause::kDisarmed},
              {ThrustReason::kStopped, NoWayCause::kDisarmed}};
  for (const auto& row : rows) {
    Planner planner;
    planner.order(OperatorOrder::kStart, kStart);
    Writer<ThrustApplied> applied{planner.board->thrust_applied, Role::kLow, "thrust_applied"};
    Writer<Attitude> attitudes{planner.board->attitude, Role::kLow, "attitude"};
    ThrustApplied failed;
    failed.reason = row.reason;
    Time now = kStart;
    for (; now < kStart + seconds{16}; now += milliseconds{50}) {
      planner.estimate(0.0, now);
      applied.publish(failed, now);
      attitudes.publish({now, 0.0, 0.0}, now);
      CHECK(planner.after_step(now) == MissionState::kUnderWay);
      const NoWayCause said = planner.statuses.latest()->value.no_way;
      CHECK(said == (now - kStart < seconds{15} ? NoWayCause::kNone : row.cause));
    }
    CHECK(planner.statuses.latest()->value.no_way_since == kStart);
  }
}

namespace {

// Off since then, by what brought it there.
[[nodiscard]] ThrustStatus off_since(Time since, ThrustCause cause) {
  ThrustStatus status;
  status.cause = cause;
  status.since = since;
  return status;
}

}  // namespace

TEST_CASE("planner task: where a fault disarms under way the mission is over, and says so",
          "[high_level][tasks]") {
  for (const ThrustCause cause : {ThrustCause::kBoxLost, ThrustCause::kPowerUp}) {
    for (const bool holds : {false, true}) {
      Planner planner;
      Writer<ThrustStatus> arming{planner.board->thrust_status, Role::kLow, "thrust_status"};
      planner.order(OperatorOrder::kStart, kStart);
      CHECK(planner.after_step(kStart) == MissionState::kUnderWay);
      if (holds) {
        planner.order(OperatorOrder::kHold, kStart + seconds{1});
        CHECK(planner.after_step(kStart + seconds{1}) == MissionState::kHolding);
      }
      arming.publish(off_since(kStart + seconds{2}, cause), kStart + seconds{2});
      CHECK(planner.after_step(kStart + seconds{2}) == MissionState::kAborted);
      CHECK(planner.statuses.latest()->value.cause == MissionCause::kDisarmed);
      // What is still off when it is started again is that start's to arm.
      planner.order(OperatorOrder::kStart, kStart + seconds{3});
      CHECK(planner.after_step(kStart + seconds{3}) == MissionState::kUnderWay);
      CHECK(planner.statuses.latest()->value.cause == MissionCause::kOrder);
      CHECK(planner.after_step(kStart + seconds{4}) == MissionState::kUnderWay);
    }
  }
}

TEST_CASE(
    "planner task: thrusters that were off before, by a word or not there at all, end nothing",
    "[high_level][tasks]") {
  const Time later = kStart + seconds{2};
  const struct {
    ThrustStatus status;
    ThrustReason reason;
  } rows[] = {{off_since(kStart - seconds{1}, ThrustCause::kBoxLost), ThrustReason::kDisarmed},
              {off_since(later, ThrustCause::kOrder), ThrustReason::kDisarmed},
              {off_since(later, ThrustCause::kPowerUp), ThrustReason::kNoThrusters}};
  for (const auto& row : rows) {
    Planner planner;
    Writer<ThrustStatus> arming{planner.board->thrust_status, Role::kLow, "thrust_status"};
    Writer<ThrustApplied> applied{planner.board->thrust_applied, Role::kLow, "thrust_applied"};
    planner.order(OperatorOrder::kStart, kStart);
    CHECK(planner.after_step(kStart) == MissionState::kUnderWay);
    ThrustApplied neutral;
    neutral.reason = row.reason;
    applied.publish(neutral, later);
    arming.publish(row.status, later);
    CHECK(planner.after_step(later) == MissionState::kUnderWay);
  }
}

TEST_CASE(
    "planner task: a position that is lost is named in the plan with the time of the last fix",
    "[high_level][tasks]") {
  Planner planner;
  planner.order(OperatorOrder::kStart, kStart);
  Writer<Attitude> attitudes{planner.board->attitude, Role::kLow, "attitude"};
  Writer<PositionFix> fixes{planner.board->position_fix, Role::kLow, "position_fix"};
  PositionFix fix;
  fix.measured = kStart - seconds{3};
  fixes.publish(fix, kStart);
  planner.estimate(0.0, kStart);
  for (Time now = kStart; now < kStart + seconds{6}; now += milliseconds{50}) {
    attitudes.publish({now, 0.0, 0.0}, now);
    (void)planner.after_step(now);
  }
  const auto* plan = planner.plans.latest();
  REQUIRE(plan != nullptr);
  CHECK(plan->value.reason == PathReason::kNoPosition);
  CHECK(plan->value.lost_since == fix.measured);
}

}  // namespace
}  // namespace lodesman::testing
