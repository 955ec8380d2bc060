// SPDX-License-Identifier: Apache-2.0
// The whole boat in lock-step: what the paper reports, and that nothing but the scenario decides.
#include <algorithm>
#include <array>
#include <cmath>

#include "deploy/boat/configuration.h"
#include "deploy/operator/report/run_files.h"
#include "deploy/operator/run/lockstep_run.h"
#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::cli;

namespace {

RunRecord sail(const std::string& scenario_name, const std::string& profile,
               std::vector<std::string> sets = {}, std::uint64_t seed = 1) {
  CommonOptions options;
  options.sets = std::move(sets);
  const BoatConfig configuration = load_configuration(profile, options);
  Scenario scenario = load_named_scenario(scenario_name, configuration.speeds);
  scenario.seed = seed;
  const std::function<bool()> never = [] { return false; };
  const std::function<void(const RunProgress&)> silent = [](const RunProgress&) {};
  return run_lockstep({configuration, scenario, never, silent, {}});
}

double to_obstacle_m(const PlanRecord& plan, const RunRecord& record) {
  const Obstacle& obstacle = record.obstacles.front().at_start;
  return std::hypot(plan.start_m[0] - obstacle.centre_x_m, plan.start_m[1] - obstacle.centre_y_m);
}

}  // namespace

TEST_CASE(
    "paper-static: reached as the paper reports it, with its loss of the path inside the "
    "protection circle (Figs 4, 5)",
    "[system]") {
  const RunRecord record = sail("paper-static", "paper");
  const RunResult& result = record.result;
  CHECK(result.outcome == "goal");
  CHECK(result.time_s >= 88.0);
  CHECK(result.time_s <= 115.0);
  CHECK(result.goal_error_m < 0.6);
  CHECK(result.min_inoffensive_distance_m.value() >= 2.0);
  CHECK(result.min_inoffensive_distance_m.value() <= 2.5);
  int inside = 0;
  for (const auto& plan : record.plans) {
    const bool blocked = plan.reason == PathReason::kStartBlocked;
    inside += blocked && to_obstacle_m(plan, record) <= 3.5 ? 1 : 0;
    CHECK((!blocked || plan.waypoint_source == "previous"));
  }
  CHECK(inside >= 1);
}

TEST_CASE("lock-step: the same scenario gives the same recording, another seed's jitter another",
          "[system]") {
  const RunRecord first = sail("paper-static", "paper");
  const RunRecord second = sail("paper-static", "paper");
  REQUIRE(first.result.recording_hash.has_value());
  CHECK(first.result.recording_hash == second.result.recording_hash);
  const auto jittered = [](std::uint64_t seed) {
    return sail("paper-static", "paper", {"simulation.lockstep_jitter_s = 0.005"}, seed)
        .result.recording_hash;
  };
  CHECK(jittered(1) == jittered(1));
  CHECK(jittered(1) != jittered(2));
  CHECK(jittered(1) != first.result.recording_hash);
}

// Virtual time: what the nominal times of the chain come to, and no period in between.
TEST_CASE("lock-step: a ping is thrust within a few milliseconds", "[system]") {
  for (const char* profile : {"default", "paper"}) {
    INFO(profile);
    const RunResult result = sail("paper-static", profile).result;
    REQUIRE(result.plans > 30);
    CHECK(result.ping_to_command_us.p99 > 0.0);
    CHECK(result.ping_to_command_us.p99 <= 5'000.0);
    // With each of seven steps late by a random part of 2 ms it is still no period of any of them.
    const RunResult late =
        sail("paper-static", profile, {"simulation.lockstep_jitter_s = 0.002"}).result;
    CHECK(late.ping_to_command_us.p50 <= 20'000.0);
  }
}

TEST_CASE("lock-step: the smallest inoffensive distances are those of eq. 12 (Fig. 7a)",
          "[system]") {
  // With C = 1.3 and r_pro = 3.5, eqs 10-12 give 3.44 - r_obs - 0.5.
  for (const auto& [name, radius_m] :
       {std::pair{"paper-radius-0.2", 0.2}, std::pair{"paper-radius-0.5", 0.5},
        std::pair{"paper-radius-1.0", 1.0}, std::pair{"paper-radius-1.5", 1.5}}) {
    CAPTURE(name);
    const RunResult result = sail(name, "paper").result;
    CHECK(result.outcome == "goal");
    CHECK(result.min_inoffensive_distance_m.value() == Approx(3.44 - radius_m - 0.5).margin(0.1));
  }
}

TEST_CASE("lock-step: every plan without a path says why, and every scenario ends by itself",
          "[system]") {
  for (const char* name : {"paper-multiple", "paper-moving", "tank-straight"}) {
    CAPTURE(name);
    const RunResult result = sail(name, "paper").result;
    CHECK(result.outcome == "goal");
    CHECK(result.plans == result.plans_found + result.plans_not_found);
    CHECK(result.overruns == 0);
    CHECK(result.stale_events == 0);
  }
}

TEST_CASE("lock-step: a heading that falls silent stops the boat, and it goes on when it is back",
          "[system]") {
  const auto scenario = TomlDocument::from_text(
      "name = \"stall\"\nseed = 1\ntime_limit_s = 60.0\n"
      "[mission]\nstart_m = [0.0, 0.0]\nstart_heading_deg = 0.0\ngoal_m = [0.0, 5.0]\n"
      "goal_radius_m = 0.5\n[vehicle]\nspeed_m_s = 0.22\nradius_m = 0.5\n"
      "[[fault]]\ndevice = \"ahrs\"\nkind = \"stall\"\nat_s = 5.0\nduration_s = 4.0\n",
      "stall.toml");
  const BoatConfig configuration = load_configuration("paper", {});
  const Scenario parsed = read_scenario(scenario, configuration.speeds);
  const std::function<bool()> never = [] { return false; };
  const std::function<void(const RunProgress&)> silent = [](const RunProgress&) {};
  const RunRecord record = run_lockstep({configuration, parsed, never, silent, {}});
  CHECK(record.result.outcome == "goal");
  CHECK(record.result.stale_events >= 1);
  for (const auto& row : record.trajectory) {
    const bool stopped = row.thrust_left == 128 && row.thrust_right == 128;
    if (row.t_s > 5.5 && row.t_s < 9.0) {
      CHECK(stopped);
    }
  }
}

TEST_CASE("lock-step: what cannot be reached is waited for at a place held against the current",
          "[system][plain]") {
  for (const char* current : {"[0.0, -0.1]", "[0.1, 0.0]", "[0.0, 0.1]"}) {
    // Something rests on the goal.
    const auto text = TomlDocument::from_text(
        "name = \"occupied\"\nseed = 1\ntime_limit_s = 240.0\n"
        "[mission]\nstart_m = [0.0, 0.0]\nstart_heading_deg = 0.0\ngoal_m = [0.0, 12.0]\n"
        "goal_radius_m = 0.5\n[vehicle]\nspeed_m_s = 0.22\nradius_m = 0.5\n"
        "[[obstacle]]\nshape = \"circle\"\ncentre_m = [0.0, 12.0]\nradius_m = 0.5\n"
        "protection_m = 2.0\n[environment]\ncurrent_m_s = " +
            std::string{current} + "\n",
        "occupied.toml");
    const BoatConfig configuration = load_configuration("default", {});
    const Scenario scenario = read_scenario(text, configuration.speeds);
    const std::function<bool()> never = [] { return false; };
    const std::function<void(const RunProgress&)> silent = [](const RunProgress&) {};
    const RunRecord record = run_lockstep({configuration, scenario, never, silent, {}});
    INFO(current);
    CHECK(record.result.outcome == "held");
    CHECK(record.plans.back().rung == "hold");
    CHECK(record.plans.back().reason == PathReason::kGoalBlocked);
    CHECK(record.result.min_hull_clearance_m.value() > 0.15);
    const std::array<double, 2> place = record.plans.back().waypoints_m.back();
    double farthest_m = 0.0;
    for (const auto& row : record.trajectory) {
      if (row.t_s > 120.0) {
        farthest_m = std::max(farthest_m, std::hypot(row.x_m - place[0], row.y_m - place[1]));
        CHECK(std::abs(row.surge_ref) <= 16);
      }
    }
    CHECK(farthest_m < 2.5);
  }
}

// Beside the boat, or astern: lift must not let it slide round them for ever.
TEST_CASE("lock-step: with lift a goal abeam is reached at 1.12 m/s", "[system]") {
  const BoatConfig configuration = load_configuration("default", {});
  for (const char* goal : {"[4.0, 3.0]", "[6.0, 6.0]", "[-8.0, 0.0]", "[3.0, -6.0]"}) {
    const auto text = TomlDocument::from_text(
        "name = \"abeam\"\nseed = 1\ntime_limit_s = 60.0\n"
        "[mission]\nstart_m = [0.0, 0.0]\nstart_heading_deg = 0.0\ngoal_radius_m = 0.5\n"
        "goal_m = " +
            std::string{goal} +
            "\n[vehicle]\nspeed_m_s = 1.12\nradius_m = 0.5\n[environment]\nlift = true\n",
        "abeam.toml");
    const Scenario scenario = read_scenario(text, configuration.speeds);
    const std::function<bool()> never = [] { return false; };
    const std::function<void(const RunProgress&)> silent = [](const RunProgress&) {};
    const RunRecord record = run_lockstep({configuration, scenario, never, silent, {}});
    INFO(goal);
    CHECK(record.result.outcome == "goal");
    CHECK(record.result.path_length_m < 20.0);
  }
}

// The straight way leads through the keep-out area, and round it there is room on one side alone.
TEST_CASE("areas: fence and keep-out are kept to on the way", "[system]") {
  const std::string text = R"(name = "areas"
seed = 1
time_limit_s = 200.0
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
goal_m = [0.0, 24.0]
goal_radius_m = 0.5
fence_m = [[-9.0, -4.0], [12.0, -4.0], [12.0, 30.0], [-9.0, 30.0]]
keep_out_m = [[-7.0, 8.0], [4.0, 8.0], [4.0, 12.0], [-7.0, 12.0]]
[vehicle]
speed_m_s = 0.42
radius_m = 0.5
)";
  const BoatConfig configuration = load_configuration("default", {});
  const Scenario scenario =
      read_scenario(TomlDocument::from_text(text, "areas.toml"), configuration.speeds);
  const std::function<bool()> never = [] { return false; };
  const std::function<void(const RunProgress&)> silent = [](const RunProgress&) {};
  const RunRecord record = run_lockstep({configuration, scenario, never, silent, {}});
  CHECK(record.result.outcome == "goal");
  for (const TrajectoryRow& row : record.trajectory) {
    INFO(row.t_s << " s: " << row.x_m << ", " << row.y_m);
    CHECK((row.y_m < 8.0 || row.y_m > 12.0 || row.x_m > 4.5));
    CHECK((row.x_m < 11.5 && row.x_m > -8.5));
  }
}
