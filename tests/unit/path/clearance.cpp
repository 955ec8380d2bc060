// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/clearance.h"

#include <cmath>
#include <random>

#include "mid_level/geometry/sonar_view.h"
#include "tests/support/catch.h"
#include "tests/unit/path/tangent_check.h"

namespace lodesman::testing {
namespace {

ZonePx grown(ZonePx zone) {
  if (auto* ellipse = std::get_if<EllipsePx>(&zone)) {
    ellipse->a += 2.0;
    ellipse->b += 2.0;
  } else {
    std::get<WallPx>(zone).radius += 2.0;
  }
  return zone;
}

TEST_CASE("clearance: edges belong to a zone", "[low_level][path]") {
  const ZonePx ellipse = EllipsePx::with_angle({10.0, 20.0}, 4.0, 2.0, 0.0);
  REQUIRE(touches(ellipse, {14.0, 20.0}));
  REQUIRE_FALSE(touches(ellipse, {14.0 + 1e-9, 20.0}));
  REQUIRE(touches(ellipse, {0.0, 22.0}, {20.0, 22.0}));
  REQUIRE_FALSE(touches(ellipse, {0.0, 22.0 + 1e-9}, {20.0, 22.0 + 1e-9}));
  REQUIRE_FALSE(touches(ellipse, {0.0, 20.0}, {5.9, 20.0}));
  REQUIRE_FALSE(touches(ellipse, {14.1, 20.0}, {30.0, 20.0}));

  const ZonePx wall = wall_px({{0.0, 0.0}, {10.0, 0.0}}, 2.0);
  REQUIRE(touches(wall, {5.0, 2.0}));
  REQUIRE(touches(wall, {12.0, -5.0}, {12.0, 5.0}));
  REQUIRE_FALSE(touches(wall, {12.0 + 1e-9, -5.0}, {12.0 + 1e-9, 5.0}));
  REQUIRE(touches(wall, {5.0, -5.0}, {5.0, 5.0}));
  REQUIRE_FALSE(touches(wall, {-5.0, 3.0}, {15.0, 2.1}));
  REQUIRE(touches(ZonePx{wall_px({{0.0, 0.0}}, 2.0)}, {-3.0, 2.0}, {3.0, 2.0}));
}

TEST_CASE("clearance: a closed wall encloses whatever it winds round", "[low_level][path]") {
  const std::initializer_list<PointPx> square{{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}, {0.0, 20.0}};
  REQUIRE(touches(ZonePx{wall_px(square, 1.0, true)}, {10.0, 10.0}));
  REQUIRE(touches(ZonePx{wall_px(square, 1.0, true)}, {10.0, 10.0}, {11.0, 10.0}));
  REQUIRE_FALSE(touches(ZonePx{wall_px(square, 1.0, false)}, {10.0, 10.0}));
  REQUIRE_FALSE(touches(ZonePx{wall_px(square, 1.0, true)}, {21.5, 10.0}));
  REQUIRE_FALSE(touches(ZonePx{wall_px(square, 1.0, true)}, {-1.5, 10.0}));
  const ZonePx bow = wall_px({{0.0, 0.0}, {20.0, 20.0}, {20.0, 0.0}, {0.0, 20.0}}, 0.5, true);
  REQUIRE(touches(bow, {2.0, 10.0}));
  REQUIRE(touches(bow, {18.0, 10.0}));
  REQUIRE_FALSE(touches(bow, {10.0, 4.0}));
}

TEST_CASE("clearance: at whole pixels it is the zones' own test", "[low_level][path]") {
  std::mt19937 random{11};
  std::uniform_real_distribution<double> place{0.0, 60.0};
  for (int i = 0; i < 60; ++i) {
    const EllipsePx ellipse = EllipsePx::with_angle({place(random), place(random)},
                                                    0.5 + place(random) / 3.0, 0.5, place(random));
    WallPx wall;
    wall.vertex_count = 5;
    wall.radius = 0.5 + place(random) / 20.0;
    wall.closed = i % 2 == 0;
    for (std::uint32_t k = 0; k < wall.vertex_count; ++k) {
      wall.vertices[k] = {place(random), place(random)};
    }
    bool same = true;
    for (int row = 0; row < 60; ++row) {
      for (int column = 0; column < 60; ++column) {
        const PointPx at{static_cast<double>(column), static_cast<double>(row)};
        same = same && touches(ZonePx{ellipse}, at) == ellipse.contains(column, row);
        same = same && touches(ZonePx{wall}, at) == wall.contains(column, row);
      }
    }
    REQUIRE(same);
  }
}

TEST_CASE("clearance: a segment touches what one of its points touches", "[low_level][path]") {
  std::mt19937 random{12};
  std::uniform_real_distribution<double> place{0.0, 60.0};
  int touched = 0;
  for (int i = 0; i < 3000; ++i) {
    const PointPx from{place(random), place(random)};
    const PointPx to{place(random), place(random)};
    const ZonePx zone =
        i % 2 == 0
            ? ZonePx{EllipsePx::with_angle({place(random), place(random)}, place(random) / 2.0,
                                           place(random) / 20.0, place(random))}
            : ZonePx{wall_px({{place(random), place(random)}, {place(random), place(random)}},
                             place(random) / 20.0)};
    bool deep = false;  // sampled, so what is hardly touched may be missed
    for (int k = 0; k <= 200; ++k) {
      const double t = k / 200.0;
      deep = deep || holds_point(zone, {from.column + t * (to.column - from.column),
                                        from.row + t * (to.row - from.row)});
    }
    CAPTURE(i);
    const bool touching = touches(zone, from, to);
    REQUIRE((touching || !deep));
    touched += touching ? 1 : 0;
    bool near = false;
    const ZonePx larger = grown(zone);
    for (int k = 0; touching && k <= 2000 && !near; ++k) {
      const double t = k / 2000.0;
      near = holds_point(larger, {from.column + t * (to.column - from.column),
                                  from.row + t * (to.row - from.row)});
    }
    REQUIRE(near == touching);
  }
  REQUIRE(touched > 500);
}

TEST_CASE("clearance: the fan is that of the pixels, and a rectangle is one", "[low_level][path]") {
  const RegionPx fan = RegionPx::fan();
  for (int row = 0; row < kViewRows; ++row) {
    bool same = true;
    for (int column = 0; column < kViewColumns; ++column) {
      same = same && fan.contains({static_cast<double>(column), static_cast<double>(row)}) ==
                         in_fan(column, row);
    }
    CAPTURE(row);
    REQUIRE(same);
  }
  REQUIRE_FALSE(fan.contains({433.0, 499.5}));
  const RegionPx box = RegionPx::rectangle({-3.0, -2.0}, {5.0, 7.0});
  REQUIRE(box.contains({-3.0, -2.0}));
  REQUIRE(box.contains({5.0, 7.0}));
  REQUIRE_FALSE(box.contains({5.1, 0.0}));
  REQUIRE_FALSE(box.contains({0.0, -2.1}));
}

}  // namespace
}  // namespace lodesman::testing
