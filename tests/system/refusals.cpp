// SPDX-License-Identifier: Apache-2.0
// What the programs must refuse, end to end: exit status 2, one line on standard error, nothing on
// standard output and nothing written.
#include <unistd.h>

#include <array>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/good_scenario.h"
#include "tests/system/program_bench.h"

namespace lodesman {
namespace {

namespace fs = std::filesystem;

using testing::Bench;
using testing::kGoodScenario;
using testing::Outcome;
using testing::text_of;

[[nodiscard]] std::string replaced(const std::string& old, const std::string& by) {
  std::string text = testing::replaced(kGoodScenario, old, by);
  REQUIRE_FALSE(text.empty());
  return text;
}

[[nodiscard]] std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) {
    text += part;
  }
  return text;
}

void check_refused(const Bench& bench, const Outcome& outcome, const std::string& line) {
  CHECK(outcome.status == 2);
  CHECK(outcome.out.empty());
  CHECK(std::count(outcome.error.begin(), outcome.error.end(), '\n') == 1);
  CHECK(outcome.error.ends_with('\n'));
  CHECK(std::regex_search(outcome.error, std::regex{line}));
  CHECK(bench.untouched());
}

[[nodiscard]] std::vector<std::string> simulation_of(const std::string& scenario,
                                                     const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"sim", scenario, "--lockstep", "--no-images", "--out", "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// A scenario's text and how its refusal begins.
struct ScenarioRow {
  std::string text;
  std::string line;
};

void check_scenarios(const std::vector<ScenarioRow>& rows) {
  for (const ScenarioRow& row : rows) {
    INFO(row.line << "\n" << row.text.substr(0, 300));
    Bench bench;
    bench.write("s.toml", row.text);
    check_refused(bench, bench.run(LODESMAN_PROGRAM, simulation_of("s.toml")),
                  "^s\\.toml:" + row.line);
  }
}

TEST_CASE("refusals: sim refuses a bad scenario with one line and writes nothing",
          "[system][refusals]") {
  check_scenarios({
      {replaced("name = \"a-good.one\"\n", ""), "1: name: missing"},
      {replaced("\"a-good.one\"", "\"../good\""), "1: name: "},
      {replaced("\"a-good.one\"", "3"), "1: name: must be a text"},
      {replaced("seed = 1", "seed = -1"), "2: seed: "},
      {replaced("seed = 1", "seed = 1.5"), "2: seed: "},
      {replaced("seed = 1", "seed = 1\nseed = 2"), "3: toml: "},
      {replaced("seed = 1", "sed = 1"), "1: seed: missing"},
      {replaced("seed = 1", "seed = 1\nspeed = 1"), "3: speed: unknown key"},
      {replaced("= 200.0", "= 0.0"), "3: time_limit_s: "},
      {replaced("= 200.0", "= -1.0"), "3: time_limit_s: "},
      {replaced("= 200.0", "= inf"), "3: time_limit_s: must be finite"},
      {replaced("= 200.0", "= nan"), "3: time_limit_s: must be finite"},
      {replaced("= 200.0", "= 10.0"), "7: mission\\.goal_m: "},
      {replaced("= 200.0", "= 1979-05-27"), "3: time_limit_s: must be a number"},
      {replaced("[mission]", "[missoin]"), "1: mission: missing"},
      {replaced("start_m = [0.0, 0.0]", "start_m = [0.0]"), "5: mission\\.start_m: "},
      {replaced("start_m = [0.0, 0.0]", "start_m = [0.0, \"a\"]"), "5: mission\\.start_m: "},
      {replaced("start_m = [0.0, 0.0]", "start_m = {x = 0, y = 0}"), "5: mission\\.start_m: "},
      {replaced("goal_m = [0.0, 20.0]", "goal_m = [0.0, nan]"), "7: mission\\.goal_m: "},
      {replaced("goal_m = [0.0, 20.0]", "goal_m = [0.0, 1e9]"), "7: mission\\.goal_m: "},
      {replaced("goal_radius_m = 0.5", "goal_radius_m = 0.0"), "8: mission\\.goal_radius_m: "},
      {replaced("speed_m_s = 0.22", ""), "9: vehicle"},
      {replaced("speed_m_s = 0.22", "speed_m_s = 0.22\nsurge_ref = 16"), "1[01]: vehicle"},
      {replaced("speed_m_s = 0.22", "speed_m_s = 5.0"), "10: vehicle\\.speed_m_s: "},
      {replaced("speed_m_s = 0.22", "surge_ref = 0"), "10: vehicle\\.surge_ref: "},
      {replaced("speed_m_s = 0.22", "surge_ref = 101"), "10: vehicle\\.surge_ref: "},
      {replaced("\"circle\"", "\"square\""), "13: obstacle\\[0\\]\\.shape: "},
      {replaced("\"circle\"", "7"), "13: obstacle\\[0\\]\\.shape: "},
      {replaced("centre_m = [0.0, 10.0]\n", ""), "12: obstacle\\[0\\]\\.centre_m: missing"},
      {replaced("radius_m = 0.5\nprotection", "radius_m = -0.5\nprotection"), "15: obstacle"},
      {replaced("protection_m = 3.5", "protection_m = 0.1"), "16: obstacle\\[0\\]\\.protection_m"},
      {replaced("stop_at_m = [0.0, 0.0]", "stop_at_m = [3.0, 0.0]"), "18: obstacle"},
      {replaced("velocity_m_s = [0.0, -0.11]\n", ""), "17: obstacle\\[0\\]\\.stop_at_m: "},
      {replaced("[1.5, 0.4]", "[1.5, 0.0]"), "24: obstacle\\[1\\]\\.semi_axes_m: "},
      {replaced("[4.0, 2.0]", "[1.0, 2.0]"), "26: obstacle\\[1\\]\\.protection_semi_axes_m: "},
      {replaced("angle_deg = 30.0", "angle_rad = 0.5"), "[0-9]+: obstacle\\[1\\]\\.angle_"},
      {replaced("beams = 240", "beams = 100000"), "43: sonar\\.beams: "},
      {replaced("beams = 240", "beams = 12.5"), "43: sonar\\.beams: "},
      {replaced("ping_hz = 5.0", "ping_hz = 0.0"), "45: sonar\\.ping_hz: "},
      {replaced("\"none\"", "\"loud\""), "40: sonar\\.noise: "},
      {replaced("[sonar]", "[radar]"), "38: radar: unknown key"},
      {replaced("\"thruster\"", "\"rudder\""), "47: fault\\[0\\]\\.device: "},
      {replaced("\"disconnect\"", "\"explode\""), "48: fault\\[0\\]\\.kind: "},
      {replaced("duration_s = 5.0", "duration_s = -5.0"), "50: fault\\[0\\]\\.duration_s: "},
      {replaced("at_s = 20.0\n", ""), "46: fault\\[0\\]\\.at_s: missing"},
  });
}

TEST_CASE("refusals: sim refuses hostile files as it does bad ones", "[system][refusals]") {
  using namespace std::string_literals;
  const std::string obstacle =
      "[[obstacle]]\nshape = \"circle\"\ncentre_m = [9.0, 9.0]\n"
      "radius_m = 0.5\nprotection_m = 1.0\n";
  check_scenarios({
      {"", "1: name: missing"},
      {repeated("#", 2U << 20U), "1: file: is larger than 1 MiB"},
      {"\0"s + kGoodScenario, "1: toml: "},
      {kGoodScenario + "# \0\n"s, "51: toml: "},
      {"\xff\xfe" + kGoodScenario, "1: toml: "},
      {kGoodScenario + "# \xc3\x28\n", "51: toml: "},
      {"\x7f"
       "ELF\x02\x01\x01",
       "1: toml: "},
      {"a = " + repeated("[", 100'000), "1: toml: "},
      {"a = " + repeated("{b = ", 100'000), "1: toml: "},
      {"[" + repeated("a.", 100'000) + "a]", "1: toml: "},
      {repeated("a.", 100'000) + "a = 1", "1: toml: "},
      {repeated("\"\" . ", 100'000) + "a = 1", "1: toml: "},
      {repeated("\",\" . ", 150'000) + "a = 1", "1: toml: "},
      {"x = [" + repeated("1,", 400'000) + "]\n" + kGoodScenario, "1: x: unknown key"},
      {kGoodScenario + repeated(obstacle, 100), "[0-9]+: obstacle: must be at most 64"},
      {replaced("goal_m =", "waypoints_m = [" + repeated("[0.0, 1.0],", 50'000) + "]\ngoal_m ="),
       "7: mission\\.waypoints_m: "},
      {"\"a\\nb\" = 1\n" + kGoodScenario, "1: a\\?b: unknown key"},
      {"\"a\\u001b[2J\" = 1\n" + kGoodScenario, "1: a\\?"},
      {repeated("k", 500'000) + " = 1\n" + kGoodScenario, "1: kkk"},
      {replaced("\"a-good.one\"", "\"" + repeated("x", 500'000) + "\""), "1: name: "},
      {replaced("\"a-good.one\"", "\"go\nod\""), "1: toml: "},
      {replaced("seed = 1", "seed = 99999999999999999999"), "2: toml: "},
      {"<html>", "1: toml: "},
  });
}

// Options of sim on a good scenario; a file of configuration, if the row has one.
struct OptionRow {
  std::vector<std::string> options;
  std::string line;
  std::string overlay;
};

TEST_CASE("refusals: sim refuses bad options and configurations", "[system][refusals]") {
  const std::vector<std::string> over{"--config", "c.toml"};
  const std::vector<OptionRow> rows{
      {over, "^c.toml:2: devices.heading: is real, and sim sails by itself",
       "[devices]\nheading = \"nav440:/dev/none\"\nposition = \"none\"\n"
       "thrusters = \"none\"\n[estimator]\nposition_source = \"dead_reckoning\"\n"
       "[simulation]\nvessel = \"estimate\"\n"},
      {over, "^c.toml:3: battery.critical_V: must be below low_V",
       "[battery]\nlow_V = 22.0\ncritical_V = 23.0\n"},
      {{"--set", ""}, "^--set:1: : must be SECTION.KEY=VALUE", ""},
      {{"--set", "garbage"}, "^--set:1: garbage: must be", ""},
      {{"--set", "=1"}, "^--set:1: =1: must be", ""},
      {{"--set", "x=1"}, "^--set:1: x: unknown key", ""},
      {{"--set", "planner.foo=1"}, "^--set:1: planner.foo: unknown key", ""},
      {{"--set", "zones.margin_m="}, "^--set:1: toml: ", ""},
      {{"--set", "zones.margin_m=\"a\""}, "^--set:1: zones.margin_m: must be a number", ""},
      {{"--set", "zones.margin_m=-1"}, "^--set:1: zones.margin_m: must be at least", ""},
      {{"--set", "zones.margin_m=nan"}, "^--set:1: zones.margin_m: must be finite", ""},
      {{"--set", "zones=1"}, "^--set:1: zones", ""},
      {{"--set", "zones.margin_m=1\nzones.hull_radius_m=1"}, "^--set:1: .*: must be", ""},
      {{"--set", "zones.source=\"mine\""}, "^--set:1: zones.source: must be one of", ""},
      {{"--set", "zones.slow_share=1.5"}, "^--set:1: zones.slow_share: must be", ""},
      {{"--set", "planner.space=\"moon\""}, "^--set:1: planner.space: must be one of", ""},
      {{"--set", "pilot.narrow_speed_share=0"}, "^--set:1: pilot.narrow_speed_share: ", ""},
      {{"--set", "pilot.clearance=1"}, "^--set:1: pilot.clearance: unknown key", ""},
      {{"--set", "vehicle.mass_kg=0"}, "^--set:1: vehicle.mass_kg: must be", ""},
      {{"--set", "tracks.delay_s=2.5"}, "^--set:1: tracks.delay_s: must be", ""},
      {{"--set", "tracks.dropout=1"}, "^--set:1: tracks.dropout: must be", ""},
      {{"--set", "command_socket.port=70000"}, "^--set:1: command_socket.port: ", ""},
      {{"--set", "devices.sonar=\"\""}, "^--set:1: devices.sonar: ", ""},
      {{"--set", "devices.sonar=\"sim\""}, "^--set:1: devices.sonar: .*known: sim", ""},
      {{"--set", "devices.heading=\"foo:bar\""}, "^--set:1: devices.heading: ", ""},
      {{"--profile", "fast"}, "--profile", ""},
      {{"--seed", "-1"}, "--seed", ""},
      {{"--seed", "1.5"}, "--seed", ""},
      {{"--seed", "abc"}, "--seed", ""},
      {{"--seed", "99999999999999999999"}, "--seed", ""},
      {{"--time-limit", "0"}, "--time-limit", ""},
      {{"--time-limit", "nan"}, "--time-limit", ""},
      {{"--console", "maybe"}, "--console", ""},
      {{"--bogus"}, "--bogus", ""},
      {{"--config", "nothere.toml"}, "^nothere.toml:1: file: cannot be read", ""},
      {{"--config", "/"}, "^/:1: file: cannot be read", ""},
      {over, "^c.toml:1: sonar: unknown key", "[sonar]\nrange_m = 3\n"},
      {over, "^c.toml:2: planner.waypoint_interval_m: ", "[planner]\nwaypoint_interval_m = -1\n"},
      {over, "^c.toml:3: planner.typo: unknown key", "[planner]\n\ntypo = 1\n"},
      {over, "^c.toml:2: toml: ", "[planner]\n= 3\n"},
      {over, "^c.toml:1: file: is larger", repeated("\n", 2U << 20U)},
      {over, "^c.toml:1: toml: ", "\xff"},
      {over, "^c.toml:2: devices.thrusters: ", "[devices]\nthrusters = \"can:0\"\n"},
  };
  for (const OptionRow& row : rows) {
    INFO(row.line << "\n" << row.overlay.substr(0, 100));
    Bench bench;
    bench.write("s.toml", kGoodScenario);
    if (!row.overlay.empty()) {
      bench.write("c.toml", row.overlay);
    }
    check_refused(bench, bench.run(LODESMAN_PROGRAM, simulation_of("s.toml", row.options)),
                  row.line);
  }
}

TEST_CASE(
    "refusals: an order names a port that can be, a host whose token it has and a sound token file",
    "[system][refusals]") {
  const std::vector<std::vector<std::string>> rows{{"--port", "99999"},
                                                   {"--port", "65536"},
                                                   {"--port", "abc"},
                                                   {"--port", "-1"},
                                                   {"--port", "0"},
                                                   {"--port", "7447x"},
                                                   {"--port", ""},
                                                   {"--host", "192.0.2.1"},
                                                   {"--host", "boat"},
                                                   {"--host", ""},
                                                   {"--token-file", "nothere"}};
  for (const auto& row : rows) {
    for (const std::string command : {"abort", "status"}) {
      INFO(command << " " << row.front() << " " << row.back());
      const Bench bench;
      std::vector<std::string> arguments{command};
      arguments.insert(arguments.end(), row.begin(), row.end());
      const bool names_file = row.front() == "--token-file";
      check_refused(bench, bench.run(LODESMAN_PROGRAM, arguments),
                    names_file ? "^nothere:1: token: cannot be read" : row.front());
    }
  }
}

TEST_CASE("refusals: sim refuses what is no readable file", "[system][refusals]") {
  for (const std::string name : {"nothere.toml", ".", "/", "/dev/null", ""}) {
    INFO(name);
    const Bench bench;
    check_refused(bench, bench.run(LODESMAN_PROGRAM, simulation_of(name)), ": ");
  }
  Bench bench;
  bench.write("s.toml", kGoodScenario);
  bench.write("taken", "");
  check_refused(bench,
                bench.run(LODESMAN_PROGRAM, {"sim", "s.toml", "--lockstep", "--out", "taken/out"}),
                "^--out: ");
}

TEST_CASE("refusals: lodesman-low refuses before it makes a segment", "[system][refusals]") {
  struct Row {
    std::string configuration;
    std::string scenario;
    std::string line;
  };
  const std::string configuration = text_of(LODESMAN_CONFIGURATION);
  const std::vector<Row> rows{
      {"[planner", kGoodScenario, "^c.toml:1: toml: "},
      {configuration + "\n[typo]\nx = 1\n", kGoodScenario, "^c.toml:[0-9]+: typo: unknown key"},
      {configuration, "", "^s.toml:1: name: missing"},
      {configuration, replaced("seed = 1", "seed = -1"), "^s.toml:2: seed: "},
      {configuration, replaced("beams = 240", "bans = 240"), "^s.toml:43: sonar.bans: unknown"},
  };
  for (const Row& row : rows) {
    INFO(row.line);
    Bench bench;
    bench.write("c.toml", row.configuration);
    bench.write("s.toml", row.scenario);
    const std::string segment = "lodesman-refusals-" + std::to_string(getpid());
    check_refused(bench,
                  bench.run(LODESMAN_LOW_PROGRAM,
                            {"--segment", segment, "--config", "c.toml", "--scenario", "s.toml"}),
                  row.line);
    CHECK_FALSE(fs::exists("/dev/shm/" + segment));
  }
}

TEST_CASE("refusals: devices that do not go together are refused by both programs",
          "[system][refusals]") {
  struct Row {
    std::string configuration;
    std::string line;
  };
  const std::string real =
      "[devices]\nheading = \"nav440:/dev/none\"\nposition = \"gpsd:localhost\"\n"
      "thrusters = \"maestro:/dev/none\"\n";
  const std::string estimate = "[simulation]\nvessel = \"estimate\"\n";
  const std::vector<Row> rows{
      {"[devices]\nsonar = \"none\"\n", "^c.toml:2: devices.sonar: must not be none"},
      {"[devices]\nheading = \"none\"\n", "^c.toml:2: devices.heading: must not be none"},
      {"[devices]\nheading = \"can:0\"\n", "^c.toml:2: devices.heading: \"can:0\" is no address"},
      {"[devices]\nthrusters = \"maestro:/dev/none\"\n",
       "^c.toml:2: devices.thrusters: is real, and the simulated vessel is moved by simulated"},
      {"[devices]\nheading = \"nav440:/dev/none\"\n", "^c.toml:2: devices.heading: is real, and"},
      {estimate, "^c.toml:2: simulation.vessel: is where the estimate is"},
      {real + estimate + "[estimator]\nposition_source = \"truth\"\n",
       "^c.toml:8: estimator.position_source: the truth of a simulated world must not steer"},
      {"[devices]\nposition = \"none\"\n[estimator]\nposition_source = \"gps\"\n",
       "^c.toml:2: devices.position: is none: the position's source must be dead_reckoning"},
      {"[devices]\nposition = \"none\"\n",
       "^c.toml:2: devices.position: is none: the position's source must be dead_reckoning"},
      {"[devices]\nposition = \"nav440:/dev/none\"\n",
       "^c.toml:2: devices.position: must be nav440:@heading"},
      {"[devices]\nposition = \"nav440:@heading\"\n",
       "^c.toml:2: devices.position: needs devices.heading to be a nav440:"},
      {"[devices]\nheading = \"nav440:/dev/none\"\nposition = \"nav440:@heading\"\n",
       "^c.toml:3: devices.position: needs packet=N1 or packet=N0"},
      {"[devices]\nposition = \"gpsd:localhost:0\"\n",
       "^c.toml:2: devices.position: the port of gpsd must be from 1 to 65535"},
      {"[devices]\nposition = \"nmea:/dev/none?baud=9601\"\n",
       "^c.toml:2: devices.position: setting baud"},
      {"[mounting]\nantenna_m = [0.0, 101.0]\n", "^c.toml:2: mounting.antenna_m: "},
      {"[mounting]\nsonar_deg = 181.0\n", "^c.toml:2: mounting.sonar_deg: "},
      {"[devices]\nheading = \"sim:\"\n[simulation]\nvessel = \"bench\"\n",
       "^c.toml:2: devices.heading: is simulated, and the world is the bench's"},
  };
  for (const Row& row : rows) {
    for (const char* program : {LODESMAN_LOW_PROGRAM, LODESMAN_HIGH_PROGRAM}) {
      INFO(program << " " << row.configuration);
      Bench bench;
      bench.write("c.toml", row.configuration);
      const std::string segment = "lodesman-refusals-" + std::to_string(getpid());
      check_refused(bench,
                    bench.run(program, {"--segment", segment, "--config", "c.toml", "--scenario",
                                        "paper-static"}),
                    row.line);
      CHECK_FALSE(fs::exists("/dev/shm/" + segment));
    }
  }
}

TEST_CASE("refusals: a world that nothing is in, and a simulated device without one",
          "[system][refusals]") {
  const std::string all_real =
      "[devices]\nheading = \"nav440:/dev/none\"\nsonar = \"delta_t:192.0.2.7\"\n"
      "position = \"none\"\nthrusters = \"maestro:/dev/none\"\n";
  const auto refuse = [](const std::string& configuration, const std::string& line) {
    Bench bench;
    bench.write("c.toml", configuration);
    check_refused(bench, bench.run(LODESMAN_LOW_PROGRAM, {"--config", "c.toml"}), line);
  };
  refuse(all_real + "[simulation]\nscenario = \"paper-static\"\n",
         "^c.toml:7: simulation.scenario: no device is simulated");
  refuse(all_real + "[simulation]\nvessel = \"estimate\"\n",
         "^c.toml:7: simulation.vessel: no device is simulated");
  refuse(all_real + "[simulation]\nvessel = \"bench\"\nscenario = \"\"\n",
         "^c.toml:8: simulation.scenario: the vessel is on the bench: give the scenario");
  refuse("[simulation]\nscenario = \"\"\n",
         "^c.toml:2: simulation.scenario: devices.heading is simulated: give the scenario");
}

TEST_CASE("refusals: lodesman-high refuses an unknown key before it looks for a segment",
          "[system][refusals]") {
  const std::string configuration = text_of(LODESMAN_CONFIGURATION);
  for (const std::string extra : {"\n[typo]\nx = 1\n", "\n[[typo]]\n"}) {
    Bench bench;
    bench.write("c.toml", configuration + extra);
    bench.write("s.toml", kGoodScenario);
    check_refused(bench,
                  bench.run(LODESMAN_HIGH_PROGRAM,
                            {"--segment", "lodesman-refusals-" + std::to_string(getpid()),
                             "--config", "c.toml", "--scenario", "s.toml"}),
                  "^c.toml:[0-9]+: .*typo: unknown key");
  }
}

}  // namespace
}  // namespace lodesman
