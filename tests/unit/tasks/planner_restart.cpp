// SPDX-License-Identifier: Apache-2.0
// A planner on a blackboard that another one has left under way.
#include "high_level/tasks/planner.h"

#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

[[nodiscard]] PlannerOptions restart_options() {
  PlannerOptions options;
  options.replanner.replan_period = milliseconds{1600};
  options.replanner.answer_patience = seconds{1};
  options.replanner.waypoint_interval_m = 1.3;
  options.mission.waypoint_radius_m = 0.5;
  options.progress = {seconds{15}, 0.5};
  return options;
}

// What the one before left: it had started a mission, and was making for the second goal.
struct LeftBoard {
  explicit LeftBoard(OnRestart policy) {
    MissionDefinition mission = mission_through({{0.0, 5.0}, {0.0, 20.0}});
    mission.on_restart = policy;
    definitions.publish(mission, kStart);
    said.state = MissionState::kUnderWay;
    said.mission = mission.id;
    said.started = said.first_started = kStart;
    said.goal_index = 1;
    said.goal_y_m = 20.0;
    said.order = 1;
    orders.publish({OperatorOrder::kStart, 0, 1}, kStart);
  }
  void arming(ThrustState which) {
    ThrustStatus status;
    status.state = which;
    arming_out.publish(status, kStart);
  }
  // A planner that comes so long after the last word.
  void succeed(Duration silence) {
    {
      Writer<MissionStatus> last{board->mission_status, Role::kHigh, "mission_status"};
      last.publish(said, kStart);
    }
    now = kStart + silence;
    task.emplace(*board, Role::kHigh, restart_options());
  }
  void estimate(double y_m) {
    VehicleState here;
    here.valid_at = now;
    here.y_m = y_m;
    state.publish(here, now);
  }
  [[nodiscard]] MissionStatus after_step() {
    task->step(now);
    const auto* newest = statuses.latest();
    REQUIRE(newest != nullptr);
    CHECK(newest->stamp == now);
    now += milliseconds{50};
    return newest->value;
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  MissionStatus said;
  Time now{};
  std::optional<PlannerTask> task;
  Writer<VehicleState> state{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Writer<MissionDefinition> definitions{board->mission_definition, Role::kHigh, "definitions"};
  Writer<OperatorCommand> orders{board->operator_command, Role::kHigh, "operator_command"};
  Writer<ThrustStatus> arming_out{board->thrust_status, Role::kLow, "thrust_status"};
  Reader<MissionStatus> statuses{board->mission_status};
};

TEST_CASE("planner restart: a mission that says so is sailed on with, at its goal",
          "[high_level][tasks]") {
  LeftBoard left{OnRestart::kResume};
  left.arming(ThrustState::kArmed);
  left.succeed(seconds{1});
  left.estimate(8.0);
  const MissionStatus status = left.after_step();
  CHECK(status.state == MissionState::kUnderWay);
  CHECK(status.cause == MissionCause::kRestart);
  CHECK(status.goal_y_m == Approx(20.0));
  CHECK(status.started == kStart);
  left.estimate(19.8);
  CHECK(left.after_step().state == MissionState::kReached);
}

TEST_CASE("planner restart: a mission that says hold is held where the boat is, once that is known",
          "[high_level][tasks]") {
  LeftBoard left{OnRestart::kHold};
  left.said.keeps_line = true;
  left.said.cross_track_m = 3.0;
  left.succeed(seconds{1});
  CHECK(left.after_step().state == MissionState::kUnderWay);  // and steers by nothing
  left.estimate(8.0);
  const MissionStatus held = left.after_step();
  CHECK_FALSE(held.keeps_line);
  CHECK(held.cross_track_m == Approx(0.0));
  CHECK(held.state == MissionState::kHolding);
  CHECK(held.cause == MissionCause::kRestart);
  CHECK(held.goal_y_m == Approx(8.0));
  left.estimate(8.0);
  left.orders.publish({OperatorOrder::kResume, 0, 1}, left.now);
  const MissionStatus resumed = left.after_step();
  CHECK(resumed.state == MissionState::kUnderWay);
  CHECK(resumed.goal_y_m == Approx(20.0));
}

TEST_CASE("planner restart: after too long, or with an order open, it holds whatever it says",
          "[high_level][tasks]") {
  LeftBoard late{OnRestart::kResume};
  late.succeed(kLongestAbsence + Duration{1});
  late.estimate(8.0);
  const MissionStatus absent = late.after_step();
  CHECK(absent.state == MissionState::kHolding);
  CHECK(absent.cause == MissionCause::kAbsence);

  LeftBoard ordered{OnRestart::kResume};
  ordered.orders.publish({OperatorOrder::kHold, 0, 1}, kStart);
  ordered.succeed(seconds{1});
  ordered.estimate(8.0);
  CHECK(ordered.after_step().state == MissionState::kHolding);
}

TEST_CASE("planner restart: an abort that was ordered and not obeyed stands, and so do the latches",
          "[high_level][tasks]") {
  LeftBoard aborted{OnRestart::kResume};
  aborted.orders.publish({OperatorOrder::kAbort, 1, 1}, kStart);
  aborted.succeed(seconds{1});
  aborted.estimate(8.0);
  CHECK(aborted.after_step().state == MissionState::kAborted);
  for (const ThrustState off : {ThrustState::kDisarmed, ThrustState::kStopped}) {
    LeftBoard left{OnRestart::kResume};
    left.arming(off);
    left.succeed(seconds{1});
    left.estimate(8.0);
    CHECK(left.after_step().state == MissionState::kAborted);
    left.estimate(8.0);
    CHECK(left.after_step().state == MissionState::kAborted);
  }
}

TEST_CASE("planner restart: a mission whose definition is gone is not taken up",
          "[high_level][tasks]") {
  LeftBoard left{OnRestart::kResume};
  left.said.mission = 17;
  left.succeed(seconds{1});
  left.estimate(8.0);
  CHECK(left.after_step().state == MissionState::kIdle);
}

TEST_CASE("planner restart: a place that was held is held on", "[high_level][tasks]") {
  LeftBoard left{OnRestart::kResume};
  left.said.state = MissionState::kHolding;
  left.said.goal_y_m = 6.0;
  left.succeed(2 * kLongestAbsence);
  left.estimate(9.0);
  const MissionStatus held = left.after_step();
  CHECK(held.state == MissionState::kHolding);
  CHECK(held.cause == MissionCause::kOrder);
  CHECK(held.goal_y_m == Approx(6.0));
}

}  // namespace
}  // namespace lodesman::testing
