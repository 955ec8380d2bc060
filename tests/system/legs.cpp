// SPDX-License-Identifier: Apache-2.0
// Missions whose lines are kept to (`legs = "line"`), judged by where the boat truly was.
#include <algorithm>
#include <string>

#include "tests/support/catch.h"
#include "tests/system/boat.h"
#include "tests/system/judged_run.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// Two lines of 40 m, 5 m apart.
[[nodiscard]] std::string survey(const char* legs, const char* current_m_s,
                                 const char* obstacles = "") {
  return std::string{R"(
name = "survey"
seed = 1
time_limit_s = 600.0
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
waypoints_m = [[0.0, 40.0], [5.0, 40.0]]
goal_m = [5.0, 0.0]
goal_radius_m = 1.0
legs = ")"} +
         legs + R"("
[vehicle]
speed_m_s = 0.74
radius_m = 0.5
[environment]
current_m_s = )" +
         current_m_s + "\n" + obstacles;
}

[[nodiscard]] std::string one_line(double length_m, const std::string& obstacles) {
  return R"(
name = "line"
seed = 1
time_limit_s = 600.0
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
goal_m = [0.0, )" +
         std::to_string(length_m) + R"(]
goal_radius_m = 1.0
legs = "line"
[vehicle]
speed_m_s = 0.74
radius_m = 0.5
)" + obstacles;
}

[[nodiscard]] JudgedRun sailed(const std::string& scenario) {
  const Scratch scratch{"legs"};
  return judged_run(scratch.file("survey.toml", scenario).string());
}

}  // namespace

TEST_CASE("legs: a line is kept to, also across a current", "[system]") {
  for (const char* current_m_s : {"[0.0, 0.0]", "[0.3, 0.0]"}) {
    const JudgedRun run = sailed(survey("line", current_m_s));
    INFO(run.story);
    CHECK(run.result.outcome == "goal");
    REQUIRE(run.result.cross_track);
    CHECK(run.result.cross_track->settled_rms_m < 0.3);
  }
}

TEST_CASE("legs: where any way will do, none is kept to nor spoken of", "[system]") {
  const JudgedRun run = sailed(survey("free", "[0.3, 0.0]"));
  INFO(run.story);
  CHECK(run.result.outcome == "goal");
  CHECK_FALSE(run.result.cross_track);
}

TEST_CASE("legs: what lies on a line is gone round, and the line gone back to", "[system]") {
  const JudgedRun run = sailed(one_line(60.0, R"(
[[obstacle]]
shape = "circle"
centre_m = [0.2, 20.0]
radius_m = 1.0
protection_m = 2.0
)"));
  INFO(run.story);
  CHECK(run.result.outcome == "goal");
  REQUIRE(run.result.cross_track);
  INFO("RMS " << run.result.cross_track->rms_m << ", worst " << run.result.cross_track->worst_m);
  CHECK(run.result.cross_track->worst_m > 1.0);
  CHECK(run.result.cross_track->worst_m < 4.0);
  // To sail straight to the goal from beside it would come to twice that.
  CHECK(run.result.cross_track->rms_m < 0.9);
}

TEST_CASE("legs: a dead end on a line is got out of", "[system]") {
  for (const double deep_m : {12.0, 35.0}) {
    const std::string mouth = std::to_string(50.0 - deep_m);
    const JudgedRun run = sailed(one_line(70.0,
                                          "\n[[obstacle]]\nshape = \"polyline\"\n"
                                          "points_m = [[-5.0, " +
                                              mouth + "], [-5.0, 50.0], [5.0, 50.0], [5.0, " +
                                              mouth + "]]\nprotection_m = 1.0\n"));
    INFO(deep_m << ": " << run.story);
    CHECK(run.result.outcome == "goal");
  }
}

TEST_CASE("legs: a rock on a waypoint is waited at, and the waypoint left out", "[system]") {
  std::string scenario = survey("line", "[0.0, 0.0]", R"(
[[obstacle]]
shape = "circle"
centre_m = [0.0, 40.0]
radius_m = 1.0
protection_m = 2.5
)");
  const std::string legs = "legs = ";
  scenario.insert(scenario.find(legs), "blocked = \"skip\"\nblocked_patience_s = 10.0\n");
  const JudgedRun run = sailed(scenario);
  INFO(run.story);
  CHECK(run.result.outcome == "goal");
  CHECK(std::any_of(run.result.notices.begin(), run.result.notices.end(), [](const auto& notice) {
    return notice.text.find("makes for the next waypoint") != std::string::npos;
  }));
}
