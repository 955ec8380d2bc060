// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/watcher.h"

#include <memory>

#include "deploy/boat/configuration.h"
#include "deploy/boat/named_scenario.h"
#include "deploy/boat/voyage.h"
#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::cli;
using std::chrono::milliseconds;

namespace {

Scenario straight() {
  Scenario scenario;
  MissionDefinition& mission = scenario.mission.definition;
  mission.goal_count = 2;
  mission.goals[0] = {0.0, 10.0};
  mission.goals[1] = {10.0, 10.0};
  scenario.vehicle_radius_m = 0.5;
  return scenario;
}

// A blackboard that the test writes by hand, and a watcher of it.
struct Bench {
  void start() {
    MissionStatus status;
    status.state = MissionState::kUnderWay;
    status.first_started = status.started = started;
    mission.publish(status, started);
  }
  void end(MissionState state) {
    MissionStatus status;
    status.state = state;
    status.first_started = status.started = started;
    status.ended = now;
    mission.publish(status, now);
  }
  // A boat that makes 1 m/s north, with the world's account of what it was near to.
  void truth(double distance_m, double hull_m) {
    WorldTruth truth;
    truth.scenario_time_s = to_seconds(now - started);
    truth.y_m = truth.scenario_time_s;
    truth.inoffensive_distance_m = distance_m;
    truth.hull_clearance_m = hull_m;
    if (distance_m < least_m) {
      least_m = distance_m;
      least_at_s = truth.scenario_time_s;
    }
    least_hull_m = std::min(least_hull_m, hull_m);
    truth.least_inoffensive_distance_m = least_m;
    truth.least_inoffensive_distance_at_s = least_at_s;
    truth.least_hull_clearance_m = least_hull_m;
    truths.publish(truth, now);
    now += milliseconds{20};
  }
  void plan(PathReason reason, PlanRung rung = PlanRung::kOnRoute) {
    Plan made;
    made.rung = rung;
    made.id = ++plan_id;
    made.reason = reason;
    made.captured = now;
    plans.publish(made, now);
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Writer<MissionStatus> mission{board->mission_status, Role::kHigh, "mission_status"};
  Writer<WorldTruth> truths{board->world_truth, Role::kLow, "world_truth"};
  Writer<Plan> plans{board->plan, Role::kHigh, "plan"};
  Time started{std::chrono::seconds{100}};
  Time now = started;
  double least_m = std::numeric_limits<double>::infinity();
  double least_at_s = 0.0;
  double least_hull_m = std::numeric_limits<double>::infinity();
  std::uint64_t plan_id = 0;
  RunWatcher watcher{*board, straight(), 0.5};
};

}  // namespace

TEST_CASE("watcher: before anything has happened the record has the boat at its start", "[run]") {
  Bench bench;
  bench.watcher.poll();
  const RunRecord record = bench.watcher.finish();
  CHECK(record.result.outcome == "time_limit");
  CHECK(record.result.goal_error_m == Approx(std::hypot(10.0, 10.0)));
  CHECK_FALSE(record.result.min_inoffensive_distance_m.has_value());
  CHECK(record.trajectory.empty());
  CHECK(bench.watcher.mission_started() == Time{});
}

TEST_CASE("watcher: held up for longer than the ring lasts it still knows of the collision",
          "[run]") {
  Bench bench;
  bench.start();
  bench.truth(5.0, 4.5);
  bench.watcher.poll();
  constexpr int kUnseen = 1000;  // 20 s, of which the ring has the last 256 samples
  for (int i = 0; i < kUnseen; ++i) {
    bench.truth(i == 100 ? -0.145 : 5.0, i == 110 ? -0.3 : 4.5);
  }
  bench.watcher.poll();
  const RunResult result = bench.watcher.finish().result;
  CHECK(result.outcome == "collision");
  CHECK(result.collided);
  CHECK(result.min_inoffensive_distance_m.value_or(9.0) == Approx(-0.145));
  CHECK(result.time_of_min_inoffensive_distance_s.value_or(0.0) == Approx(101 * 0.02));
  CHECK(result.min_hull_clearance_m.value_or(9.0) == Approx(-0.3));
  CHECK(result.truths_missed == kUnseen - 256);
  CHECK(result.path_length_m == Approx(20.0).epsilon(1e-6));
}

TEST_CASE("watcher: without obstacles there is no least distance", "[run]") {
  Bench bench;
  bench.start();
  for (int i = 0; i < 10; ++i) {
    bench.truth(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
  }
  bench.watcher.poll();
  const RunResult result = bench.watcher.finish().result;
  CHECK_FALSE(result.min_inoffensive_distance_m.has_value());
  CHECK_FALSE(result.time_of_min_inoffensive_distance_s.has_value());
  CHECK_FALSE(result.min_hull_clearance_m.has_value());
}

TEST_CASE("watcher: a rung lasts until the next plan or the mission's end", "[run]") {
  Bench bench;
  bench.plan(PathReason::kFound, PlanRung::kStop);
  bench.start();
  const auto sail = [&](int truths) {
    for (int i = 0; i < truths; ++i) {
      bench.truth(5.0, 4.5);
    }
    bench.watcher.poll();
  };
  sail(10);
  bench.plan(PathReason::kFound);
  sail(100);
  bench.plan(PathReason::kFound, PlanRung::kAside);
  sail(50);
  bench.plan(PathReason::kFound);
  sail(25);
  bench.end(MissionState::kReached);
  bench.now += milliseconds{100};
  bench.plan(PathReason::kFound, PlanRung::kHold);
  bench.watcher.poll();
  const auto rungs = bench.watcher.finish().result.rung_s;
  REQUIRE(rungs.size() == 3);
  CHECK(rungs.at("stop") == Approx(0.2));
  CHECK(rungs.at("on_route") == Approx(2.5));
  CHECK(rungs.at("aside") == Approx(1.0));
}

TEST_CASE("watcher: a row every tenth of a second and every plan are handed on at once", "[run]") {
  Bench bench;
  std::vector<double> rows_s;
  std::vector<std::uint64_t> plans;
  bench.watcher.on_row = [&](const TrajectoryRow& row) { rows_s.push_back(row.t_s); };
  bench.watcher.on_plan = [&](const Plan& plan, const SonarPath*, const PlanRecord& record) {
    CHECK(plan.id == record.id);
    plans.push_back(record.id);
  };
  bench.start();
  for (int i = 0; i < 50; ++i) {
    bench.plan(i % 2 == 0 ? PathReason::kFound : PathReason::kNoPath);
    bench.truth(5.0, 4.5);
    bench.watcher.poll();
  }
  REQUIRE(rows_s.size() == 10);
  CHECK(rows_s[3] == Approx(0.3));
  CHECK(plans.size() == 50);
  const RunRecord record = bench.watcher.finish();
  CHECK(record.result.plans_found == 25);
  CHECK(record.result.plans_not_found == 25);
  CHECK(record.result.plan_reasons.at("no_path") == 25);
  CHECK(record.trajectory.size() == 10);
  CHECK(record.plans.size() == 50);
  CHECK(record.result.plans_missed == 0);
}

TEST_CASE("watcher: what it keeps of a long run is bounded", "[run]") {
  Bench bench;
  std::size_t rows = 0;
  bench.watcher.on_row = [&](const TrajectoryRow&) { ++rows; };
  bench.start();
  for (int i = 0; i < 400'000; ++i) {
    if (i % 5 == 0) {
      bench.plan(PathReason::kFound);
    }
    bench.truth(5.0, 4.5);
    if (i % 10 == 0) {
      bench.watcher.poll();
    }
  }
  bench.watcher.poll();
  const RunRecord record = bench.watcher.finish();
  CHECK(rows == 80'000);
  CHECK(record.result.plans == 80'000);
  CHECK(record.trajectory.size() <= 36'001);
  CHECK(record.plans.size() <= 2048);
  CHECK(record.result.time_s == Approx(8000.0).epsilon(1e-4));
}

TEST_CASE("watcher: the way left follows the mission's next waypoint", "[run]") {
  Bench bench;
  bench.start();
  bench.truth(5.0, 4.5);
  bench.watcher.poll();
  CHECK(bench.watcher.progress().to_go_m == Approx(20.0));
  MissionStatus status;
  status.state = MissionState::kUnderWay;
  status.first_started = status.started = bench.started;
  status.goal_index = 1;
  bench.mission.publish(status, bench.now);
  bench.watcher.poll();
  CHECK(bench.watcher.progress().to_go_m == Approx(std::hypot(10.0, 10.0)));
  CHECK(bench.watcher.mission_started() == bench.started);
}

TEST_CASE("watcher: the end of the mission is the end of the record", "[run]") {
  Bench bench;
  bench.start();
  for (int i = 0; i < 50; ++i) {
    bench.truth(5.0, 4.5);
  }
  bench.end(MissionState::kReached);
  bench.watcher.poll();
  CHECK(bench.watcher.mission_ended());
  bench.truth(-1.0, -1.0);
  bench.watcher.poll();
  const RunResult result = bench.watcher.finish().result;
  CHECK(result.outcome == "goal");
  CHECK(result.reached);
  CHECK(result.time_s == Approx(1.0));
  CHECK(result.min_inoffensive_distance_m.value_or(0.0) == Approx(5.0));
}
