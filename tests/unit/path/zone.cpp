// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/zone.h"

#include <cmath>
#include <limits>

#include "low_level/path/grid.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

const SonarView kView{30.0};  // 6 cm a pixel

Obstacle ellipse(double x_m, double y_m, double first_m, double second_m, double angle_rad) {
  Obstacle o;
  o.centre_x_m = x_m;
  o.centre_y_m = y_m;
  o.semi_axis_first_m = 0.1;
  o.semi_axis_second_m = 0.1;
  o.angle_rad = angle_rad;
  o.protection_first_m = first_m;
  o.protection_second_m = second_m;
  return o;
}

Obstacle wall(ObstacleShape shape, double protection_m, std::initializer_list<Vertex> vertices) {
  Obstacle o;
  o.shape = shape;
  o.protection_first_m = protection_m;
  for (const Vertex& v : vertices) {
    o.vertices[o.vertex_count++] = v;
  }
  return o;
}

PassableGrid drawn(const Obstacle& obstacle) {
  PassableGrid grid;
  const auto zone = zone_of(obstacle, kView);
  REQUIRE(zone.has_value());
  grid.block(*zone);
  return grid;
}

// In metres of the vehicle frame, at the nearest pixel.
bool blocked(const PassableGrid& grid, double x_m, double y_m) {
  const auto column = static_cast<int>(std::lround(kView.column_of(x_m)));
  const auto row = static_cast<int>(std::lround(kView.row_of(y_m)));
  REQUIRE(in_fan(column, row));
  return !grid.passable(column, row);
}

TEST_CASE("zone: an angle of zero lays the first axis straight ahead", "[low_level][path]") {
  const PassableGrid grid = drawn(ellipse(0.0, 15.0, 6.0, 1.0, 0.0));
  REQUIRE(blocked(grid, 0.0, 20.5));
  REQUIRE(blocked(grid, 0.0, 9.5));
  REQUIRE_FALSE(blocked(grid, 1.5, 15.0));
  REQUIRE_FALSE(blocked(grid, 0.0, 21.5));
}

TEST_CASE("zone: a positive angle turns the first axis to starboard", "[low_level][path]") {
  const PassableGrid grid = drawn(ellipse(1.0, 15.0, 6.0, 1.0, M_PI / 6.0));
  const double x_m = 5.0 * std::sin(M_PI / 6.0);
  const double y_m = 5.0 * std::cos(M_PI / 6.0);
  REQUIRE(blocked(grid, 1.0 + x_m, 15.0 + y_m));
  REQUIRE(blocked(grid, 1.0 - x_m, 15.0 - y_m));
  REQUIRE_FALSE(blocked(grid, 1.0 - x_m, 15.0 + y_m));
  REQUIRE_FALSE(blocked(grid, 1.0 + x_m, 15.0 - y_m));
}

TEST_CASE("zone: an obstacle to starboard lies at higher columns, one ahead at lower rows",
          "[low_level][path]") {
  const auto zone = zone_of(ellipse(3.0, 12.0, 2.0, 1.0, 0.5), kView);
  const auto& shape = std::get<EllipsePx>(*zone);
  REQUIRE(shape.centre.column == Approx(433.0 + 50.0));
  REQUIRE(shape.centre.row == Approx(499.0 - 200.0));
  REQUIRE(shape.a == Approx(2.0 / 0.06));
  REQUIRE(shape.b == Approx(1.0 / 0.06));
  REQUIRE(std::atan2(shape.sin_theta, shape.cos_theta) == Approx(0.5 - M_PI / 2.0));
}

TEST_CASE("zone: a pixel is blocked where its centre lies in the ellipse in metres",
          "[low_level][path]") {
  const Obstacle o = ellipse(-2.0, 14.0, 5.0, 1.7, -1.1);
  const PassableGrid grid = drawn(o);
  int wrong = 0;
  for (std::int16_t row = 0; row < kViewRows; ++row) {
    for (std::int16_t column = 0; column < kViewColumns; ++column) {
      const VehiclePoint p = kView.to_vehicle({column, row});
      const double dx = p.xy_m.x() - o.centre_x_m;
      const double dy = p.xy_m.y() - o.centre_y_m;
      const double along = dx * std::sin(o.angle_rad) + dy * std::cos(o.angle_rad);
      const double across = dx * std::cos(o.angle_rad) - dy * std::sin(o.angle_rad);
      const double level = std::hypot(along / 5.0, across / 1.7);
      if (in_fan(column, row) && std::abs(level - 1.0) > 1e-9) {
        wrong += grid.passable(column, row) == (level > 1.0) ? 0 : 1;
      }
    }
  }
  REQUIRE(wrong == 0);
}

TEST_CASE("zone: a circle is drawn alike whatever its angle", "[low_level][path]") {
  const PassableGrid plain = drawn(ellipse(0.0, 15.0, 2.4, 2.4, 0.0));
  const PassableGrid turned = drawn(ellipse(0.0, 15.0, 2.4, 2.4, 0.77));
  int different = 0;
  for (int row = 0; row < kViewRows; ++row) {
    for (int dx = 0; dx < 433; ++dx) {
      const bool right = plain.passable(433 + dx, row);
      different += right != turned.passable(433 + dx, row) ? 1 : 0;
      different += right != plain.passable(433 - dx, row) ? 1 : 0;
    }
  }
  REQUIRE(different == 0);
}

TEST_CASE("zone: a polyline blocks what is near the line and leaves its bay open",
          "[low_level][path]") {
  const PassableGrid grid = drawn(
      wall(ObstacleShape::kPolyline, 0.6, {{-4.0, 10.0}, {-4.0, 18.0}, {4.0, 18.0}, {4.0, 10.0}}));
  REQUIRE(blocked(grid, -4.0, 14.0));
  REQUIRE(blocked(grid, -3.5, 14.0));
  REQUIRE_FALSE(blocked(grid, -3.3, 14.0));
  REQUIRE(blocked(grid, 0.0, 18.5));
  REQUIRE(blocked(grid, 4.0, 9.5));
  REQUIRE_FALSE(blocked(grid, 4.0, 9.2));
  REQUIRE_FALSE(blocked(grid, 0.0, 14.0));
  REQUIRE_FALSE(blocked(grid, 0.0, 10.0));
}

TEST_CASE("zone: a polygon blocks its sides, also the closing one, and what it encloses",
          "[low_level][path]") {
  const PassableGrid grid = drawn(
      wall(ObstacleShape::kPolygon, 0.6, {{-4.0, 10.0}, {-4.0, 18.0}, {4.0, 18.0}, {4.0, 10.0}}));
  REQUIRE(blocked(grid, 0.0, 14.0));
  REQUIRE(blocked(grid, 0.0, 9.5));
  REQUIRE_FALSE(blocked(grid, 0.0, 9.2));
  REQUIRE_FALSE(blocked(grid, 5.0, 14.0));
}

TEST_CASE("zone: a wall of one vertex is a disc, and the thinnest wall lets nothing through",
          "[low_level][path]") {
  const PassableGrid disc = drawn(wall(ObstacleShape::kPolygon, 1.0, {{1.0, 12.0}}));
  REQUIRE(blocked(disc, 1.9, 12.0));
  REQUIRE_FALSE(blocked(disc, 2.2, 12.0));

  const auto zone = zone_of(
      wall(ObstacleShape::kPolyline, 0.0, {{-25.0, 3.0}, {0.01, 11.0}, {25.0, 21.3}}), kView);
  PassableGrid grid;
  grid.block(*zone);
  // No free pixel below the wall has a free neighbour above it.
  int leaks = 0;
  for (int row = 1; row < kViewRows; ++row) {
    for (int column = 1; column < kViewColumns; ++column) {
      const auto beyond = [](int c, int r) {
        const VehiclePoint p =
            kView.to_vehicle({static_cast<std::int16_t>(c), static_cast<std::int16_t>(r)});
        const double x = p.xy_m.x();
        return p.xy_m.y() >
               (x < 0.01 ? 11.0 + (x - 0.01) * 8.0 / 25.01 : 11.0 + (x - 0.01) * 10.3 / 24.99);
      };
      if (grid.passable(column, row)) {
        const bool here = beyond(column, row);
        leaks += grid.passable(column - 1, row) && beyond(column - 1, row) != here ? 1 : 0;
        leaks += grid.passable(column, row - 1) && beyond(column, row - 1) != here ? 1 : 0;
      }
    }
  }
  REQUIRE(leaks == 0);
}

TEST_CASE("zone: an obstacle that cannot be drawn gives no zone", "[low_level][path]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  REQUIRE_FALSE(zone_of(ellipse(nan, 1.0, 1.0, 1.0, 0.0), kView));
  REQUIRE_FALSE(zone_of(ellipse(0.0, infinity, 1.0, 1.0, 0.0), kView));
  REQUIRE_FALSE(zone_of(ellipse(0.0, 1.0, nan, 1.0, 0.0), kView));
  REQUIRE_FALSE(zone_of(ellipse(0.0, 1.0, 1.0, 0.0, 0.0), kView));
  REQUIRE_FALSE(zone_of(ellipse(0.0, 1.0, 2.0, 1.0, nan), kView));
  REQUIRE_FALSE(zone_of(wall(ObstacleShape::kPolyline, 1.0, {}), kView));
  REQUIRE_FALSE(zone_of(wall(ObstacleShape::kPolygon, nan, {{0.0, 1.0}, {1.0, 1.0}}), kView));
  REQUIRE_FALSE(zone_of(wall(ObstacleShape::kPolyline, 1.0, {{nan, 1.0}, {1.0, 1.0}}), kView));
  Obstacle unknown = ellipse(0.0, 1.0, 1.0, 1.0, 0.0);
  unknown.shape = static_cast<ObstacleShape>(9);
  REQUIRE_FALSE(zone_of(unknown, kView));
}

}  // namespace
}  // namespace lodesman::testing
