// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/mounting.h"

#include <bit>
#include <memory>
#include <numbers>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

// An ellipse ahead of the head, and a wall to its starboard.
[[nodiscard]] std::unique_ptr<SonarObstacles> seen() {
  auto obstacles = std::make_unique<SonarObstacles>();
  obstacles->count = 2;
  Obstacle& ellipse = obstacles->obstacles[0];
  ellipse.centre_x_m = 0.125;
  ellipse.centre_y_m = 10.0;
  ellipse.semi_axis_first_m = 2.0;
  ellipse.semi_axis_second_m = 1.0;
  ellipse.angle_rad = 3.0;
  Obstacle& wall = obstacles->obstacles[1];
  wall.shape = ObstacleShape::kPolyline;
  wall.vertex_count = 2;
  wall.vertices[0] = {5.0, 0.0};
  wall.vertices[1] = {5.0, 8.0};
  return obstacles;
}

TEST_CASE("mounting: what the head sees ahead of it lies where it looks", "[low_level][sonar]") {
  const auto obstacles = seen();
  move_to_vehicle({0.5, 1.5, std::numbers::pi / 2.0}, *obstacles);
  const Obstacle& ellipse = obstacles->obstacles[0];
  CHECK(ellipse.centre_x_m == Approx(10.5));
  CHECK(ellipse.centre_y_m == Approx(1.375));
  CHECK(ellipse.angle_rad == Approx(3.0 + std::numbers::pi / 2.0 - 2.0 * std::numbers::pi));
  const Obstacle& wall = obstacles->obstacles[1];
  CHECK(wall.vertices[0].x_m == Approx(0.5).margin(1e-12));
  CHECK(wall.vertices[0].y_m == Approx(-3.5));
  CHECK(wall.vertices[1].x_m == Approx(8.5));
  CHECK(wall.vertices[1].y_m == Approx(-3.5));
}

TEST_CASE("mounting: a head at the origin that looks ahead changes no bit", "[low_level][sonar]") {
  const auto before = seen();
  const auto after = seen();
  move_to_vehicle({}, *after);
  const auto same = [](double one, double other) {
    return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
  };
  for (std::size_t i = 0; i < before->count; ++i) {
    const Obstacle& one = before->obstacles[i];
    const Obstacle& other = after->obstacles[i];
    CHECK(same(one.centre_x_m, other.centre_x_m));
    CHECK(same(one.centre_y_m, other.centre_y_m));
    CHECK(same(one.angle_rad, other.angle_rad));
    for (std::size_t k = 0; k < one.vertex_count; ++k) {
      CHECK(same(one.vertices[k].x_m, other.vertices[k].x_m));
      CHECK(same(one.vertices[k].y_m, other.vertices[k].y_m));
    }
  }
}

}  // namespace
}  // namespace lodesman
