// SPDX-License-Identifier: Apache-2.0
// How the planner task takes orders; how it plans has tests of its own.
#include "high_level/tasks/planner.h"

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;

namespace {

PlannerOptions planner_options(bool start_by_itself = false) {
  PlannerOptions options;
  options.mission.goals = {{{0, 100}}};
  options.mission.goal_radius_m = 0.5;
  options.sonar_range_m = 30.0;
  options.start_by_itself = start_by_itself;
  return options;
}

struct PlannerBench {
  void order(OperatorOrder order) {
    aborts += order == OperatorOrder::kAbort ? 1 : 0;
    orders.publish({order, aborts}, now);
  }
  MissionStatus step(PlannerTask& planner) {
    now += milliseconds{50};
    VehicleState state;
    state.valid_at = now;
    states.publish(state, now);
    planner.step(now);
    return statuses.latest()->value;
  }

  Time now{std::chrono::seconds{100}};
  std::uint64_t aborts = 0;
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Writer<OperatorCommand> orders{board->operator_command, Role::kHigh, "operator_command"};
  Writer<VehicleState> states{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Reader<MissionStatus> statuses{board->mission_status};
};

}  // namespace

TEST_CASE("planner task: an abort that a thousand orders overwrote is obeyed at the next step",
          "[high_level][tasks]") {
  PlannerBench bench;
  PlannerTask planner{*bench.board, Role::kHigh, planner_options()};
  bench.order(OperatorOrder::kStart);
  REQUIRE(bench.step(planner).state == MissionState::kUnderWay);
  bench.order(OperatorOrder::kAbort);
  for (int i = 0; i < 1000; ++i) {
    bench.order(i % 2 == 0 ? OperatorOrder::kStart : OperatorOrder::kHold);
  }
  const MissionStatus status = bench.step(planner);
  CHECK(status.state == MissionState::kAborted);
  CHECK(status.aborts == 1);
  CHECK(status.order == 1002);
  CHECK(status.answer == OrderAnswer::kAborted);
  bench.order(OperatorOrder::kStart);
  CHECK(bench.step(planner).state == MissionState::kUnderWay);
}

TEST_CASE("planner task: no order of before its start is obeyed, but an abort stands",
          "[high_level][tasks]") {
  for (const bool aborted : {false, true}) {
    PlannerBench bench;
    bench.order(OperatorOrder::kStart);
    if (aborted) {
      bench.order(OperatorOrder::kAbort);
    }
    PlannerTask planner{*bench.board, Role::kHigh, planner_options()};
    const MissionStatus status = bench.step(planner);
    CHECK(status.state == (aborted ? MissionState::kAborted : MissionState::kIdle));
    CHECK(status.aborts == bench.aborts);
    CHECK(status.order == 0);
  }
}

TEST_CASE("planner task: one that starts by itself does not after an abort",
          "[high_level][tasks]") {
  PlannerBench bench;
  {
    PlannerTask planner{*bench.board, Role::kHigh, planner_options(true)};
    CHECK(bench.step(planner).state == MissionState::kUnderWay);
    bench.order(OperatorOrder::kAbort);
    CHECK(bench.step(planner).state == MissionState::kAborted);
  }
  PlannerTask restarted{*bench.board, Role::kHigh, planner_options(true)};
  CHECK(bench.step(restarted).state == MissionState::kAborted);
  bench.order(OperatorOrder::kStart);
  CHECK(bench.step(restarted).state == MissionState::kUnderWay);
}

TEST_CASE("planner task: an abort before there is an estimate calls off its own start",
          "[high_level][tasks]") {
  PlannerBench bench;
  PlannerTask planner{*bench.board, Role::kHigh, planner_options(true)};
  planner.step(bench.now);
  CHECK(bench.statuses.latest()->value.state == MissionState::kIdle);
  bench.order(OperatorOrder::kAbort);
  planner.step(bench.now);
  CHECK(bench.step(planner).state == MissionState::kAborted);
}
