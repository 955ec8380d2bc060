// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/grid.h"

#include <iostream>
#include <limits>
#include <random>

#include "tests/support/catch.h"
#include "tests/unit/path/reference_search.h"

namespace lodesman::testing {
namespace {

// The grid must hold just the fan's pixels that the shape does not contain.
template <class Shape>
void require_exact(PassableGrid& grid, const Shape& shape) {
  grid.clear();
  grid.block(shape);
  int wrong = 0;
  std::uint32_t free = 0;
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      const bool expected = in_fan(column, row) && !shape.contains(column, row);
      free += expected ? 1U : 0U;
      wrong += grid.passable(column, row) == expected ? 0 : 1;
      wrong += grid.columns().is_free(column, row) == expected ? 0 : 1;
    }
  }
  REQUIRE(wrong == 0);
  REQUIRE(grid.free_pixels() == free);
}

class Shapes {
 public:
  explicit Shapes(unsigned seed) : random_{seed} { std::cout << "seed " << seed << '\n'; }

  double number(double low, double high) {
    return std::uniform_real_distribution<double>{low, high}(random_);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>{low, high}(random_); }
  // On the pixels' centres every other time, where rounding meets boundaries.
  PointPx point() {
    const PointPx p{number(-60.0, 930.0), number(-60.0, 560.0)};
    return whole(0, 1) == 0 ? p : PointPx{std::round(p.column), std::round(p.row)};
  }
  double size() {
    const double s = std::pow(10.0, number(-1.0, 2.3));
    return whole(0, 1) == 0 ? s : std::round(s) + 1.0;
  }

 private:
  std::mt19937 random_;
};

TEST_CASE("grid: an ellipse blocks the pixels that the formula says", "[low_level][path]") {
  Shapes shapes{31};
  PassableGrid grid;
  for (int i = 0; i < 150; ++i) {
    const double theta = shapes.whole(0, 3) == 0 ? 0.0 : shapes.number(-3.2, 3.2);
    const EllipsePx e = EllipsePx::with_angle(shapes.point(), shapes.size(), shapes.size(), theta);
    CAPTURE(i, e.centre.column, e.centre.row, e.a, e.b, theta);
    require_exact(grid, e);
  }
}

TEST_CASE("grid: a circle through pixel centres blocks those on it", "[low_level][path]") {
  PassableGrid grid;
  for (const double radius : {5.0, 13.0, 25.0, 40.0, 65.0, 85.0}) {
    CAPTURE(radius);
    require_exact(grid, EllipsePx{{433.0, 300.0}, radius, radius});
    require_exact(grid, CapsulePx{{433.0, 300.0}, {433.0, 300.0}, radius});
    require_exact(grid, CapsulePx{{433.0, 300.0}, {533.0, 300.0}, radius});
    require_exact(grid, CapsulePx{{433.0, 300.0}, {433.0, 200.0}, radius});
  }
}

TEST_CASE("grid: needles and shapes beyond all measure are drawn as their formula says",
          "[low_level][path]") {
  PassableGrid grid;
  require_exact(grid, EllipsePx::with_angle({433.0, 300.0}, 400.0, 0.01, 0.7));
  require_exact(grid, EllipsePx::with_angle({433.0, 300.0}, 300.0, 0.3, 1.5707));
  require_exact(grid, EllipsePx::with_angle({433.0, 300.0}, 1e200, 1e200, 0.7));
  require_exact(grid, EllipsePx::with_angle({433.0, 300.0}, 1e-200, 1e-200, 0.7));
  require_exact(grid, EllipsePx::with_angle({1e12, -1e12}, 2e12, 1.0, -0.7854));
  require_exact(grid, CapsulePx{{-1e9, 250.0}, {1e9, 251.0}, 3.0});
  require_exact(grid, CapsulePx{{433.0, 250.0}, {433.0, 251.0}, 1e200});
}

TEST_CASE("grid: a capsule blocks every pixel within its radius", "[low_level][path]") {
  Shapes shapes{32};
  PassableGrid grid;
  for (int i = 0; i < 150; ++i) {
    CapsulePx c{shapes.point(), shapes.point(), shapes.size()};
    if (shapes.whole(0, 4) == 0) {
      c.to.row = c.from.row;
    }
    CAPTURE(i, c.from.column, c.from.row, c.to.column, c.to.row, c.radius);
    require_exact(grid, c);
  }
}

TEST_CASE("grid: a wall blocks its capsules and, closed, what it goes round", "[low_level][path]") {
  Shapes shapes{33};
  PassableGrid grid;
  for (int i = 0; i < 40; ++i) {
    WallPx wall;
    wall.vertex_count = static_cast<std::uint32_t>(shapes.whole(1, 12));
    wall.radius = shapes.number(0.5, 20.0);
    wall.closed = i % 3 != 0;
    for (std::uint32_t v = 0; v < wall.vertex_count; ++v) {
      wall.vertices[v] = shapes.point();
    }
    CAPTURE(i, wall.vertex_count, wall.closed);
    require_exact(grid, wall);
  }
}

TEST_CASE("grid: what a wall goes round twice or in a crossing loop is blocked",
          "[low_level][path]") {
  PassableGrid grid;
  WallPx star;  // a pentagram: its middle is wound round twice
  star.vertex_count = 5;
  star.radius = 1.0;
  star.closed = true;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const double angle = 4.0 * M_PI / 5.0 * i;
    star.vertices[i] = {433.0 + 80.0 * std::sin(angle), 250.0 - 80.0 * std::cos(angle)};
  }
  grid.block(star);
  REQUIRE_FALSE(grid.passable(433, 250));
  REQUIRE_FALSE(grid.passable(433, 200));
  REQUIRE(grid.passable(433, 325));
}

TEST_CASE("grid: cleared it is the fan again, blocked it is empty", "[low_level][path]") {
  PassableGrid grid;
  std::uint32_t fan = 0;
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      REQUIRE(grid.passable(column, row) == in_fan(column, row));
      fan += in_fan(column, row) ? 1U : 0U;
    }
  }
  REQUIRE(grid.free_pixels() == fan);
  grid.block_all();
  REQUIRE(grid.free_pixels() == 0);
  grid.clear();
  REQUIRE(grid.free_pixels() == fan);
  // More shapes than are remembered one by one.
  for (int i = 0; i < 300; ++i) {
    grid.block(EllipsePx{{100.0 + 2.5 * i, 50.0 + 1.5 * i}, 20.0, 10.0});
  }
  REQUIRE(grid.free_pixels() < fan);
  grid.clear();
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      REQUIRE(grid.passable(column, row) == in_fan(column, row));
      REQUIRE(grid.columns().is_free(column, row) == in_fan(column, row));
    }
  }
  grid.block(pixel(-5, 700));
  grid.block(pixel(0, 499));
  REQUIRE(grid.free_pixels() == fan);
  REQUIRE_FALSE(grid.passable(-1, 250));
  REQUIRE_FALSE(grid.passable(866, 250));
  REQUIRE_FALSE(grid.passable(433, -1));
  REQUIRE_FALSE(grid.passable(433, 500));
}

TEST_CASE("grid: around() gives the nine pixels round each pixel", "[low_level][path]") {
  PassableGrid grid;
  grid.block(EllipsePx{{433.0, 250.0}, 100.0, 60.0});
  int wrong = 0;
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      std::uint32_t expected = 0;
      for (int i = 0; i < 9; ++i) {
        expected |= (grid.passable(column + i % 3 - 1, row + i / 3 - 1) ? 1U : 0U) << i;
      }
      wrong += grid.around(column, row) == expected ? 0 : 1;
    }
  }
  REQUIRE(wrong == 0);
}

}  // namespace
}  // namespace lodesman::testing
