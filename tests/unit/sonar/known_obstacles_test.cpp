// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/known_obstacles.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "mid_level/base/heading.h"
#include "tests/support/catch.h"

namespace lodesman {
namespace {

MovingObstacle disc(double x_m, double y_m, double protection_m = 3.5) {
  MovingObstacle moving;
  moving.at_start.id = 3;
  moving.at_start.centre_x_m = x_m;
  moving.at_start.centre_y_m = y_m;
  moving.at_start.semi_axis_first_m = 0.5;
  moving.at_start.semi_axis_second_m = 0.5;
  moving.at_start.protection_first_m = protection_m;
  moving.at_start.protection_second_m = protection_m;
  return moving;
}

KnownView view_at(double x_m, double y_m, double heading_deg, double time_s = 0.0) {
  KnownView view;
  view.frame = 11;
  view.captured = Time{Duration{17}};
  view.scenario_time_s = time_s;
  view.pose = {{{x_m, y_m}}, Heading::clockwise_from_y_rad(to_rad(heading_deg))};
  view.range_m = 30.0;
  return view;
}

std::unique_ptr<SonarObstacles> see(const std::vector<MovingObstacle>& world,
                                    const KnownView& view) {
  auto out = std::make_unique<SonarObstacles>();
  see_known_obstacles(world, view, *out);
  return out;
}

}  // namespace

TEST_CASE("known obstacles: the paper's static obstacle lies ahead of a vehicle at the origin",
          "[low_level][sonar]") {
  const auto seen = see({disc(0.0, 10.0)}, view_at(0.0, 0.0, 0.0));
  REQUIRE(seen->count == 1);
  CHECK(seen->frame == 11);
  CHECK(seen->captured == Time{Duration{17}});
  CHECK(seen->obstacles[0].id == 3);
  CHECK(seen->obstacles[0].centre_x_m == Approx(0.0).margin(1e-12));
  CHECK(seen->obstacles[0].centre_y_m == Approx(10.0));
  CHECK(seen->obstacles[0].protection_first_m == Approx(3.5));
}

TEST_CASE("known obstacles: a vehicle heading east sees the north on its port side",
          "[low_level][sonar]") {
  MovingObstacle ellipse = disc(5.0, 12.0);
  ellipse.at_start.semi_axis_first_m = 2.0;
  ellipse.at_start.angle_rad = to_rad(30.0);  // from north
  const auto seen = see({ellipse}, view_at(1.0, 2.0, 90.0));
  REQUIRE(seen->count == 1);
  const Obstacle& o = seen->obstacles[0];
  CHECK(o.centre_x_m == Approx(-10.0));  // 10 m north: to port
  CHECK(o.centre_y_m == Approx(4.0));    // 4 m east: ahead
  CHECK(to_deg(o.angle_rad) == Approx(-60.0));
}

TEST_CASE("known obstacles: vertices of a wall turn with the vehicle", "[low_level][sonar]") {
  MovingObstacle wall;
  wall.at_start.shape = ObstacleShape::kPolyline;
  wall.at_start.vertex_count = 2;
  wall.at_start.vertices[0] = {-10.0, 5.0};
  wall.at_start.vertices[1] = {10.0, 5.0};
  wall.at_start.protection_first_m = 1.0;
  const auto seen = see({wall}, view_at(0.0, 0.0, -90.0));  // heading west: north to starboard
  REQUIRE(seen->count == 1);
  CHECK(seen->obstacles[0].vertices[0].x_m == Approx(5.0));
  CHECK(seen->obstacles[0].vertices[0].y_m == Approx(10.0));
  CHECK(seen->obstacles[0].vertices[1].x_m == Approx(5.0));
  CHECK(seen->obstacles[0].vertices[1].y_m == Approx(-10.0));
}

TEST_CASE("known obstacles: only what exists then, where it is then", "[low_level][sonar]") {
  MovingObstacle mover = disc(0.0, 20.0);
  mover.velocity_y_m_s = -0.5;
  mover.appears_at_s = 4.0;
  mover.vanishes_at_s = 10.0;
  CHECK(see({mover}, view_at(0.0, 0.0, 0.0, 3.9))->count == 0);
  CHECK(see({mover}, view_at(0.0, 0.0, 0.0, 10.0))->count == 0);
  const auto seen = see({mover}, view_at(0.0, 0.0, 0.0, 4.0));
  REQUIRE(seen->count == 1);
  CHECK(seen->obstacles[0].centre_y_m == Approx(18.0));
}

TEST_CASE("known obstacles: what lies wholly beyond the range is not in the view",
          "[low_level][sonar]") {
  CHECK(see({disc(0.0, 33.4)}, view_at(0.0, 0.0, 0.0))->count == 1);
  CHECK(see({disc(0.0, 33.6)}, view_at(0.0, 0.0, 0.0))->count == 0);

  MovingObstacle wall;  // its ends are far away, its middle is not
  wall.at_start.shape = ObstacleShape::kPolyline;
  wall.at_start.vertex_count = 2;
  wall.at_start.vertices[0] = {-500.0, 30.5};
  wall.at_start.vertices[1] = {500.0, 30.5};
  wall.at_start.protection_first_m = 1.0;
  CHECK(see({wall}, view_at(0.0, 0.0, 0.0))->count == 1);
  CHECK(see({wall}, view_at(0.0, -2.0, 0.0))->count == 0);

  MovingObstacle basin = wall;  // all round the vehicle, and filled
  basin.at_start.shape = ObstacleShape::kPolygon;
  basin.at_start.vertex_count = 3;
  basin.at_start.vertices[0] = {-500.0, -200.0};
  basin.at_start.vertices[1] = {500.0, -200.0};
  basin.at_start.vertices[2] = {0.0, 500.0};
  CHECK(see({basin}, view_at(0.0, 0.0, 0.0))->count == 1);
  CHECK(see({basin}, view_at(0.0, 600.0, 0.0))->count == 0);
}

TEST_CASE("known obstacles: of too many the nearest are kept, in order, and the rest counted",
          "[low_level][sonar]") {
  std::vector<MovingObstacle> world;
  for (int i = 0; i < 100; ++i) {
    world.push_back(disc(0.0, 25.0 - 0.2 * i, 1.0));
  }
  const auto seen = see(world, view_at(0.0, 0.0, 0.0));
  REQUIRE(seen->count == kMaxObstacles);
  CHECK(seen->dropped == 100 - kMaxObstacles);
  CHECK(seen->obstacles[0].centre_y_m == Approx(5.2));
  CHECK(seen->obstacles[63].centre_y_m == Approx(5.2 + 0.2 * 63));
  CHECK(see({}, view_at(0.0, 0.0, 0.0))->count == 0);
}

TEST_CASE("known obstacles: to_world undoes to_vehicle", "[low_level][sonar]") {
  const VehiclePose eastward{{{1.0, 2.0}}, Heading::clockwise_from_y_rad(to_rad(90.0))};
  Obstacle wall;
  wall.centre_x_m = 3.0;
  wall.centre_y_m = -2.0;
  wall.angle_rad = to_rad(30.0);
  wall.vertex_count = 2;
  wall.vertices[0] = {4.0, 5.0};
  wall.vertices[1] = {-6.0, 1.0};
  const Obstacle there = to_world(eastward, to_vehicle(eastward, wall));
  CHECK(there.centre_x_m == Approx(3.0));
  CHECK(there.centre_y_m == Approx(-2.0));
  CHECK(there.angle_rad == Approx(wall.angle_rad));
  CHECK(there.vertices[1].x_m == Approx(-6.0));
  CHECK(there.vertices[1].y_m == Approx(1.0));
}

}  // namespace lodesman
