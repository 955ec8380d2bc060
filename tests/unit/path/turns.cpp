// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/turns.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "low_level/path/tangent_path.h"
#include "tests/support/catch.h"
#include "tests/unit/path/tangent_check.h"

namespace lodesman::testing {
namespace {

std::vector<Turn> turns_of(std::span<const PointPx> path, double radius, const Zones& zones) {
  std::vector<Turn> turns(100);
  turns.resize(find_turns(path, radius, zones, RegionPx::fan(), turns));
  return turns;
}

// Round a disc dead ahead, by a vehicle with this turning radius.
std::vector<Turn> turns_round(double disc_radius, double turning_radius) {
  const Zones zones{disc_px(433.0, 299.0, disc_radius)};
  TangentPath planner;
  const auto result = planner.find(zones, RegionPx::fan(), {433.0, 499.0}, {433.0, 99.0});
  return turns_of(result.path, turning_radius, zones);
}

TEST_CASE("turns: a fillet is where its formulas put it", "[low_level][path]") {
  // Up the view, then to the right: a quarter turn to starboard.
  const Fillet quarter = fillet_of({400.0, 400.0}, {400.0, 300.0}, {500.0, 300.0}, 10.0);
  REQUIRE(quarter.turn_rad == Approx(std::numbers::pi / 2.0));
  REQUIRE(quarter.begin_px == Approx(10.0));
  REQUIRE(quarter.swing_px == Approx(10.0));
  const Fillet slight = fillet_of({400.0, 400.0}, {400.0, 300.0}, {300.0, 200.0}, 20.0);
  REQUIRE(slight.turn_rad == Approx(-std::numbers::pi / 4.0));
  REQUIRE(slight.begin_px == Approx(20.0 * std::tan(std::numbers::pi / 8.0)));
  REQUIRE(slight.swing_px == Approx(20.0 * (1.0 - std::sqrt(0.5))));
}

TEST_CASE("turns: a corner in the open is rounded where its legs have room", "[low_level][path]") {
  const std::array<PointPx, 3> path{{{400.0, 300.0}, {400.0, 250.0}, {440.0, 250.0}}};
  const auto turns = turns_of(path, 39.9, {});
  REQUIRE(turns.size() == 1);
  REQUIRE(turns[0].possible);
  REQUIRE(turns[0].begin.row == Approx(289.9));
  REQUIRE(turns[0].end.column == Approx(439.9));
  const auto too_wide = turns_of(path, 40.1, {});
  REQUIRE_FALSE(too_wide[0].possible);
  REQUIRE(too_wide[0].begin.row == Approx(250.0));
  // The arc passes 8.3 px inside the corner.
  REQUIRE(turns_of(path, 20.0, {disc_px(405.0, 255.0, 1.0)})[0].possible);
  REQUIRE_FALSE(turns_of(path, 20.0, {disc_px(405.0, 255.0, 1.3)})[0].possible);
  REQUIRE(turns_of(std::span{path}.first(2), 10.0, {}).empty());
}

TEST_CASE("turns: round what is wider than the turning circle every arc is clear",
          "[low_level][path]") {
  const auto turns = turns_round(60.0, 45.0);
  REQUIRE(turns.size() > 5);
  double turned = 0.0;
  for (const Turn& turn : turns) {
    REQUIRE(turn.possible);
    REQUIRE(turn.first == turn.last);
    turned += turn.fillet.turn_rad;
    REQUIRE_FALSE(holds_point(disc_px(433.0, 299.0, 60.0), turn.begin));
    REQUIRE_FALSE(holds_point(disc_px(433.0, 299.0, 60.0), turn.end));
  }
  // To starboard past it is a turn to port.
  REQUIRE(turned == Approx(-2.0 * (std::asin(60.0 / 200.0))).margin(0.001));
}

TEST_CASE("turns: round what is smaller it is one turn, and not possible", "[low_level][path]") {
  const auto turns = turns_round(10.0, 45.0);
  REQUIRE(turns.size() == 1);
  REQUIRE_FALSE(turns[0].possible);
  REQUIRE(turns[0].last > turns[0].first);
  REQUIRE(turns[0].fillet.turn_rad == Approx(-2.0 * std::asin(10.0 / 200.0)).margin(0.001));
  REQUIRE(turns[0].fillet.swing_px == Approx(45.0 * (1.0 - std::cos(0.1))).margin(0.01));
}

TEST_CASE("turns: no more are written than there is room for", "[low_level][path]") {
  const std::array<PointPx, 4> zigzag{
      {{400.0, 400.0}, {410.0, 350.0}, {400.0, 300.0}, {410.0, 250.0}}};
  std::array<Turn, 1> room{};
  REQUIRE(find_turns(zigzag, 1.0, {}, RegionPx::fan(), room) == 1);
  REQUIRE(turns_of(zigzag, 1.0, {}).size() == 2);
}

}  // namespace
}  // namespace lodesman::testing
