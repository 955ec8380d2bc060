// SPDX-License-Identifier: Apache-2.0
// Small scenarios that were once sailed wrongly (data/hard_cases/pilot), each held to what is
// right. What is not mended yet is listed as such, and has to fail: who mends it takes that away.
#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/data_dir.h"
#include "tests/system/boat.h"
#include "tests/system/judged_run.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// What is asked of a run beside that it touches nothing.
enum class Right {
  kGoal,       // the goal is reached
  kStraight,   // and nothing passed on another side than before
  kWaits,      // it holds by decision
  kSays,       // a notice says what is wrong
  kNoContact,  // no more
};

struct HardCase {
  const char* name;
  Right right = Right::kGoal;
  bool mended = true;
  const char* says = "";
  std::vector<std::string> sets = {};
};

constexpr bool kNotMended = false;
constexpr double kAtGoal_m = 1.0;

[[nodiscard]] bool is_right(const HardCase& hard, const cli::RunResult& result) {
  if (result.collided) {
    return false;
  }
  const bool at_goal = result.outcome == "goal" && result.goal_error_m < kAtGoal_m;
  switch (hard.right) {
    case Right::kGoal: return at_goal;
    case Right::kStraight: return at_goal && result.side_flips == 0;
    case Right::kWaits: return result.outcome == "held";
    case Right::kSays:
      return std::any_of(result.notices.begin(), result.notices.end(), [&](const auto& notice) {
        return notice.text.find(hard.says) != std::string::npos;
      });
    case Right::kNoContact: return true;
  }
  return false;
}

void sail(const std::vector<HardCase>& cases) {
  const auto folder = data_path("hard_cases/pilot");
  if (!folder) {
    return;
  }
  for (const HardCase& hard : cases) {
    const JudgedRun run = judged_run((*folder / hard.name).string() + ".toml", hard.sets);
    INFO(run.story);
    CHECK(is_right(hard, run.result) == hard.mended);
  }
}

// Straight on for 24 m at 0.42 m/s; `more` goes on with the mission's keys.
[[nodiscard]] JudgedRun run_of_24_m(int time_limit_s, const std::string& more) {
  const Scratch scratch{"hard-cases"};
  const auto scenario = scratch.file("24-m.toml", R"(
name = "24-m"
seed = 1
time_limit_s = )" + std::to_string(time_limit_s) + R"(.0
[vehicle]
speed_m_s = 0.42
radius_m = 0.5
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
goal_m = [0.0, 24.0]
goal_radius_m = 0.5
)" + more);
  return judged_run(scenario.string());
}

}  // namespace

TEST_CASE("hard cases: goals that are far, close to something or on a rock", "[system]") {
  sail({{"far-goal"},
        {"goal-2500-m"},
        {"goal-by-a-quay"},
        {"goal-in-gap-2.8-posts"},
        {"waypoint-beside-a-rock"},
        {"goal-on-rock", Right::kWaits},
        {"goal-on-rock-circles", Right::kWaits},
        {"blocked-waypoint", Right::kSays, true, "held: no way to the waypoint"},
        {"freeze-goal-between-two-stones", Right::kGoal, kNotMended},
        {"gps-99-km", Right::kGoal, kNotMended}});
}

TEST_CASE(
    "hard cases: a waypoint on a rock is waited for as long as the mission says, and left out",
    "[system]") {
  const JudgedRun run = run_of_24_m(300, R"(
waypoints_m = [[0.0, 12.0]]
blocked = "skip"
blocked_patience_s = 20.0
[[obstacle]]
shape = "circle"
centre_m = [0.0, 12.0]
radius_m = 1.0
protection_m = 2.5
)");
  INFO(run.story);
  CHECK(is_right({"", Right::kGoal}, run.result));
  CHECK(is_right({"", Right::kSays, true, "makes for the next waypoint"}, run.result));
  CHECK(run.result.time_s > 24.0 / 0.42 + 20.0);
}

TEST_CASE("hard cases: a sonar that is silent is waited for and said, and it sails on with it",
          "[system]") {
  const JudgedRun run = run_of_24_m(120, R"(
[[fault]]
device = "sonar"
kind = "stall"
at_s = 20.0
duration_s = 30.0
)");
  INFO(run.story);
  CHECK(is_right({"", Right::kGoal}, run.result));
  CHECK(is_right({"", Right::kSays, true, "the sonar is silent"}, run.result));
  CHECK(run.result.time_s > 24.0 / 0.42 + 25.0);
  CHECK(run.result.guard_trips.empty());
}

TEST_CASE("hard cases: what is seen, whatever its size", "[system]") {
  sail({{"island"}, {"long-coast"}, {"post"}, {"short-sight"}, {"search-limit", Right::kWaits}});
}

TEST_CASE("hard cases: ways that are hard to find", "[system]") {
  sail({{"freeze-in-spiral"},
        {"orbit-after-waypoint"},
        {"detour-one-mover-fast-boat"},
        {"detour-one-slow-ellipse"},
        {"side-flips-in-a-gap", Right::kStraight},
        {"forgotten-bay", Right::kGoal, kNotMended},
        {"freeze-before-closed-gap", Right::kGoal, kNotMended},
        {"freeze-in-forest", Right::kGoal, kNotMended}});
}

TEST_CASE("hard cases: current and slip", "[system]") {
  sail({{"current-0.8-fast-boat"},
        {"current-mover-detour"},
        {"gps-current"},
        {"lift-0.42"},
        {"lift-0.74"},
        {"lift-1.12"},
        {"lift-orbits-the-goal"},
        {"current-0.6-astern"},
        {"current-0.8-abeam"},
        {"current-0.8-slow-touch"},
        {"unknown-current", Right::kGoal, kNotMended},
        {"set-on-rock", Right::kGoal, kNotMended}});
}

TEST_CASE("hard cases: movers that come close", "[system]") {
  sail({{"touch-flight-ahead"},
        {"touch-in-flight"},
        {"turns-into-the-boat"},
        {"touch-undecided", Right::kGoal, kNotMended},
        {"channel-at-speed", Right::kNoContact, kNotMended},
        {"sonar-silence"},
        {"velocity-doubt-0.05", Right::kGoal, true, "", {"tracks.velocity_sigma_m_s=0.05"}},
        {"noise-heavy",
         Right::kGoal,
         kNotMended,
         "",
         {"tracks.place_sigma_m=0.3", "tracks.velocity_sigma_m_s=0.1", "tracks.dropout=0.6",
          "tracks.delay_s=0.5"}}});
}

TEST_CASE("hard cases: what makes no way says so", "[system]") {
  sail({{"current-across", Right::kSays, true, "it is carried elsewhere"},
        {"current-stronger", Right::kSays, true, "it is carried elsewhere"},
        {"dead-thruster", Right::kSays, true, "the thruster box"},
        {"thrusters-gone", Right::kSays, true, "the thruster box"},
        {"gps-gap-says-no-frame", Right::kSays, true, "the position is lost"}});
}
