// SPDX-License-Identifier: Apache-2.0
// How the planner task takes orders; how it plans has tests of its own.
#include "high_level/tasks/planner.h"

#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

using namespace lodesman;
using std::chrono::milliseconds;

namespace {

struct PlannerBench {
  PlannerBench() { definitions.publish(testing::mission_through({{0, 100}}), now); }
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
  Writer<MissionDefinition> definitions{board->mission_definition, Role::kHigh, "definitions"};
  Writer<OperatorCommand> orders{board->operator_command, Role::kHigh, "operator_command"};
  Writer<VehicleState> states{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Reader<MissionStatus> statuses{board->mission_status};
};

}  // namespace

TEST_CASE("planner task: an abort that a thousand orders overwrote is obeyed at the next step",
          "[high_level][tasks]") {
  PlannerBench bench;
  PlannerTask planner{*bench.board, Role::kHigh, PlannerOptions{}};
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
    PlannerTask planner{*bench.board, Role::kHigh, PlannerOptions{}};
    const MissionStatus status = bench.step(planner);
    CHECK(status.state == (aborted ? MissionState::kAborted : MissionState::kIdle));
    CHECK(status.aborts == bench.aborts);
    CHECK(status.order == 0);
  }
}

TEST_CASE("planner task: an abort stands over a restart, until a new start",
          "[high_level][tasks]") {
  PlannerBench bench;
  {
    PlannerTask planner{*bench.board, Role::kHigh, PlannerOptions{}};
    bench.order(OperatorOrder::kStart);
    CHECK(bench.step(planner).state == MissionState::kUnderWay);
    bench.order(OperatorOrder::kAbort);
    CHECK(bench.step(planner).state == MissionState::kAborted);
  }
  PlannerTask restarted{*bench.board, Role::kHigh, PlannerOptions{}};
  CHECK(bench.step(restarted).state == MissionState::kAborted);
  bench.order(OperatorOrder::kStart);
  CHECK(bench.step(restarted).state == MissionState::kUnderWay);
}

TEST_CASE("planner task: a start without any mission is refused", "[high_level][tasks]") {
  PlannerBench bench;
  const auto empty = std::make_unique<Blackboard>();
  PlannerTask planner{*empty, Role::kHigh, PlannerOptions{}};
  Writer<OperatorCommand>{empty->operator_command, Role::kHigh, "orders"}.publish(
      {OperatorOrder::kStart}, bench.now);
  planner.step(bench.now);
  Reader<MissionStatus> statuses{empty->mission_status};
  CHECK(statuses.latest()->value.state == MissionState::kIdle);
  CHECK(statuses.latest()->value.answer == OrderAnswer::kNoMission);
}

TEST_CASE("planner task: a mission is sailed at its speed, and no faster than the limit",
          "[high_level][tasks]") {
  PlannerBench bench;
  PlannerOptions options;
  options.mission.speeds = SpeedTable::proportional(0.01);
  PlannerTask planner{*bench.board, Role::kHigh, options};
  bench.order(OperatorOrder::kStart);
  CHECK(bench.step(planner).surge_ref == 22);
  Writer<Tunables> tunables{bench.board->tunables, Role::kHigh, "tunables"};
  Tunables slower{.version = 1, .speed_limit_m_s = 0.1};
  tunables.publish(slower, bench.now);
  CHECK(bench.step(planner).surge_ref == 10);
  slower = {.version = 2, .speed_limit_m_s = 1.0};
  tunables.publish(slower, bench.now);
  CHECK(bench.step(planner).surge_ref == 22);
}
