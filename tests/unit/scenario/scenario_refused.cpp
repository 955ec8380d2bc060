// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "hal_sim/scenario/scenario.h"
#include "tests/support/catch.h"
#include "tests/support/shipped_vessel.h"

namespace lodesman {
namespace {

using testing::kGoodScenario;
using testing::replaced;
using testing::scenario_of;

// A good scenario with one thing changed, and the one line that must refuse it.
struct Row {
  std::string old;
  std::string by;
  std::string line;
};

[[nodiscard]] std::string refusal_of(const std::string& text) {
  try {
    static_cast<void>(scenario_of(text));
  } catch (const StartupError& error) {
    return error.what();
  }
  return "accepted";
}

void check_rows(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    INFO(row.old << " -> " << row.by);
    const std::string text = replaced(kGoodScenario, row.old, row.by);
    REQUIRE_FALSE(text.empty());
    const std::string refusal = refusal_of(text);
    CHECK(refusal == row.line);
    CHECK(refusal.find('\n') == std::string::npos);
  }
}

const std::string kMany(70, 'x');
const std::string kBoxFaults =
    "stall, disconnect, flip, burst, drop, duplicate, insert, interference, cut, late, batch, "
    "hang, "
    "replug, power, error, reset, refuse, no_time_out, wrong_mode, battery";

TEST_CASE("scenario: head, mission and vehicle are refused with one line", "[hal_sim][scenario]") {
  check_rows({
      {"name = \"a-good.one\"", "", "s.toml:1: name: missing"},
      {"a-good.one", "A good one", "s.toml:1: name: may hold a-z, 0-9, '.' and '-' only"},
      {"a-good.one", "", "s.toml:1: name: must have 1 to 64 characters"},
      {"a-good.one", kMany, "s.toml:1: name: must have 1 to 64 characters"},
      {"name = \"a-good.one\"", "name = 3", "s.toml:1: name: must be a text"},
      {"seed = 1", "", "s.toml:1: seed: missing"},
      {"seed = 1", "seed = -1", "s.toml:2: seed: must be from 0 to 9223372036854775807"},
      {"seed = 1", "seed = 1.5", "s.toml:2: seed: must be a whole number"},
      {"seed = 1", "seed = 1\nseed = 2",
       "s.toml:3: toml: Error while parsing key-value pair: cannot redefine existing integer "
       "'seed'"},
      {"seed = 1", "sed = 1", "s.toml:1: seed: missing"},
      {"seed = 1", "seed = 1\nspeed = 1", "s.toml:3: speed: unknown key"},
      {"time_limit_s = 200.0", "time_limit_s = 0.0",
       "s.toml:3: time_limit_s: must be greater than 0 and at most 100000"},
      {"time_limit_s = 200.0", "time_limit_s = inf", "s.toml:3: time_limit_s: must be finite"},
      {"time_limit_s = 200.0", "time_limit_s = nan", "s.toml:3: time_limit_s: must be finite"},
      {"time_limit_s = 200.0", "time_limit_s = \"200\"",
       "s.toml:3: time_limit_s: must be a number"},
      {"time_limit_s = 200.0", "time_limit_s = 80.0",
       "s.toml:7: mission.goal_m: is farther than speed x time limit (19.5 m on the way, 17.76 m "
       "in the time)"},
      {"[mission]\n", "[misson]\n", "s.toml:1: mission: missing"},
      {"start_m = [0.0, 0.0]", "start_m = [0.0]",
       "s.toml:5: mission.start_m: must be two numbers [x, y]"},
      {"start_m = [0.0, 0.0]", "start_m = [0.0, nan]", "s.toml:5: mission.start_m: must be finite"},
      {"start_heading_deg = 0.0", "start_heading_deg = -1.0",
       "s.toml:6: mission.start_heading_deg: must be at least 0 and at most 360"},
      {"start_heading_deg = 0.0", "start_heading = 0.0",
       "s.toml:4: mission.start_heading_deg: missing"},
      {"goal_m = [0.0, 20.0]", "goal_m = [0.0, 45.0]",
       "s.toml:7: mission.goal_m: is farther than speed x time limit (44.5 m on the way, 44.4 m "
       "in the time)"},
      {"goal_m = [0.0, 20.0]", "goal_m = [0.0, inf]", "s.toml:7: mission.goal_m: must be finite"},
      {"goal_m = [0.0, 20.0]", "goal_m = [0.0, 20.0]\nwaypoints_m = [[30.0, 0.0]]",
       "s.toml:7: mission.goal_m: is farther than speed x time limit (64.56 m on the way, 44.4 m "
       "in the time)"},
      {"goal_m = [0.0, 20.0]", "goal_m = [0.0, 20.0]\nwaypoints_m = [3.0, 0.0]",
       "s.toml:8: mission.waypoints_m: must be two numbers [x, y]"},
      {"goal_radius_m = 0.5", "goal_radius_m = -0.5",
       "s.toml:8: mission.goal_radius_m: must be greater than 0 and at most 100"},
      {"speed_m_s = 0.22", "", "s.toml:9: vehicle.speed_m_s: give either speed_m_s or surge_ref"},
      {"speed_m_s = 0.22", "speed_m_s = 0.22\nsurge_ref = 16",
       "s.toml:11: vehicle.surge_ref: give either speed_m_s or surge_ref"},
      {"speed_m_s = 0.22", "speed_m_s = 0.02",
       "s.toml:10: vehicle.speed_m_s: no SurgeRef holds it within 3 % (the nearest, 1, gives "
       "0.01362 m/s)"},
      {"speed_m_s = 0.22", "speed_m_s = 2.0",
       "s.toml:10: vehicle.speed_m_s: no SurgeRef holds it within 3 % (the nearest, 100, gives "
       "1.207 m/s)"},
      {"speed_m_s = 0.22", "speed_m_s = 0.0",
       "s.toml:10: vehicle.speed_m_s: must be greater than 0 and at most 10"},
      {"speed_m_s = 0.22", "surge_ref = 101",
       "s.toml:10: vehicle.surge_ref: must be from 1 to 100"},
      {"speed_m_s = 0.22", "surge_ref = 16.0",
       "s.toml:10: vehicle.surge_ref: must be a whole number"},
      {"radius_m = 0.5\n[[obstacle]]", "[[obstacle]]", "s.toml:9: vehicle.radius_m: missing"},
      {"radius_m = 0.5\n[[obstacle]]", "radius_m = 0.0\n[[obstacle]]",
       "s.toml:11: vehicle.radius_m: must be greater than 0 and at most 100"},
  });
}

TEST_CASE("scenario: obstacles are refused with one line", "[hal_sim][scenario]") {
  check_rows({
      {"shape = \"circle\"", "shape = \"square\"",
       "s.toml:13: obstacle[0].shape: must be one of: circle, ellipse, polyline, polygon"},
      {"shape = \"circle\"", "", "s.toml:12: obstacle[0].shape: missing"},
      {"centre_m = [0.0, 10.0]", "centre_m = [0.0, 1e9]",
       "s.toml:14: obstacle[0].centre_m: must be at least -100000 and at most 100000"},
      {"radius_m = 0.5\nprotection_m", "radius_m = 0.0\nprotection_m",
       "s.toml:15: obstacle[0].radius_m: must be at least 0.001 and at most 10000"},
      {"protection_m = 3.5", "protection_m = 0.4",
       "s.toml:16: obstacle[0].protection_m: is smaller than the obstacle"},
      {"protection_m = 3.5", "", "s.toml:12: obstacle[0].protection_m: missing"},
      {"protection_m = 3.5", "protection_m = 3.5\nsemi_axes_m = [1.0, 1.0]",
       "s.toml:17: obstacle[0].semi_axes_m: unknown key"},
      {"stop_at_m = [0.0, 0.0]", "stop_at_m = [0.02, 0.0]",
       "s.toml:18: obstacle[0].stop_at_m: is off the course"},
      {"stop_at_m = [0.0, 0.0]", "stop_at_m = [0.0, 11.0]",
       "s.toml:18: obstacle[0].stop_at_m: is off the course"},
      {"velocity_m_s = [0.0, -0.11]", "", "s.toml:18: obstacle[0].stop_at_m: needs a velocity_m_s"},
      {"velocity_m_s = [0.0, -0.11]", "velocity_m_s = [0.0, 0.0]",
       "s.toml:18: obstacle[0].stop_at_m: needs a velocity_m_s"},
      {"velocity_m_s = [0.0, -0.11]", "velocity_m_s = [0.0, 99.0]",
       "s.toml:17: obstacle[0].velocity_m_s: must be at least -10 and at most 10"},
      {"end_s = 60.0", "end_s = 5.0", "s.toml:20: obstacle[0].end_s: must be after start_s"},
      {"start_s = 5.0", "start_s = -5.0",
       "s.toml:19: obstacle[0].start_s: must be at least 0 and at most 100000"},
      {"semi_axes_m = [1.5, 0.4]", "semi_axes_m = [1.5, -0.4]",
       "s.toml:24: obstacle[1].semi_axes_m: must be at least 0.001 and at most 10000"},
      {"protection_semi_axes_m = [4.0, 2.0]", "protection_semi_axes_m = [4.0, 0.3]",
       "s.toml:26: obstacle[1].protection_semi_axes_m: is smaller than the obstacle"},
      {"protection_semi_axes_m = [4.0, 2.0]", "protection_m = 4.0",
       "s.toml:21: obstacle[1].protection_semi_axes_m: missing"},
      {"angle_deg = 30.0", "angle_deg = \"30\"",
       "s.toml:25: obstacle[1].angle_deg: must be a number"},
      {"[[-10.0, 25.0], [10.0, 25.0]]", "[[-10.0, 25.0]]",
       "s.toml:29: obstacle[2].points_m: must be 2 to 32 points [[x, y], ...]"},
      {"shape = \"polyline\"", "shape = \"polygon\"",
       "s.toml:29: obstacle[2].points_m: must be 3 to 32 points [[x, y], ...]"},
      {"[[-10.0, 25.0], [10.0, 25.0]]", "[[-10.0, 25.0], [10.0, 25.0, 1.0]]",
       "s.toml:29: obstacle[2].points_m: must be two numbers [x, y]"},
      {"protection_m = 1.0", "protection_m = -1.0",
       "s.toml:30: obstacle[2].protection_m: must be at least 0 and at most 10000"},
      {"[[obstacle]]\nshape = \"polyline\"", "[[obstacles]]\nshape = \"polyline\"",
       "s.toml:27: obstacles: unknown key"},
  });
}

TEST_CASE("scenario: environment, position, sonar and faults are refused with one line",
          "[hal_sim][scenario]") {
  check_rows({
      {"current_m_s = [0.1, 0.0]", "current_m_s = 0.1",
       "s.toml:32: environment.current_m_s: must be two numbers [x, y]"},
      {"lift = true", "lift = 1", "s.toml:33: environment.lift: must be true or false"},
      {"origin_deg = [36.0, 138.0]", "origin_deg = [138.0, 36.0]",
       "s.toml:34: environment.origin_deg: latitude must be at least -85 and at most 85"},
      {"source = \"gps\"", "source = \"gnss\"",
       "s.toml:36: position.source: must be one of: truth, gps, dead_reckoning"},
      {"gps_sigma_m = 2.0", "gps_sigma_m = -2.0",
       "s.toml:37: position.gps_sigma_m: must be at least 0 and at most 100"},
      {"scene = \"beams\"", "scene = \"beam\"",
       "s.toml:39: sonar.scene: must be one of: obstacles, beams, detections"},
      {"noise = \"none\"", "noise = \"lake\"",
       "s.toml:40: sonar.noise: must be one of: none, tank, sea"},
      {"range_m = 20.0", "range_m = 0.0",
       "s.toml:41: sonar.range_m: must be at least 1 and at most 300"},
      {"sector_deg = 90.0", "sector_deg = 270.0",
       "s.toml:42: sonar.sector_deg: must be at least 1 and at most 180"},
      {"beams = 240", "beams = 513", "s.toml:43: sonar.beams: must be from 1 to 512"},
      {"bins = 400", "bins = 0", "s.toml:44: sonar.bins: must be from 1 to 1000"},
      {"ping_hz = 5.0", "ping_hz = 0.0",
       "s.toml:45: sonar.ping_hz: must be at least 0.1 and at most 50"},
      {"ping_hz = 5.0", "[sonar.detections]\nmissed = 0.1",
       "s.toml:45: sonar.detections: is of scene = \"detections\" alone"},
      {"device = \"thruster\"", "device = \"gps\"",
       "s.toml:47: fault[0].device: must be one of: ahrs, thruster, sonar, position"},
      {"kind = \"disconnect\"", "kind = \"corrupt\"",
       "s.toml:48: fault[0].kind: must be one of: " + kBoxFaults},
      {"kind = \"disconnect\"", "kind = \"explode\"",
       "s.toml:48: fault[0].kind: must be one of: " + kBoxFaults},
      {"kind = \"disconnect\"", "kind = \"frozen\"",
       "s.toml:48: fault[0].kind: must be one of: " + kBoxFaults},
      {"device = \"thruster\"\nkind = \"disconnect\"", "device = \"sonar\"\nkind = \"flip\"",
       "s.toml:48: fault[0].kind: must be one of: stall, corrupt, disconnect, hang, power, "
       "reorder, foreign, repeat, jump, range, output, average, centimetres, saturated, blinded, "
       "weed, drop, duplicate, cut, frozen, interference"},
      {"kind = \"disconnect\"", "kind = 3", "s.toml:48: fault[0].kind: must be a text"},
      {"duration_s = 5.0", "duration_s = 5.0\nrate = 0.1", "s.toml:51: fault[0].rate: unknown key"},
      {"duration_s = 5.0", "duration_s = 5.0\nvalue = 0.1",
       "s.toml:51: fault[0].value: unknown key"},
      {"kind = \"disconnect\"", "kind = \"flip\"\nrate = 1.1",
       "s.toml:49: fault[0].rate: must be at least 0 and at most 1"},
      {"kind = \"disconnect\"", "kind = \"flip\"\nvalue = 1.0",
       "s.toml:49: fault[0].value: unknown key"},
      {"kind = \"disconnect\"", "kind = \"refuse\"\nvalue = 24",
       "s.toml:49: fault[0].value: must be at least 0 and at most 23"},
      {"at_s = 20.0", "at_s = -1.0",
       "s.toml:49: fault[0].at_s: must be at least 0 and at most 100000"},
      {"duration_s = 5.0", "duration_s = 0.0",
       "s.toml:50: fault[0].duration_s: must be greater than 0 and at most 100000"},
      {"duration_s = 5.0", "", "s.toml:46: fault[0].duration_s: missing"},
      {"duration_s = 5.0", "duration_s = 5.0\nend_s = 7.0",
       "s.toml:51: fault[0].end_s: unknown key"},
      {"[environment]", "[enviroment]", "s.toml:31: enviroment: unknown key"},
      {"[sonar]", "[sonar",
       "s.toml:38: toml: Error while parsing table header: expected ']', saw '\\n'"},
  });
}

TEST_CASE("scenario: errors of detections are refused with one line", "[hal_sim][scenario]") {
  const auto refused = [](const std::string& line) {
    const std::string text = replaced(kGoodScenario, "\"beams\"", "\"detections\"");
    return refusal_of(replaced(text, "[[fault]]", "[sonar.detections]\n" + line + "\n[[fault]]"));
  };
  CHECK(refused("missed = 0.95") ==
        "s.toml:47: sonar.detections.missed: must be at least 0 and at most 0.9");
  CHECK(refused("split = 1.1") ==
        "s.toml:47: sonar.detections.split: must be at least 0 and at most 1");
  CHECK(refused("displaced_m = -0.1") ==
        "s.toml:47: sonar.detections.displaced_m: must be at least 0 and at most 5");
  CHECK(refused("false_per_ping = 11") ==
        "s.toml:47: sonar.detections.false_per_ping: must be at least 0 and at most 10");
  CHECK(refused("noise_m = \"0.1\"") == "s.toml:47: sonar.detections.noise_m: must be a number");
  CHECK(refused("mised = 0.1") == "s.toml:47: sonar.detections.mised: unknown key");
}

TEST_CASE("scenario: a file over 1 MiB is refused unread", "[hal_sim][scenario]") {
  const std::string text = kGoodScenario + std::string(TomlDocument::kMaxBytes, '#');
  CHECK(refusal_of(text) == "s.toml:1: file: is larger than 1 MiB");
}

TEST_CASE("scenario: more obstacles than a frame holds are refused", "[hal_sim][scenario]") {
  std::string text = kGoodScenario;
  for (std::size_t i = 0; i < kMaxObstacles; ++i) {
    text += "[[obstacle]]\nshape = \"circle\"\n";
  }
  CHECK(refusal_of(text) == "s.toml:12: obstacle: must be at most 64 [[obstacle]] tables");
}

}  // namespace
}  // namespace lodesman
