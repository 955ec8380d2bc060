// SPDX-License-Identifier: Apache-2.0
// Two real processes over shared memory, and what happens when one of them is killed. Judged on
// publication stamps, never on how long this test takes.
#include <sys/wait.h>

#include <nlohmann/json.hpp>
#include <random>

#include "tests/support/catch.h"
#include "tests/system/boat.h"
#include "tests/system/listening_port.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// Kills the high level after a random while under way. Gives how long after its last command the
// thrusters were neutral, by the stamps of what was published.
double neutral_after_kill_s(Boat& boat, std::mt19937& random) {
  const auto board = SharedBlackboard::observe(boat.segment, kPatience);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  Reader<HelmCommand> helm{board->helm_command};
  REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  std::this_thread::sleep_for(milliseconds{random() % 300});
  REQUIRE(kill(boat.high->pid(), SIGKILL) == 0);
  REQUIRE(eventually([&] { return boat.high->ended().has_value(); }));
  const Time last_command = await_first(helm).stamp;
  const Stamped<ThrustApplied>* neutral = nullptr;
  REQUIRE(eventually([&] {
    const auto* newest = thrust.next();
    const bool found = newest != nullptr && newest->stamp > last_command &&
                       newest->value.reason == ThrustReason::kStaleCommand;
    neutral = found ? newest : nullptr;
    return found;
  }));
  CHECK(int{neutral->value.left} == 128);
  CHECK(int{neutral->value.right} == 128);
  CHECK_FALSE(boat.low->ended().has_value());
  return to_seconds(neutral->stamp - last_command);
}

}  // namespace

TEST_CASE(
    "processes: a killed high level leaves the thrusters neutral within 0.5 s, and its "
    "successor sails on",
    "[system][plain]") {
  const Scratch scratch{"kill-high"};
  Boat boat{scratch};
  std::mt19937 random{5};
  for (int i = 0; i < 3; ++i) {
    CHECK(neutral_after_kill_s(boat, random) <= 0.5);
    boat.start_high();  // finds the segment; drives again at the next turn of the loop
  }
  const auto board = SharedBlackboard::observe(boat.segment, kPatience);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  CHECK(eventually([&] { return drives(thrust.latest()); }));
}

TEST_CASE("processes: the launcher sails a scenario to its goal and leaves nothing behind",
          "[system]") {
  const Scratch scratch{"sim"};
  const auto scenario = scratch.file("short.toml", scenario_text(4.0));
  const auto out = scratch.file("run");
  ChildProcess launcher{"lodesman",
                        {"sim", scenario.string(), "--profile", "paper", "--out", out.string(),
                         "--quiet", "--no-images", "--set", "command_socket.port=0"}};
  REQUIRE(eventually([&] { return launcher.ended().has_value(); }, 2 * kPatience));
  CHECK(*launcher.ended() == "exit status 0");
  CHECK_FALSE(any_segment_of(launcher.pid()));
  const auto result = nlohmann::json::parse(std::ifstream{out / "result.json"});
  CHECK(result["outcome"] == "goal");
  CHECK(result["mode"] == "realtime");
}

TEST_CASE("processes: when either one dies the launcher says which, stops the other and exits 4",
          "[system]") {
  for (const bool kill_low : {true, false}) {
    const Scratch scratch{"fault"};
    const auto scenario = scratch.file("far.toml", scenario_text(25.0));
    const auto out = scratch.file("run");
    ChildProcess launcher{"lodesman",
                          {"sim", scenario.string(), "--profile", "paper", "--out", out.string(),
                           "--quiet", "--no-images", "--set", "command_socket.port=0"}};
    const auto board =
        SharedBlackboard::observe("lodesman-sim-" + std::to_string(launcher.pid()), kPatience);
    Reader<ThrustApplied> thrust{board->thrust_applied};
    REQUIRE(eventually([&] { return drives(thrust.latest()); }));
    const std::string victim = kill_low ? "lodesman-low" : "lodesman-high";
    const pid_t child = child_of(launcher.pid(), victim);
    REQUIRE(child > 0);
    REQUIRE(kill(child, SIGKILL) == 0);
    REQUIRE(eventually([&] { return launcher.ended().has_value(); }));
    CHECK(*launcher.ended() == "exit status 4");
    const auto result = nlohmann::json::parse(std::ifstream{out / "result.json"});
    CHECK(result["outcome"] == "fault");
    CHECK(result["fault"].get<std::string>().find(victim + " died: signal 9") == 0);
    CHECK_FALSE(any_segment_of(launcher.pid()));
    CHECK_FALSE(board.alive(Role::kLow));
    CHECK_FALSE(board.alive(Role::kHigh));
  }
}

TEST_CASE("processes: a killed launcher takes both processes with it", "[system]") {
  const Scratch scratch{"kill-launcher"};
  const auto scenario = scratch.file("far.toml", scenario_text(25.0));
  ChildProcess launcher{"lodesman",
                        {"sim", scenario.string(), "--out", scratch.file("run").string(), "--quiet",
                         "--no-images", "--set", "command_socket.port=0"}};
  const auto board =
      SharedBlackboard::observe("lodesman-sim-" + std::to_string(launcher.pid()), kPatience);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  REQUIRE(eventually([&] { return thrust.latest() != nullptr; }));
  REQUIRE(kill(launcher.pid(), SIGKILL) == 0);
  CHECK(eventually([&] { return !board.alive(Role::kLow) && !board.alive(Role::kHigh); }));
  CHECK(eventually([&] { return !any_segment_of(launcher.pid()); }));
}

TEST_CASE("processes: a hold keeps the boat where it is until it is told to go on", "[system]") {
  const Scratch scratch{"hold"};
  const auto scenario = scratch.file("far.toml", scenario_text(25.0));
  const auto out = scratch.file("run");
  ChildProcess launcher{"lodesman",
                        {"sim", scenario.string(), "--out", out.string(), "--quiet", "--no-images",
                         "--set", "command_socket.port=0"}};
  const auto board =
      SharedBlackboard::observe("lodesman-sim-" + std::to_string(launcher.pid()), kPatience);
  Reader<MissionStatus> mission{board->mission_status};
  Reader<Plan> plan{board->plan};
  const auto state_is = [&](MissionState state) {
    return eventually([&] {
      const auto* status = mission.latest();
      return status != nullptr && status->value.state == state;
    });
  };
  REQUIRE(state_is(MissionState::kUnderWay));
  const pid_t high = child_of(launcher.pid(), "lodesman-high");
  int port = 0;
  REQUIRE(eventually([&] { return (port = listening_port(high)) != 0; }));
  const auto order = [&](const char* command) {
    ChildProcess teller{"lodesman", {command, "--port", std::to_string(port), "--quiet"}};
    return eventually([&] { return teller.ended().has_value(); }) &&
           *teller.ended() == "exit status 0";
  };
  REQUIRE(order("hold"));
  REQUIRE(state_is(MissionState::kHolding));
  CHECK(eventually([&] { return await_first(plan).value.rung == PlanRung::kHold; }));
  REQUIRE(order("resume"));
  REQUIRE(state_is(MissionState::kUnderWay));
  REQUIRE(order("hold"));
  REQUIRE(state_is(MissionState::kHolding));
  REQUIRE(order("abort"));
  REQUIRE(eventually([&] { return launcher.ended().has_value(); }));
  CHECK(*launcher.ended() == "exit status 1");
}

TEST_CASE("processes: an interrupt ends a run cleanly, with a result", "[system]") {
  const Scratch scratch{"interrupt"};
  const auto scenario = scratch.file("far.toml", scenario_text(25.0));
  const auto out = scratch.file("run");
  ChildProcess launcher{"lodesman",
                        {"sim", scenario.string(), "--out", out.string(), "--quiet", "--no-images",
                         "--set", "command_socket.port=0"}};
  const auto board =
      SharedBlackboard::observe("lodesman-sim-" + std::to_string(launcher.pid()), kPatience);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  REQUIRE(kill(launcher.pid(), SIGINT) == 0);
  REQUIRE(eventually([&] { return launcher.ended().has_value(); }));
  CHECK(*launcher.ended() == "exit status 1");
  const auto result = nlohmann::json::parse(std::ifstream{out / "result.json"});
  CHECK(result["outcome"] == "aborted");
  CHECK_FALSE(any_segment_of(launcher.pid()));
}

TEST_CASE("processes: a segment of another build is refused by everyone who opens it", "[system]") {
  const std::string segment = "lodesman-test-other-" + std::to_string(getpid());
  const auto low = SharedBlackboard::create(segment);
  {
    // The layout's number is the second word of the header.
    std::fstream bytes{"/dev/shm/" + segment, std::ios::in | std::ios::out | std::ios::binary};
    bytes.seekp(offsetof(SegmentHeader, layout_hash));
    const std::uint64_t other = layout_hash() + 1;
    bytes.write(reinterpret_cast<const char*>(&other), sizeof other);
  }
  const std::string refusal =
      "segment " + segment + " was made by a build with another layout; use programs of one build";
  CHECK_THROWS_WITH(SharedBlackboard::open(segment, Role::kHigh, Duration::zero()), refusal);
  CHECK_THROWS_WITH(SharedBlackboard::observe(segment, Duration::zero()), refusal);
  ChildProcess watch{"lodesman", {"watch", "--segment", segment, "--once"}};
  REQUIRE(eventually([&] { return watch.ended().has_value(); }));
  CHECK(*watch.ended() == "exit status 2");
}
