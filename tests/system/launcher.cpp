// SPDX-License-Identifier: Apache-2.0
// The launcher and its children in surroundings that are against them: signals ignored or blocked,
// no death signal, children that die before anything has begun.
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "tests/system/program.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

nlohmann::json result_of(const fs::path& run) {
  return nlohmann::json::parse(std::ifstream{run / "result.json"}, nullptr, false);
}

// The launcher beside children of the test's own making, shell scripts: where its real children
// stand, and where the shipped files lie, it finds as ever.
class Ship {
 public:
  explicit Ship(const Scratch& scratch) : place_{scratch.file("ship")} {
    fs::create_directories(place_);
    for (const char* name : {"lodesman", "lodesman-bench"}) {
      fs::copy_file(program(name), place_ / name);
    }
    setenv("LODESMAN_SHARE", share_directory().c_str(), 1);
  }
  Ship(const Ship&) = delete;
  Ship& operator=(const Ship&) = delete;
  ~Ship() { unsetenv("LODESMAN_SHARE"); }

  void child(const std::string& name, const std::string& script) const {
    std::ofstream{place_ / name} << "#!/bin/sh\n" << script << "\n";
    fs::permissions(place_ / name, fs::perms::owner_all);
  }
  [[nodiscard]] fs::path launcher() const { return place_ / "lodesman"; }

 private:
  fs::path place_;
};

}  // namespace

TEST_CASE("launcher: each process ends with its standard input, without any signal", "[system]") {
  const Scratch scratch{"life-line"};
  CommonOptions options;
  options.sets = {"command_socket.port = 0"};
  const auto config = scratch.file("config.toml", load_configuration("paper", options).to_text());
  const auto scenario = scratch.file("scenario.toml", scenario_text(25.0));
  const std::string segment = "lodesman-test-life-line-" + std::to_string(getpid());
  const auto start = [&](const char* name, std::array<int, 2>& life_line) {
    REQUIRE(pipe2(life_line.data(), O_CLOEXEC) == 0);
    return std::make_unique<Program>(
        program(name),
        std::vector<std::string>{"--segment", segment, "--config", config.string(), "--scenario",
                                 scenario.string(), "--stop-with-input"},
        [&] { dup2(life_line[0], STDIN_FILENO); });
  };
  std::array<int, 2> of_low{};
  std::array<int, 2> of_high{};
  const auto low = start("lodesman-low", of_low);
  const auto high = start("lodesman-high", of_high);
  const auto board = SharedBlackboard::observe(segment, seconds{20});
  Reader<MissionStatus> mission{board->mission_status};
  REQUIRE(eventually([&] { return mission.latest() != nullptr; }));
  close(of_high[1]);
  CHECK(high->status() == 0);
  CHECK_FALSE(low->ended().has_value());
  close(of_low[1]);
  CHECK(low->status() == 0);
  close(of_high[0]);
  close(of_low[0]);
}

TEST_CASE("launcher: killed, it takes its children with it where no death signal reaches them",
          "[system]") {
  const Scratch scratch{"no-death-signal"};
  const Ship ship{scratch};
  for (const char* name : {"lodesman-low", "lodesman-high"}) {
    ship.child(name, "exec setpriv --pdeathsig clear '" + program(name).string() + "' \"$@\"");
  }
  Program launcher{ship.launcher(), sim(scratch.file("far.toml", scenario_text(25.0)),
                                        scratch.file("run"), {"--quiet"})};
  const auto board = under_way(launcher);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  const Time killed = SteadyClock{}.now();
  REQUIRE(kill(launcher.pid(), SIGKILL) == 0);
  CHECK(eventually([&] { return !board.alive(Role::kLow) && !board.alive(Role::kHigh); }));
  CHECK(eventually([&] { return !any_segment_of(launcher.pid()); }));
  const auto* last = thrust.latest();
  CHECK_FALSE(drives(last));
  CHECK(to_seconds(last->stamp - killed) <= 0.5);
}

TEST_CASE("launcher: a death is noticed where the parent ignores the death of children",
          "[system]") {
  const Scratch scratch{"ignored-deaths"};
  const auto out = scratch.file("run");
  Program launcher{program("lodesman"),
                   sim(scratch.file("far.toml", scenario_text(25.0)), out, {"--quiet"}),
                   [] { std::signal(SIGCHLD, SIG_IGN); }};
  const auto board = under_way(launcher);
  const pid_t low = child_of(launcher.pid(), "lodesman-low");
  REQUIRE(low > 0);
  REQUIRE(kill(low, SIGKILL) == 0);
  CHECK(launcher.status() == 4);
  CHECK(result_of(out)["fault"] == "lodesman-low died: signal 9");
}

TEST_CASE("launcher: a stop ends a run with its results, whatever the parent did to the signal",
          "[system]") {
  struct Row {
    const char* what;
    int signal;
    std::function<void()> surroundings;
  };
  const auto block = [](int signal) {
    return [signal] {
      sigset_t set;
      sigemptyset(&set);
      sigaddset(&set, signal);
      sigprocmask(SIG_BLOCK, &set, nullptr);
    };
  };
  const std::vector<Row> rows{{"a hang-up", SIGHUP, [] { std::signal(SIGHUP, SIG_DFL); }},
                              {"SIGTERM blocked", SIGTERM, block(SIGTERM)},
                              {"SIGTERM ignored", SIGTERM, [] { std::signal(SIGTERM, SIG_IGN); }},
                              {"SIGINT blocked", SIGINT, block(SIGINT)}};
  for (const Row& row : rows) {
    INFO(row.what);
    const Scratch scratch{"stopped"};
    const auto out = scratch.file("run");
    Program launcher{program("lodesman"),
                     sim(scratch.file("far.toml", scenario_text(25.0)), out, {"--quiet"}),
                     row.surroundings};
    const auto board = under_way(launcher);
    REQUIRE(kill(launcher.pid(), row.signal) == 0);
    CHECK(launcher.status() == 1);
    CHECK(result_of(out)["outcome"] == "aborted");
    CHECK_FALSE(board.alive(Role::kLow));
    CHECK_FALSE(any_segment_of(launcher.pid()));
  }
}

TEST_CASE("launcher: each process ends cleanly on a hang-up and on a blocked stop", "[system]") {
  const Scratch scratch{"hang-up"};
  for (const int signal : {SIGHUP, SIGTERM}) {
    Boat boat{scratch};
    {
      const auto board = SharedBlackboard::observe(boat.segment, seconds{20});
      Reader<ThrustApplied> thrust{board->thrust_applied};
      REQUIRE(eventually([&] { return drives(thrust.latest()); }));
    }
    REQUIRE(kill(boat.high->pid(), signal) == 0);
    REQUIRE(eventually([&] { return boat.high->ended().has_value(); }));
    CHECK(*boat.high->ended() == "exit status 0");
    REQUIRE(kill(boat.low->pid(), signal) == 0);
    REQUIRE(eventually([&] { return boat.low->ended().has_value(); }));
    CHECK(*boat.low->ended() == "exit status 0");
  }
}

TEST_CASE("launcher: a child that dies in start-up is a fault, one that refuses is a refusal",
          "[system]") {
  struct Row {
    const char* script;
    int status;
  };
  for (const auto& [script, status] :
       {Row{"kill -9 $$", 4}, Row{"exit 139", 4}, Row{"exit 75", 4}, Row{"exit 2", 2}}) {
    for (const bool low : {true, false}) {
      INFO((low ? "low: " : "high: ") << script);
      const Scratch scratch{"start-up"};
      const Ship ship{scratch};
      const std::string real = low ? "lodesman-high" : "lodesman-low";
      ship.child(low ? "lodesman-low" : "lodesman-high", script);
      ship.child(real, "exec '" + program(real).string() + "' \"$@\"");
      const auto out = scratch.file("run");
      Program launcher{ship.launcher(),
                       sim(scratch.file("far.toml", scenario_text(25.0)), out, {"--quiet"})};
      CHECK(launcher.status() == status);
      CHECK_FALSE(any_segment_of(launcher.pid()));
      if (status == 4) {
        CHECK(result_of(out)["outcome"] == "fault");
      }
    }
  }
}

TEST_CASE("launcher: a low level that has fallen silent ends the run at its time limit",
          "[system]") {
  const Scratch scratch{"frozen"};
  const auto out = scratch.file("run");
  Program launcher{program("lodesman"), sim(scratch.file("far.toml", scenario_text(25.0)), out,
                                            {"--quiet", "--time-limit", "3"})};
  {
    const auto board = under_way(launcher);
    const pid_t low = child_of(launcher.pid(), "lodesman-low");
    REQUIRE(low > 0);
    REQUIRE(kill(low, SIGSTOP) == 0);
  }
  CHECK(launcher.status() == 4);
  CHECK(result_of(out)["fault"] == "lodesman-low has fallen silent");
  CHECK_FALSE(any_segment_of(launcher.pid()));
}

TEST_CASE("launcher: a mission that never begins ends the run at its time limit too", "[system]") {
  const Scratch scratch{"not-begun"};
  const auto out = scratch.file("run");
  Program launcher{program("lodesman"), sim(scratch.file("far.toml", scenario_text(25.0)), out,
                                            {"--quiet", "--time-limit", "2"})};
  pid_t high = 0;
  REQUIRE(eventually([&] { return (high = child_of(launcher.pid(), "lodesman-high")) > 0; }));
  REQUIRE(kill(high, SIGSTOP) == 0);
  CHECK(launcher.status() == 4);
  CHECK(result_of(out)["fault"] == "the mission has not begun");
  CHECK_FALSE(any_segment_of(launcher.pid()));
}

TEST_CASE("launcher: while it is frozen the boat is neutral, and sails on once it thaws",
          "[system]") {
  const Scratch scratch{"frozen"};
  const auto scenario = scratch.file("far.toml", scenario_text(25.0));
  Program launcher{program("lodesman"), sim(scenario, scratch.file("run"), {"--quiet"})};
  const auto board = under_way(launcher);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  for (int round = 0; round < 2; ++round) {
    REQUIRE(eventually([&] { return drives(thrust.latest()); }));
    REQUIRE(kill(launcher.pid(), SIGSTOP) == 0);
    // How soon is measured by measure_restarts.
    CHECK(eventually([&] {
      const auto* applied = thrust.latest();
      return applied->value.left == 128 && applied->value.right == 128;
    }));
    CHECK(board.alive(Role::kLow));
    CHECK(board.alive(Role::kHigh));
    REQUIRE(kill(launcher.pid(), SIGCONT) == 0);
  }
  CHECK(eventually([&] { return drives(thrust.latest()); }));
}
