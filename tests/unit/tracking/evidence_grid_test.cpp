// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/evidence_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/catch.h"
#include "tests/unit/tracking/grid_watch.h"

namespace lodesman {
namespace {

using testing::box_between;
using testing::GridWatch;
using testing::kFanBeams;
using testing::occupied_places;
using testing::Place;
using testing::polygon_of;
using testing::stone_at;
using testing::strip_along;

}  // namespace

TEST_CASE("evidence: water is free after two looks, and unknown where none went",
          "[low_level][tracking]") {
  GridWatch watch;
  std::fill(watch.clear_m().begin(), watch.clear_m().end(), 12.0F);
  watch.clear_m()[90] = 0.0F;  // blind
  watch.see_beams();
  CHECK(watch.at(0.0, 6.0) == WaterState::kUnknown);
  CHECK(watch.grid().last_seen_s({0.0, 6.0}) == Approx(watch.look().at_s).margin(2e-3));
  watch.see_beams();
  CHECK(watch.at(0.0, 6.0) == WaterState::kFree);
  CHECK(watch.at(-8.0, 6.0) == WaterState::kFree);
  CHECK(watch.at(0.0, 11.5) == WaterState::kFree);
  CHECK(watch.at(0.0, 12.4) == WaterState::kUnknown);
  CHECK(watch.at(0.0, -3.0) == WaterState::kUnknown);
  CHECK(watch.at(6.0, 0.0) == WaterState::kUnknown);
  CHECK(std::isinf(watch.grid().last_seen_s({0.0, -3.0})));
  watch.clear_m().assign(kFanBeams, 0.0F);
  watch.clear_m()[60] = 30.0F;
  watch.see_beams(2);
  CHECK(watch.at(30.0 * std::sin(to_rad(10.0)), 25.0) == WaterState::kUnknown);
}

TEST_CASE(
    "evidence: in unknown water an obstacle counts at once, in free "
    "water at the third hit",
    "[low_level][tracking]") {
  GridWatch watch;
  watch.see(10.0, 5);
  watch.hit(stone_at(0.0, 11.0, 0.5));
  CHECK(watch.at(0.0, 11.0) == WaterState::kOccupied);
  CHECK(watch.at(0.3, 11.2) == WaterState::kOccupied);
  CHECK(watch.at(0.0, 11.9) == WaterState::kUnknown);
  for (int hits = 1; hits <= 3; ++hits) {
    watch.see(5.5);
    watch.hit(stone_at(0.0, 6.0, 0.5));
    watch.hit(stone_at(0.1, 6.0, 0.5));  // of the same ping: no second hit
    CHECK((watch.at(0.0, 6.0) == WaterState::kOccupied) == (hits == 3));
  }
  for (int i = 0; i < 10; ++i) {  // in beams that look through it
    watch.see(30.0);
    watch.hit(stone_at(0.0, 6.0, 0.5));
    CHECK(watch.at(0.0, 6.0) == WaterState::kOccupied);
  }
}

TEST_CASE("evidence: a flicker in free water is none, and one in a wall no hole",
          "[low_level][tracking]") {
  GridWatch watch;
  watch.see(30.0, 6);
  watch.see(9.0);
  watch.hit(stone_at(0.0, 10.0, 0.5));
  CHECK(watch.at(0.0, 10.0) != WaterState::kOccupied);
  watch.see(30.0, 2);
  CHECK(watch.at(0.0, 10.0) == WaterState::kFree);
  for (int i = 0; i < 4; ++i) {
    watch.see(9.5);
    watch.hit(stone_at(0.0, 10.0, 0.5));
  }
  watch.see(30.0, 2);
  CHECK(watch.at(0.0, 10.0) == WaterState::kOccupied);
}

TEST_CASE(
    "evidence: what goes is free after eight looks, what is not looked "
    "at stays",
    "[low_level][tracking]") {
  GridWatch watch;
  for (int i = 0; i < 50; ++i) {
    watch.see(9.5);
    watch.hit(stone_at(0.0, 10.0, 0.5));
    watch.hit(stone_at(0.0, -10.0, 0.5));
  }
  watch.see(30.0, 8);
  CHECK(watch.at(0.0, 10.0) == WaterState::kFree);
  CHECK(watch.grid().occupied_in_tile(0, 3) == 0);
  watch.see(30.0, 10000);
  CHECK(watch.at(0.0, -10.0) == WaterState::kOccupied);
  watch.grid().forget();
  CHECK(watch.at(0.0, -10.0) == WaterState::kUnknown);
}

TEST_CASE(
    "evidence: what the boat comes back to within the window is "
    "remembered, else unknown",
    "[low_level][tracking]") {
  for (const Place& way : {Place{0.0, 1.0}, Place{1.0, 0.0}, Place{-1.0, -1.0}}) {
    GridWatch watch;
    watch.see(9.5, 3);
    watch.hit(stone_at(0.0, 10.0, 0.5));
    for (const double far_m : {20.0, 100.0}) {
      for (double gone_m = 0.0; gone_m <= 2.0 * far_m; gone_m += 0.4) {
        const double m = far_m - std::abs(far_m - gone_m);
        watch.go_to(m * way.x(), m * way.y());
        watch.see(0.0);
      }
      const bool near = far_m < 50.0;
      CHECK(watch.at(0.0, 10.0) == (near ? WaterState::kOccupied : WaterState::kUnknown));
      CHECK(watch.at(0.0, 5.0) == (near ? WaterState::kFree : WaterState::kUnknown));
      CHECK(std::isfinite(watch.grid().last_seen_s({0.0, 5.0})) == near);
      CHECK(occupied_places(watch.grid()).empty() != near);
    }
    watch.hit(stone_at(0.0, 10.0, 0.5));
    watch.go_to(5000.0, 0.0);  // in one leap
    watch.see(30.0, 2);
    CHECK(watch.grid().occupied_in_tile(0, 3) == 0);
    CHECK(watch.at(5000.0, 10.0) == WaterState::kFree);
  }
}

TEST_CASE("evidence: no cell of the fan is missed", "[low_level][tracking]") {
  std::mt19937 random{3};
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>{low, high}(random);
  };
  for (int round = 0; round < 24; ++round) {
    const std::array<std::size_t, 4> counts{24, 60, 120, 512};
    const std::size_t beams = counts[static_cast<std::size_t>(round) % 4];
    GridWatch watch;
    watch.go_to(between(-500.0, 500.0), between(-500.0, 500.0), between(-180.0, 180.0));
    Look& look = watch.look();
    look.beam_step_rad = to_rad(120.0) / static_cast<double>(beams);
    look.first_bearing_rad = to_rad(-60.0) + 0.5 * look.beam_step_rad;
    look.farthest_m = round < 16 ? 30.0 : 38.0;
    watch.clear_m().resize(beams);
    look.clear_m = watch.clear_m();
    for (float& clear_m : watch.clear_m()) {
      clear_m = static_cast<float>(round % 8 < 4 ? look.farthest_m : between(1.0, 30.0));
    }
    watch.see_beams(2);
    int missed = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto beam = static_cast<std::size_t>(random() % beams);
      const double off = between(-0.5, 0.5);
      const double bearing_rad =
          look.first_bearing_rad + (static_cast<double>(beam) + off) * look.beam_step_rad;
      const double range_m = std::sqrt(between(1.0, 1444.0));
      // The fan ends within the cells of its sides, and a beam shorter than its
      // neighbours within those of its own.
      const double side_rad = round % 8 < 4 ? to_rad(60.0) - std::abs(bearing_rad)
                                            : (0.5 - std::abs(off)) * look.beam_step_rad;
      if (range_m > static_cast<double>(watch.clear_m()[beam]) - 0.5 || range_m * side_rad < 0.2) {
        continue;
      }
      const VehiclePoint at{{range_m * std::sin(bearing_rad), range_m * std::cos(bearing_rad)}};
      missed += watch.grid().state(look.pose.to_world(at).xy_m) == WaterState::kFree ? 0 : 1;
    }
    CAPTURE(beams, round);
    CHECK(missed == 0);
  }
}

TEST_CASE("evidence: what moved away is cleared with the cells beside it",
          "[low_level][tracking]") {
  GridWatch watch;
  watch.hit(stone_at(3.0, 3.0, 1.0));
  watch.hit(stone_at(6.0, 3.0, 0.5));
  watch.grid().clear(stone_at(3.0, 3.0, 1.0));
  CHECK(watch.at(3.0, 3.0) == WaterState::kFree);
  CHECK(watch.at(3.0, 4.1) == WaterState::kFree);
  CHECK(watch.at(3.0, 4.8) == WaterState::kUnknown);
  CHECK(watch.at(6.0, 3.0) == WaterState::kOccupied);
  CHECK(watch.grid().occupied_in_tile(0, 1) == 0);
}

TEST_CASE("evidence: shapes take their cells, thin ones without holes", "[low_level][tracking]") {
  GridWatch watch;
  watch.hit(box_between(2.0, 2.0, 4.0, 3.0));
  // The vertices on its north and east sides are in cells of their own.
  CHECK(occupied_places(watch.grid()).size() == 8 * 4 + 3);
  for (const double turn_deg : {0.0, 17.0, 45.0, 80.0, 90.0, 133.0}) {
    const Place along = first_axis(to_rad(turn_deg));
    Obstacle line = strip_along(-9.0 * along, 9.0 * along, 0.0);
    line.shape = ObstacleShape::kPolyline;
    line.vertex_count = 2;
    Obstacle reed = stone_at(0.0, 0.0, 9.0);
    reed.semi_axis_second_m = 0.001;
    reed.angle_rad = to_rad(turn_deg);
    for (const Obstacle& thin : {strip_along(-9.0 * along, 9.0 * along, 0.06), line, reed}) {
      watch.grid().forget();
      watch.hit(thin);
      const std::vector<Place> cells = occupied_places(watch.grid());
      CHECK(cells.size() < 220);
      for (double m = -8.8; m < 8.8; m += 0.1) {
        CHECK(std::any_of(cells.begin(), cells.end(),
                          [&](const Place& p) { return (p - m * along).norm() < 0.27; }));
      }
    }
  }
}

TEST_CASE("evidence: the shares under a shape are one together", "[low_level][tracking]") {
  GridWatch watch;
  watch.see(10.0, 2);
  watch.hit(box_between(-2.0, 11.0, 2.0, 12.0));
  std::mt19937 random{9};
  std::uniform_real_distribution<double> place{-45.0, 45.0};
  for (int i = 0; i < 200; ++i) {
    const auto shares = watch.grid().shares_under(stone_at(place(random), place(random), 3.0));
    CHECK(shares.occupied + shares.free + shares.unknown == Approx(1.0));
  }
  CHECK(watch.grid().shares_under(box_between(-1.9, 11.1, 1.9, 11.9)).occupied == Approx(1.0));
  CHECK(watch.grid().shares_under(stone_at(0.0, 6.0, 1.0)).free == Approx(1.0));
  CHECK(watch.grid().shares_under(stone_at(900.0, 6.0, 1.0)).unknown == Approx(1.0));
  CHECK(watch.grid().shares_under(box_between(-2.0, 10.1, 2.0, 11.9)).occupied ==
        Approx(0.5).margin(0.1));
}

TEST_CASE("evidence: shapes and looks that are none do no harm", "[low_level][tracking]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  GridWatch watch;
  watch.see(30.0, 3);
  for (const double wrong : {kNan, 1e9, -1e9, std::numeric_limits<double>::infinity()}) {
    for (const Obstacle& shape : {polygon_of({{0.0, 5.0}, {wrong, 5.0}, {1.0, 6.0}}),
                                  polygon_of({{0.0, 5.0}, {0.0, wrong}}), stone_at(wrong, 5.0, 1.0),
                                  stone_at(0.0, 5.0, wrong), box_between(-1.0, wrong, 1.0, 6.0)}) {
      watch.hit(shape);
      watch.grid().clear(shape);
      CHECK(watch.grid().shares_under(shape).unknown == Approx(1.0));
    }
    CHECK(watch.grid().state({wrong, 0.0}) == WaterState::kUnknown);
    std::array<Look, 6> looks;
    looks.fill(watch.look());
    looks[0].pose.p_WV.xy_m.x() = wrong;
    looks[1].beam_step_rad = wrong;
    looks[2].first_bearing_rad = wrong;
    looks[3].nearest_m = wrong;
    looks[4].farthest_m = wrong;
    looks[5].at_s = wrong;
    watch.clear_m()[60] = static_cast<float>(wrong);
    std::for_each(looks.begin(), looks.end(), [&](const Look& look) { watch.grid().look(look); });
  }
  Obstacle many = polygon_of({{0.0, 5.0}, {1.0, 5.0}, {1.0, 6.0}});
  many.vertex_count = 4000000000U;
  watch.hit(many);
  CHECK(occupied_places(watch.grid()).empty());
  CHECK(watch.at(0.0, 5.5) == WaterState::kFree);
  // As wide as the world: all of the window, and no more work than that.
  watch.hit(stone_at(0.0, 0.0, 1e6));
  CHECK(watch.at(-39.0, -39.0) == WaterState::kOccupied);
}

}  // namespace lodesman
