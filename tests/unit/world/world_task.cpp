// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/world_task.h"

#include <array>
#include <memory>
#include <set>

#include "hal_sim/devices/sim_thruster_pair.h"
#include "tests/support/catch.h"
#include "tests/support/shipped_vessel.h"

namespace lodesman {
namespace {

using std::chrono::milliseconds;
using testing::kGoodScenario;
using testing::scenario_of;
using testing::shipped_vessel;

// A world with its task, a mission that can be started and a thruster box, on a time of its own.
struct Bench {
  explicit Bench(const std::string& more = "")
      : scenario{scenario_of(kGoodScenario.substr(0, kGoodScenario.find("[[obstacle]]")) + more)},
        task{scenario, shipped_vessel(), *board, *link},
        box{scenario, *link},
        mission{board->mission_status, Role::kHigh, "mission_status"},
        truths{board->world_truth},
        samples{link->world} {}

  void start() {
    MissionStatus status;
    status.state = MissionState::kUnderWay;
    status.first_started = status.started = now;
    mission.publish(status, now);
  }
  void run_for(Duration span) {
    for (const Time end = now + span; now < end;) {
      now += milliseconds{20};
      task.step(now);
    }
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  std::unique_ptr<SimLink> link = std::make_unique<SimLink>();
  Scenario scenario;
  WorldTask task;
  SimThrusterPair box;
  Writer<MissionStatus> mission;
  Reader<WorldTruth> truths;
  Reader<WorldSample> samples;
  Time now{std::chrono::seconds{100}};
};

TEST_CASE("world task: before mission and thrust the boat lies at its start and no time passes",
          "[hal_sim][world]") {
  Bench bench{"[environment]\ncurrent_m_s = [0.5, 0.0]\n"};
  REQUIRE(bench.box.command(kNeutralThrust, bench.now) == CommandStatus::kTaken);
  bench.run_for(std::chrono::seconds{2});
  const auto* truth = bench.truths.latest();
  REQUIRE(truth != nullptr);
  CHECK(truth->stamp == bench.now);
  CHECK(truth->sequence == 100);
  CHECK(truth->value.scenario_time_s == Approx(0.0).margin(0.0));
  CHECK(truth->value.x_m == Approx(0.0).margin(0.0));
  CHECK(bench.samples.latest()->value.started == 0);
}

TEST_CASE("world task: it rings for those tasks whose device has a sample to be polled",
          "[hal_sim][world]") {
  Bench bench;
  const auto rings_of_step = [&] {
    std::array<std::uint32_t, kTaskCount> before{};
    for (std::size_t i = 0; i < kTaskCount; ++i) {
      before[i] = look_at(bench.board->bells[i]);
    }
    bench.run_for(milliseconds{20});
    std::set<TaskId> rung;
    for (std::size_t i = 0; i < kTaskCount; ++i) {
      if (look_at(bench.board->bells[i]) != before[i]) {
        rung.insert(static_cast<TaskId>(i));
      }
    }
    return rung;
  };
  CHECK(rings_of_step() == std::set{TaskId::kAhrs, TaskId::kPosition, TaskId::kDeltaT});
  bench.link->position_due.next_at(bench.now + std::chrono::seconds{1});
  bench.link->sonar_due.next_at(bench.now + milliseconds{40});
  CHECK(rings_of_step() == std::set{TaskId::kAhrs});
  CHECK(rings_of_step() == std::set{TaskId::kAhrs, TaskId::kDeltaT});
}

TEST_CASE("world task: scenario time counts from the mission's start", "[hal_sim][world]") {
  Bench bench;
  bench.run_for(std::chrono::seconds{2});
  bench.start();
  bench.run_for(std::chrono::seconds{1});
  CHECK(bench.task.truth().scenario_time_s == Approx(1.0));
  const auto* sample = bench.samples.latest();
  REQUIRE(sample != nullptr);
  CHECK(sample->value.started == 1);
  CHECK(sample->value.scenario_time_s == Approx(1.0));
  CHECK(sample->value.stamp == bench.now);
  bench.start();
  bench.run_for(milliseconds{500});
  CHECK(bench.task.truth().scenario_time_s == Approx(0.5));
}

TEST_CASE("world task: the boat moves by the box's last command, until the box's time-out",
          "[hal_sim][world]") {
  Bench bench;
  bench.start();
  for (int i = 0; i < 600; ++i) {
    REQUIRE(bench.box.command({164, 164}, bench.now) == CommandStatus::kTaken);
    bench.run_for(milliseconds{20});
  }
  const double held_m_s = bench.task.truth().surge_m_s;
  CHECK(held_m_s == Approx(0.222).epsilon(0.02));
  bench.run_for(milliseconds{900});
  CHECK(bench.task.truth().surge_m_s == Approx(held_m_s).epsilon(0.01));
  bench.run_for(std::chrono::seconds{20});
  CHECK(bench.task.truth().surge_m_s < 0.01);
}

TEST_CASE("world task: thrust by hand moves the boat before a mission, and no scenario time passes",
          "[hal_sim][world]") {
  Bench bench;
  bench.run_for(std::chrono::seconds{2});
  for (int i = 0; i < 100; ++i) {
    REQUIRE(bench.box.command({200, 200}, bench.now) == CommandStatus::kTaken);
    bench.run_for(milliseconds{20});
  }
  const double moved_m = bench.task.truth().y_m;
  CHECK(moved_m > 0.1);
  CHECK(bench.task.truth().scenario_time_s == Approx(0.0).margin(0.0));
  CHECK(bench.samples.latest()->value.started == 0);
  REQUIRE(bench.box.command(kNeutralThrust, bench.now) == CommandStatus::kTaken);
  bench.run_for(std::chrono::seconds{1});
  CHECK(bench.task.truth().y_m > moved_m + 0.05);  // it is afloat, and goes on
}

TEST_CASE("world task: what devices sense says how hard the thrusters work", "[hal_sim][world]") {
  Bench bench;
  const auto load_under = [&bench](ThrustCommand command) {
    REQUIRE(bench.box.command(command, bench.now) == CommandStatus::kTaken);
    bench.run_for(milliseconds{20});
    return bench.samples.latest()->value.thrust_load;
  };
  CHECK(load_under(kNeutralThrust) == Approx(0.0).margin(1e-3));
  CHECK(load_under({255, 255}) == Approx(1.0));
  CHECK(load_under({255, 128}) == Approx(0.5));
  CHECK(load_under({64, 192}) == Approx(0.25).margin(0.01));  // half astern, half ahead
}

TEST_CASE("world task: late and missed steps lose no time", "[hal_sim][world]") {
  Bench regular;
  Bench late;
  regular.start();
  late.start();
  for (int i = 0; i < 50; ++i) {
    REQUIRE(regular.box.command({200, 180}, regular.now) == CommandStatus::kTaken);
    REQUIRE(late.box.command({200, 180}, late.now) == CommandStatus::kTaken);
    regular.run_for(milliseconds{100});
    late.now += milliseconds{37};
    late.task.step(late.now);
    late.now += milliseconds{63};
    late.task.step(late.now);
  }
  CHECK(late.task.truth().x_m == Approx(regular.task.truth().x_m).epsilon(1e-3));
  CHECK(late.task.truth().y_m == Approx(regular.task.truth().y_m).epsilon(1e-3));
  CHECK(late.task.truth().scenario_time_s == Approx(regular.task.truth().scenario_time_s));
}

TEST_CASE("world task: the nearest there was since the start stays known, and no longer",
          "[hal_sim][world]") {
  Bench bench{
      "[[obstacle]]\nshape = \"circle\"\ncentre_m = [0.0, 20.0]\nradius_m = 0.5\n"
      "protection_m = 1.0\nvelocity_m_s = [0.0, -2.0]\n"};
  bench.run_for(std::chrono::seconds{2});
  bench.start();
  double least_m = 1e9;
  double at_s = 0.0;
  double hull_m = 1e9;
  for (int i = 0; i < 1000; ++i) {
    bench.run_for(milliseconds{20});
    const WorldTruth& truth = bench.task.truth();
    if (truth.inoffensive_distance_m < least_m) {
      least_m = truth.inoffensive_distance_m;
      at_s = truth.scenario_time_s;
    }
    hull_m = std::min(hull_m, truth.hull_clearance_m);
  }
  const WorldTruth passed = bench.truths.latest()->value;
  REQUIRE(passed.inoffensive_distance_m > 10.0);  // it came, and it went on
  CHECK(passed.least_inoffensive_distance_m < 0.0);
  CHECK(passed.least_inoffensive_distance_m == Approx(least_m).margin(0.0));
  CHECK(passed.least_inoffensive_distance_at_s == Approx(at_s).margin(0.0));
  CHECK(passed.least_hull_clearance_m == Approx(hull_m).margin(0.0));
  bench.start();
  bench.run_for(milliseconds{20});
  CHECK(bench.truths.latest()->value.least_inoffensive_distance_m > 10.0);
  CHECK(bench.truths.latest()->value.least_inoffensive_distance_at_s < 0.1);
}

TEST_CASE("world task: one world to a blackboard", "[hal_sim][world]") {
  Bench bench;
  SimLink other;
  CHECK_THROWS_AS((WorldTask{bench.scenario, shipped_vessel(), *bench.board, other}), StartupError);
}

TEST_CASE("world task: the truth says what the propellers run at, the box's time-out included",
          "[hal_sim][world]") {
  Bench bench;
  bench.start();
  REQUIRE(bench.box.command({200, 90}, bench.now) == CommandStatus::kTaken);
  bench.run_for(kBoxTimeOut);
  CHECK(int{bench.truths.latest()->value.thrust_left} == 200);
  CHECK(int{bench.truths.latest()->value.thrust_right} == 90);
  bench.run_for(milliseconds{20});
  CHECK(int{bench.truths.latest()->value.thrust_left} == int{kNeutralThrust.left});
  CHECK(int{bench.truths.latest()->value.thrust_right} == int{kNeutralThrust.right});
}

TEST_CASE("world task: on the blackboard of a world that died the boat lies where that left it",
          "[hal_sim][world]") {
  Bench bench;
  bench.start();
  for (int i = 0; i < 10; ++i) {
    REQUIRE(bench.box.command({255, 200}, bench.now) == CommandStatus::kTaken);
    bench.run_for(milliseconds{500});
  }
  const WorldTruth last = bench.truths.latest()->value;
  REQUIRE(last.y_m > 1.0);
  // As SharedBlackboard::create() does with the claims of the dead.
  REQUIRE(bench.board->world_truth.release_claim_of(Role::kLow));
  const auto link = std::make_unique<SimLink>();
  const WorldTask successor{bench.scenario, shipped_vessel(), *bench.board, *link};
  CHECK(successor.truth().x_m == Approx(last.x_m));
  CHECK(successor.truth().y_m == Approx(last.y_m));
  CHECK(successor.truth().heading_rad == Approx(last.heading_rad));
}

TEST_CASE("world task: round a real boat the world is where the estimate is, and tells no truth",
          "[hal_sim][world]") {
  const auto board = std::make_unique<Blackboard>();
  const auto link = std::make_unique<SimLink>();
  const Scenario scenario = scenario_of(kGoodScenario);
  WorldTask task{scenario, shipped_vessel(), *board, *link, WorldTask::MovedBy::kEstimate};
  Writer<VehicleState> states{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Reader<WorldSample> samples{link->world};
  Reader<WorldTruth> truths{board->world_truth};
  Time now{std::chrono::seconds{100}};
  task.step(now);
  CHECK(samples.latest() == nullptr);  // nobody knows where it is
  VehicleState here;
  here.valid_at = now;
  here.x_m = 3.0;
  here.y_m = -7.0;
  here.heading_rad = 1.0;
  states.publish(here, now);
  task.step(now + milliseconds{20});
  REQUIRE(samples.latest() != nullptr);
  CHECK(samples.latest()->value.x_m == Approx(3.0));
  CHECK(samples.latest()->value.y_m == Approx(-7.0));
  CHECK(samples.latest()->value.heading_rad == Approx(1.0));
  CHECK(samples.latest()->sequence == 1);
  task.step(now + max_age::kVehicleState + milliseconds{1});
  CHECK(samples.latest()->sequence == 1);  // nor any more
  CHECK(truths.latest() == nullptr);
}

}  // namespace
}  // namespace lodesman
