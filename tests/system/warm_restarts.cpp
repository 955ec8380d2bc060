// SPDX-License-Identifier: Apache-2.0
// A process killed under way and started again: what becomes of the mission, of the latches and of
// the estimate. Judged by what was published, never by how long it took.
#include <cmath>

#include "high_level/mission/token_file.h"
#include "tests/system/listening_port.h"
#include "tests/system/program.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// Under way in the default profile, by noisy fixes.
struct BoatUnderWay {
  explicit BoatUnderWay(const std::string& name, const std::string& on_restart = "resume")
      : scratch{name},
        boat{scratch, "default",
             scenario_text(60.0, 200.0, on_restart) + "[position]\nsource = \"gps\"\n"} {
    REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  }
  void kill_high() {
    REQUIRE(kill(boat.high->pid(), SIGKILL) == 0);
    REQUIRE(eventually([&] { return boat.high->ended().has_value(); }));
  }
  void kill_low() {
    REQUIRE(kill(boat.low->pid(), SIGKILL) == 0);
    REQUIRE(eventually([&] { return boat.low->ended().has_value(); }));
  }
  [[nodiscard]] MissionStatus status() { return await_first(mission).value; }
  // Thrust by a command that was given after that.
  [[nodiscard]] bool drives_since(Time event) {
    return eventually([&] {
      const auto* newest = thrust.latest();
      return drives(newest) && newest->value.command_stamp > event;
    });
  }
  [[nodiscard]] int tell(const std::vector<std::string>& words) {
    std::uint16_t port = 0;
    REQUIRE(eventually([&] {
      port = static_cast<std::uint16_t>(listening_port(boat.high->pid()));
      return port != 0 && find_token_file(port).has_value();
    }));
    auto all = words;
    all.insert(all.end(), {"--port", std::to_string(port), "--quiet"});
    ChildProcess teller{"lodesman", all};
    REQUIRE(eventually([&] { return teller.ended().has_value(); }));
    return teller.exit_status().value_or(-1);
  }

  Scratch scratch;
  Boat boat;
  SharedBlackboard board = SharedBlackboard::observe(boat.segment, kPatience);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  Reader<MissionStatus> mission{board->mission_status};
};

// How far the odometry pose is from the truth of its own time.
class OdometryAgainstTruth {
 public:
  explicit OdometryAgainstTruth(const SharedBlackboard& board)
      : truth_{board->world_truth}, states_{board->vehicle_state} {}
  struct Look {
    Time at{};
    Eigen::Vector2d off_m = Eigen::Vector2d::Zero();
    VehicleState state;
  };
  // Of the first estimate later than that.
  [[nodiscard]] Look after(Time event) {
    Look look;
    REQUIRE(eventually([&] {
      const auto* state = states_.latest();
      const auto* truth = truth_.latest();
      if (state == nullptr || truth == nullptr || state->value.valid_at <= event) {
        return false;
      }
      const double age_s = to_seconds(state->value.valid_at - truth->stamp);
      if (std::abs(age_s) > 0.1) {
        return false;
      }
      const double s = std::sin(truth->value.heading_rad);
      const double c = std::cos(truth->value.heading_rad);
      const Eigen::Vector2d over_ground_m_s{truth->value.surge_m_s * s + truth->value.sway_m_s * c,
                                            truth->value.surge_m_s * c - truth->value.sway_m_s * s};
      look = {state->value.valid_at,
              Eigen::Vector2d{state->value.odometry_x_m, state->value.odometry_y_m} -
                  Eigen::Vector2d{truth->value.x_m, truth->value.y_m} - age_s * over_ground_m_s,
              state->value};
      return true;
    }));
    return look;
  }

 private:
  Reader<WorldTruth> truth_;
  Reader<VehicleState> states_;
};

}  // namespace

TEST_CASE("warm restart: a mission that says resume is sailed on by the next high level",
          "[system]") {
  BoatUnderWay sea{"resume"};
  const MissionStatus before = sea.status();
  for (int round = 0; round < 2; ++round) {
    const Time event = SteadyClock{}.now();
    sea.kill_high();
    sea.boat.start_high();
    CHECK(sea.drives_since(event));
    const MissionStatus after = sea.status();
    CHECK(after.state == MissionState::kUnderWay);
    CHECK(after.cause == MissionCause::kRestart);
    CHECK(after.started == before.started);
    CHECK(after.goal_y_m == Approx(60.0));
  }
}

TEST_CASE("warm restart: a mission that says hold is held until it is told to go on", "[system]") {
  BoatUnderWay sea{"hold", "hold"};
  const MissionStatus before = sea.status();
  sea.kill_high();
  sea.boat.start_high();  // told to start by itself, and does not
  REQUIRE(eventually([&] { return sea.status().state == MissionState::kHolding; }));
  const MissionStatus held = sea.status();
  CHECK(held.cause == MissionCause::kRestart);
  CHECK(held.started == before.started);
  CHECK(held.goal_y_m < 50.0);
  const Time told = SteadyClock{}.now();
  CHECK(sea.tell({"resume"}) == 0);
  CHECK(sea.drives_since(told));
  CHECK(sea.status().goal_y_m == Approx(60.0));
}

TEST_CASE("warm restart: an emergency stop stands over the death of both processes", "[system]") {
  BoatUnderWay sea{"stopped"};
  REQUIRE(sea.tell({"estop"}) == 0);
  sea.kill_high();
  sea.kill_low();
  Reader<ThrustStatus> arming{sea.board->thrust_status};
  const std::uint64_t seen = arming.newest_sequence();
  const std::uint64_t said = sea.mission.newest_sequence();
  while (sea.thrust.next() != nullptr) {
  }
  sea.boat.start_low();
  sea.boat.start_high();
  REQUIRE(eventually([&] {
    return arming.newest_sequence() > seen + 20 && sea.mission.newest_sequence() > said + 20;
  }));
  CHECK(await_first(arming).value.state == ThrustState::kStopped);
  CHECK(await_first(arming).value.cause == ThrustCause::kRemembered);
  CHECK(sea.status().state == MissionState::kAborted);
  while (const auto* applied = sea.thrust.next()) {
    CHECK(int{applied->value.left} == 128);
    CHECK(int{applied->value.right} == 128);
  }
}

TEST_CASE("warm restart: what was disarmed stays so, and its mission is over", "[system]") {
  BoatUnderWay sea{"disarmed"};
  REQUIRE(sea.tell({"disarm"}) == 0);
  const std::uint64_t said = sea.mission.newest_sequence();
  sea.kill_high();
  sea.boat.start_high();
  REQUIRE(eventually([&] { return sea.mission.newest_sequence() > said + 20; }));
  CHECK(sea.status().state == MissionState::kAborted);
  Reader<ThrustStatus> arming{sea.board->thrust_status};
  CHECK(await_first(arming).value.state == ThrustState::kDisarmed);
}

TEST_CASE("warm restart: the estimate goes on without a jump when the high level was dead",
          "[system]") {
  BoatUnderWay sea{"jump"};
  OdometryAgainstTruth odometry{sea.board};
  const auto first = odometry.after(SteadyClock{}.now() + seconds{4});
  sea.kill_high();
  const Time died = SteadyClock{}.now();
  std::this_thread::sleep_for(milliseconds{400});
  sea.boat.start_high();
  const auto next = odometry.after(died);
  CHECK(next.at > died);
  CHECK((next.off_m - first.off_m).norm() < 0.25);
  // Its doubt is that of an estimate that has sailed, not that of one that begins with a fix.
  CHECK(next.state.fix_measured != Time{});
  CHECK(next.state.position_xx_m2 < 0.6);
}

TEST_CASE("warm restart: without a service manager lodesman run keeps both and ends with them",
          "[system]") {
  const Scratch scratch{"run"};
  const std::string segment = "lodesman-test-run-" + std::to_string(getpid());
  CommonOptions options;
  options.sets = {"command_socket.port = 0", "boat.segment=" + toml_string(segment),
                  "simulation.scenario=" +
                      toml_string(scratch.file("sea.toml", scenario_text(60.0, 200.0)).string())};
  const auto config = scratch.file("boat.toml", load_configuration("default", options).to_text());
  Program run{program("lodesman"), {"run", "--config", config.string(), "--quiet"}};
  const auto board = SharedBlackboard::observe(segment, kPatience);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  const auto child = [&](const char* name) {
    pid_t found = 0;
    REQUIRE(eventually([&] { return (found = child_of(run.pid(), name)) != 0; }));
    return found;
  };
  std::uint16_t port = 0;
  REQUIRE(eventually([&] {
    port = static_cast<std::uint16_t>(listening_port(child("lodesman-high")));
    return port != 0 && find_token_file(port).has_value();
  }));
  REQUIRE(eventually([&] {
    return Program{program("lodesman"), {"start", "--port", std::to_string(port), "--quiet"}}
               .status() == 0;
  }));
  for (const char* name : {"lodesman-high", "lodesman-low", "lodesman-high"}) {
    REQUIRE(eventually([&] { return drives(thrust.latest()); }));
    const pid_t before = child(name);
    const Time event = SteadyClock{}.now();
    REQUIRE(kill(before, SIGKILL) == 0);
    CHECK(eventually([&] {
      const auto* newest = thrust.latest();
      return drives(newest) && newest->stamp > event && child(name) != before;
    }));
  }
  REQUIRE(kill(run.pid(), SIGTERM) == 0);
  CHECK(run.status() == 0);
  const auto last = await_first(thrust);
  CHECK(int{last.value.left} == 128);
  CHECK(int{last.value.right} == 128);
  CHECK_FALSE(fs::exists("/dev/shm/" + segment));
}

TEST_CASE("warm restart: lodesman run ends where a program refuses to run", "[system]") {
  const Scratch scratch{"run-refused"};
  const auto config = scratch.file("boat.toml", "[pilot]\nsight = 3\n");
  CHECK(Program{program("lodesman"), {"run", "--config", config.string()}}.status() == 2);
  CHECK(Program{program("lodesman"), {"run", "--config", "/nowhere/boat.toml"}}.status() == 2);
}
