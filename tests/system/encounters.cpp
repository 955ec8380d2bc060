// SPDX-License-Identifier: Apache-2.0
// Random encounters in the default profile: the goal is reached, and nothing is hit that somebody
// who knows everything could have kept clear of. And that somebody's own tests.
#include <algorithm>
#include <array>

#include "deploy/boat/named_scenario.h"
#include "tests/support/catch.h"
#include "tests/system/escape.h"
#include "tests/system/judged_run.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

constexpr int kGroupSize = 50;

// Run down from outside the fan by what is faster than they are: the reference finds no escape from
// the first sight on (escape.h says what it tries); 231 is overtaken by what it never saw. Every
// other one reaches its goal. A number goes from this list when it is sailed well, and none comes
// in without a look at why.
constexpr std::array kNoEscape{4, 16, 69, 100, 106, 110, 126, 162, 230, 231, 277};

void sail_group(int group) {
  Outcomes outcomes;
  for (int i = 1; i <= kGroupSize; ++i) {
    const int number = group * kGroupSize + i;
    const bool hit = std::find(kNoEscape.begin(), kNoEscape.end(), number) != kNoEscape.end();
    const JudgedRun run = judged_run("encounter:" + std::to_string(number));
    INFO(run.story);
    CHECK(run.collision.has_value() == hit);
    CHECK((run.collision || run.result.outcome == "goal"));
    CHECK_FALSE((run.collision && run.collision->avoidable));
    outcomes.add(run);
  }
  WARN(outcomes.table());
}

[[nodiscard]] MovingObstacle circle(double x_m, double y_m, double radius_m) {
  MovingObstacle obstacle;
  obstacle.at_start.id = 1;
  obstacle.at_start.centre_x_m = x_m;
  obstacle.at_start.centre_y_m = y_m;
  obstacle.at_start.semi_axis_first_m = obstacle.at_start.semi_axis_second_m = radius_m;
  return obstacle;
}

// Whether somebody at the origin, bound north at that speed, has an escape for 20 s.
[[nodiscard]] bool escapes(const MovingObstacle& obstacle, double surge_m_s) {
  const std::array obstacles{obstacle};
  VesselState state;
  state.surge_m_s = surge_m_s;
  return find_escape({load_hull("paper-asv"), {}, obstacles}, state, 0.0, 20.0).has_value();
}

}  // namespace

TEST_CASE("reference: what rests far enough ahead can be avoided, what is at the bow cannot",
          "[system]") {
  CHECK(escapes(circle(0.0, 6.0, 0.5), 1.12));
  CHECK_FALSE(escapes(circle(0.0, 2.12, 1.0), 1.12));  // 0.1 m before the bow
}

TEST_CASE("reference: obstacles are where and when they truly are", "[system]") {
  // A bar 20 m wide, broadside on: it rests, comes faster than the vessel flies, or vanishes first.
  MovingObstacle bar = circle(0.0, 10.0, 0.5);
  bar.at_start.semi_axis_second_m = 10.0;
  CHECK(escapes(bar, 0.42));
  bar.velocity_y_m_s = -2.5;
  CHECK_FALSE(escapes(bar, 0.42));
  bar.vanishes_at_s = 3.0;
  CHECK(escapes(bar, 0.42));
}

TEST_CASE("reference: what is nearest is told by its number", "[system]") {
  std::array obstacles{circle(0.0, 9.0, 0.5), circle(0.0, 4.0, 0.5)};
  obstacles[1].at_start.id = 2;
  obstacles[0].velocity_y_m_s = -1.0;
  const Waters waters{load_hull("paper-asv"), {}, obstacles};
  CHECK(nearest_obstacle(waters, {}, 0.0).obstacle == 2);
  CHECK(nearest_obstacle(waters, {}, 6.0).obstacle == 1);
  CHECK(nearest_obstacle(waters, {}, 0.0).clearance_m == Approx(4.0 - 0.5 - 1.02));
}

TEST_CASE("encounters: first group", "[system]") { sail_group(0); }
TEST_CASE("encounters: second group", "[system]") { sail_group(1); }
TEST_CASE("encounters: third group", "[system]") { sail_group(2); }
TEST_CASE("encounters: fourth group", "[system]") { sail_group(3); }
TEST_CASE("encounters: fifth group", "[system]") { sail_group(4); }
TEST_CASE("encounters: sixth group", "[system]") { sail_group(5); }
