// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/frame_tracks.h"

#include <memory>

#include "low_level/sonar/known_obstacles.h"
#include "tests/support/catch.h"

namespace lodesman {
namespace {

const VehiclePose kEastward{{{1.0, 2.0}}, Heading::clockwise_from_y_rad(to_rad(90.0))};

Obstacle blob(double x_m, double y_m) {
  Obstacle obstacle;
  obstacle.id = 9;
  obstacle.centre_x_m = x_m;
  obstacle.centre_y_m = y_m;
  obstacle.semi_axis_first_m = 2.0;
  obstacle.semi_axis_second_m = 0.5;
  obstacle.angle_rad = to_rad(30.0);
  return obstacle;
}

}  // namespace

TEST_CASE("frame_tracks: a frame's obstacles lie in the world, of unknown past and motion",
          "[low_level][sonar]") {
  const auto frame = std::make_unique<SonarObstacles>();
  frame->frame = 12;
  frame->captured = Time{from_seconds(3.0)};
  frame->dropped = 2;
  frame->count = 2;
  frame->obstacles[0] = blob(0.0, 5.0);   // ahead: east
  frame->obstacles[1] = blob(-4.0, 0.0);  // to port: north
  const auto tracks = std::make_unique<Tracks>();
  tracks->tracks[0].velocity_x_m_s = 7.0;  // of another frame
  tracks_of_frame(*frame, kEastward, *tracks);
  CHECK(tracks->frame == 12);
  CHECK(tracks->captured == frame->captured);
  CHECK(tracks->dropped == 2);
  REQUIRE(tracks->count == 2);
  const Track& ahead = tracks->tracks[0];
  CHECK(ahead.id == 0);
  CHECK(ahead.shape.id == 0);
  CHECK(ahead.last_seen == frame->captured);
  CHECK(ahead.shape.centre_x_m == Approx(6.0));
  CHECK(ahead.shape.centre_y_m == Approx(2.0));
  CHECK(to_deg(ahead.shape.angle_rad) == Approx(120.0));
  CHECK(ahead.velocity_x_m_s == Approx(0.0).margin(1e-12));
  CHECK(ahead.place_xx_m2 > 0.0);
  CHECK(ahead.velocity_yy_m2_s2 > 0.0);
  CHECK(tracks->tracks[1].shape.centre_x_m == Approx(1.0));
  CHECK(tracks->tracks[1].shape.centre_y_m == Approx(6.0));
}

TEST_CASE("frame_tracks: an empty frame leaves nothing known", "[low_level][sonar]") {
  const auto tracks = std::make_unique<Tracks>();
  tracks->count = 3;
  tracks_of_frame(SonarObstacles{}, kEastward, *tracks);
  CHECK(tracks->count == 0);
}

TEST_CASE("frame_tracks: to_world undoes to_vehicle", "[low_level][sonar]") {
  Obstacle wall = blob(3.0, -2.0);
  wall.vertex_count = 2;
  wall.vertices[0] = {4.0, 5.0};
  wall.vertices[1] = {-6.0, 1.0};
  const Obstacle there = to_world(kEastward, to_vehicle(kEastward, wall));
  CHECK(there.centre_x_m == Approx(3.0));
  CHECK(there.centre_y_m == Approx(-2.0));
  CHECK(there.angle_rad == Approx(wall.angle_rad));
  CHECK(there.vertices[1].x_m == Approx(-6.0));
  CHECK(there.vertices[1].y_m == Approx(1.0));
}

}  // namespace lodesman
