// SPDX-License-Identifier: Apache-2.0
// Two real processes over shared memory, and what happens when one of them is killed. Judged on
// publication stamps, never on how long this test takes.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "deploy/cli/run/child_process.h"
#include "deploy/cli/run/settings.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"
#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::cli;
using std::chrono::milliseconds;
using std::chrono::seconds;
namespace fs = std::filesystem;

namespace {

// A directory of its own for each test, gone with it.
class Scratch {
 public:
  explicit Scratch(const std::string& name)
      : directory_{fs::temp_directory_path() /
                   ("lodesman-test-" + name + "-" + std::to_string(getpid()))} {
    fs::create_directories(directory_);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { fs::remove_all(directory_); }
  [[nodiscard]] fs::path file(const std::string& name, const std::string& text = "") const {
    if (!text.empty()) {
      std::ofstream{directory_ / name} << text;
    }
    return directory_ / name;
  }

 private:
  fs::path directory_;
};

// A goal that is far enough to be under way while things die.
std::string scenario_text(double goal_y_m) {
  return "name = \"short\"\nseed = 1\ntime_limit_s = 120.0\n[mission]\nstart_m = [0.0, 0.0]\n"
         "start_heading_deg = 0.0\ngoal_m = [0.0, " +
         std::to_string(goal_y_m) +
         "]\ngoal_radius_m = 0.5\n[vehicle]\nspeed_m_s = 0.74\nradius_m = 0.5\n";
}

template <class Condition>
bool eventually(Condition condition, Duration patience = seconds{20}) {
  const SteadyClock clock;
  const Time deadline = clock.now() + patience;
  while (!condition()) {
    if (clock.now() >= deadline) {
      return false;
    }
    std::this_thread::sleep_for(milliseconds{2});
  }
  return true;
}

// A child of a process by its program's name; 0 when there is none.
pid_t child_of(pid_t parent, const std::string& program) {
  const std::string id = std::to_string(parent);
  std::ifstream children{"/proc/" + id + "/task/" + id + "/children"};
  for (pid_t child = 0; children >> child;) {
    std::string name;
    std::ifstream{"/proc/" + std::to_string(child) + "/comm"} >> name;
    if (name == program) {
      return child;
    }
  }
  return 0;
}

bool any_segment_of(pid_t launcher) {
  return fs::exists("/dev/shm/lodesman-sim-" + std::to_string(launcher));
}

// Both programs on a segment of this test's own.
struct Boat {
  explicit Boat(const Scratch& scratch)
      : segment{"lodesman-test-boat-" + std::to_string(getpid())} {
    CommonOptions options;
    options.sets = {"command_socket.port = 0"};
    const auto config = scratch.file("config.toml", load_configuration("paper", options).to_text());
    const auto scenario = scratch.file("scenario.toml", scenario_text(25.0));
    arguments = {"--segment",     segment,      "--config",
                 config.string(), "--scenario", scenario.string()};
    start_low();
    start_high();
  }
  ~Boat() {
    high.reset();
    low.reset();
    remove_dead_segment(segment);
  }
  void start_low() { low = std::make_unique<ChildProcess>("lodesman-low", arguments); }
  void start_high() {
    auto with_start = arguments;
    with_start.push_back("--start");
    high = std::make_unique<ChildProcess>("lodesman-high", with_start);
  }

  std::string segment;
  std::vector<std::string> arguments;
  std::unique_ptr<ChildProcess> low;
  std::unique_ptr<ChildProcess> high;
};

bool drives(const Stamped<ThrustApplied>* thrust) {
  return thrust != nullptr && thrust->value.reason == ThrustReason::kCommanded &&
         thrust->value.left > 128;
}

// Kills the high level after a random while under way. Gives how long after its last command the
// thrusters were neutral, by the stamps of what was published.
double neutral_after_kill_s(Boat& boat, std::mt19937& random) {
  const auto board = SharedBlackboard::observe(boat.segment, seconds{20});
  Reader<ThrustApplied> thrust{board->thrust_applied};
  Reader<HelmCommand> helm{board->helm_command};
  REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  std::this_thread::sleep_for(milliseconds{random() % 300});
  REQUIRE(kill(boat.high->pid(), SIGKILL) == 0);
  REQUIRE(eventually([&] { return boat.high->ended().has_value(); }));
  const Time last_command = helm.latest()->stamp;
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
    "[system]") {
  const Scratch scratch{"kill-high"};
  Boat boat{scratch};
  std::mt19937 random{5};
  for (int i = 0; i < 3; ++i) {
    CHECK(neutral_after_kill_s(boat, random) <= 0.5);
    boat.start_high();  // finds the segment; drives again at the next turn of the loop
  }
  const auto board = SharedBlackboard::observe(boat.segment, seconds{20});
  Reader<ThrustApplied> thrust{board->thrust_applied};
  CHECK(eventually([&] { return drives(thrust.latest()); }));
}

TEST_CASE(
    "processes: without its low level the high level publishes no more commands and ends "
    "with a fault",
    "[system]") {
  const Scratch scratch{"kill-low"};
  Boat boat{scratch};
  const auto board = SharedBlackboard::observe(boat.segment, seconds{20});
  Reader<ThrustApplied> thrust{board->thrust_applied};
  Reader<HelmCommand> helm{board->helm_command};
  REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  REQUIRE(kill(boat.low->pid(), SIGKILL) == 0);
  REQUIRE(eventually([&] { return boat.high->ended().has_value(); }));
  CHECK(*boat.high->ended() == "exit status 4");
  // Its last word is a neutral one.
  CHECK(helm.latest()->value.surge_ref == 0);
  CHECK(helm.latest()->value.head_ref == 0);
}

TEST_CASE("processes: the launcher sails a scenario to its goal and leaves nothing behind",
          "[system]") {
  const Scratch scratch{"sim"};
  const auto scenario = scratch.file("short.toml", scenario_text(4.0));
  const auto out = scratch.file("run");
  ChildProcess launcher{"lodesman",
                        {"sim", scenario.string(), "--profile", "paper", "--out", out.string(),
                         "--quiet", "--no-images", "--set", "command_socket.port=0"}};
  REQUIRE(eventually([&] { return launcher.ended().has_value(); }, seconds{60}));
  CHECK(*launcher.ended() == "exit status 0");
  CHECK_FALSE(any_segment_of(launcher.pid()));
  const auto result = nlohmann::json::parse(std::ifstream{out / "result.json"});
  CHECK(result["outcome"] == "goal");
  CHECK(result["mode"] == "realtime");
  CHECK(result["stale_events"] == 0);
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
        SharedBlackboard::observe("lodesman-sim-" + std::to_string(launcher.pid()), seconds{20});
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
      SharedBlackboard::observe("lodesman-sim-" + std::to_string(launcher.pid()), seconds{20});
  Reader<ThrustApplied> thrust{board->thrust_applied};
  REQUIRE(eventually([&] { return thrust.latest() != nullptr; }));
  REQUIRE(kill(launcher.pid(), SIGKILL) == 0);
  CHECK(eventually([&] { return !board.alive(Role::kLow) && !board.alive(Role::kHigh); }));
  CHECK(eventually([&] { return !any_segment_of(launcher.pid()); }));
}

TEST_CASE("processes: an interrupt ends a run cleanly, with a result", "[system]") {
  const Scratch scratch{"interrupt"};
  const auto scenario = scratch.file("far.toml", scenario_text(25.0));
  const auto out = scratch.file("run");
  ChildProcess launcher{"lodesman",
                        {"sim", scenario.string(), "--out", out.string(), "--quiet", "--no-images",
                         "--set", "command_socket.port=0"}};
  const auto board =
      SharedBlackboard::observe("lodesman-sim-" + std::to_string(launcher.pid()), seconds{20});
  Reader<ThrustApplied> thrust{board->thrust_applied};
  REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  REQUIRE(kill(launcher.pid(), SIGINT) == 0);
  REQUIRE(eventually([&] { return launcher.ended().has_value(); }));
  CHECK(*launcher.ended() == "exit status 1");
  const auto result = nlohmann::json::parse(std::ifstream{out / "result.json"});
  CHECK(result["outcome"] == "aborted");
  CHECK_FALSE(any_segment_of(launcher.pid()));
}

// Not part of a usual run: fifty kills of the high level, as a table.
TEST_CASE("processes: fifty random kills of the high level", "[.campaign]") {
  const Scratch scratch{"campaign"};
  Boat boat{scratch};
  std::mt19937 random{static_cast<unsigned>(SteadyClock{}.now().time_since_epoch().count())};
  std::vector<double> neutral_s;
  for (int i = 0; i < 50; ++i) {
    neutral_s.push_back(neutral_after_kill_s(boat, random));
    boat.start_high();
  }
  std::sort(neutral_s.begin(), neutral_s.end());
  std::cout << "neutral after a killed lodesman-high, of 50: median " << neutral_s[25]
            << " s, worst " << neutral_s.back() << " s\n";
  CHECK(neutral_s.back() <= 0.5);
}
