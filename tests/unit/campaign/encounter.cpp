// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/campaign/encounter.h"

#include <cmath>
#include <set>

#include "hal_sim/scenario/scenario.h"
#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/catch.h"
#include "tests/support/shipped_vessel.h"

namespace lodesman {
namespace {

constexpr std::uint64_t kMany = 200;
constexpr double kRounding_m = 0.003;  // numbers are written in millimetres

Scenario sailed(std::uint64_t number) {
  static const SpeedTable speeds = testing::shipped_speeds();
  return read_scenario(TomlDocument::from_text(encounter_scenario(number), "encounter"), speeds);
}

bool moves(const MovingObstacle& obstacle) {
  return std::hypot(obstacle.velocity_x_m_s, obstacle.velocity_y_m_s) > 0.0;
}

}  // namespace

TEST_CASE("encounter: the same number gives the same text, another one another",
          "[hal_sim][campaign]") {
  std::set<std::string> texts;
  for (std::uint64_t number = 1; number <= kMany; ++number) {
    CHECK(encounter_scenario(number) == encounter_scenario(number));
    texts.insert(encounter_scenario(number));
  }
  CHECK(texts.size() == kMany);
}

TEST_CASE("encounter: every text is a scenario that can be read", "[hal_sim][campaign]") {
  std::set<double> speeds;
  std::set<std::size_t> counts;
  int resting = 0;
  int moving = 0;
  for (std::uint64_t number = 1; number <= kMany; ++number) {
    INFO("encounter " << number);
    const Scenario scenario = sailed(number);
    speeds.insert(scenario.surge_ref);
    counts.insert(scenario.obstacles.size());
    const double way_m = scenario.mission.goal().xy_m.norm();
    CHECK(way_m >= 18.0);
    CHECK(way_m <= 24.4);
    for (const MovingObstacle& obstacle : scenario.obstacles) {
      (moves(obstacle) ? moving : resting) += 1;
    }
  }
  CHECK(speeds.size() == 4);
  CHECK(*counts.begin() >= 1);
  CHECK(*counts.rbegin() == 8);
  CHECK(moving > resting / 2);
  CHECK(resting > moving / 2);
}

TEST_CASE("encounter: a number far beyond the others is one too", "[hal_sim][campaign]") {
  CHECK_NOTHROW(sailed(0));
  CHECK_NOTHROW(sailed(UINT64_MAX));
}

TEST_CASE("encounter: nothing lies at the start, and nothing rests at the goal",
          "[hal_sim][campaign]") {
  for (std::uint64_t number = 1; number <= kMany; ++number) {
    INFO("encounter " << number);
    const Scenario scenario = sailed(number);
    for (const MovingObstacle& obstacle : scenario.obstacles) {
      CHECK(edge_distance_m(obstacle.at_start, scenario.mission.start.p_WV) >= 4.0 - kRounding_m);
      if (!moves(obstacle)) {
        CHECK(edge_distance_m(obstacle.at_start, scenario.mission.goal()) >= 3.0 - kRounding_m);
      }
    }
  }
}

TEST_CASE("encounter: its name holds its number, and no other name does", "[hal_sim][campaign]") {
  CHECK(encounter_number("encounter:17") == 17);
  CHECK(encounter_number("encounter:18446744073709551615") == UINT64_MAX);
  for (const char* name : {"encounter:", "encounter:1x", "encounter:-1", "encounter: 1",
                           "encounter:18446744073709551616", "encounter17", "paper-static", ""}) {
    INFO(name);
    CHECK_FALSE(encounter_number(name));
  }
}

}  // namespace lodesman
