// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/line.h"

#include <memory>

#include "high_level/guidance/zones.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

using Vec = Eigen::Vector2d;

const Leg kNorth{{0, 0}, {0, 100}};

// Stones of 1 m on the leg's line, each with a zone of 1 m round it.
[[nodiscard]] std::unique_ptr<PathRequest> stones_at(std::initializer_list<double> along_m) {
  auto request = std::make_unique<PathRequest>();
  for (const double y_m : along_m) {
    PathZone& zone = request->zones[request->zone_count++];
    zone.shape.shape = ObstacleShape::kEllipse;
    zone.shape.centre_y_m = y_m;
    zone.shape.semi_axis_first_m = 1.0;
    zone.shape.semi_axis_second_m = 1.0;
    put_zone(zone.shape, 1.0);
  }
  return request;
}

}  // namespace

TEST_CASE("leg: how far along it a point lies, and how far off, to starboard positive",
          "[geometry]") {
  CHECK(kNorth.along_m({3, 40}) == Approx(40));
  CHECK(kNorth.cross_track_m({3, 40}) == Approx(3));
  CHECK(kNorth.cross_track_m({-2, 140}) == Approx(-2));
  CHECK(kNorth.along_m({0, -5}) == Approx(0.0));
  CHECK(kNorth.along_m({0, 105}) == Approx(100));
  CHECK((kNorth.at(25) - Vec{0, 25}).norm() < 1e-9);
  const Leg back{{0, 100}, {0, 0}};
  CHECK(back.cross_track_m({3, 40}) == Approx(-3));
  const Leg point{{4, 3}, {4, 3}};
  CHECK(point.along_m({0, 0}) == Approx(0.0));
  CHECK(point.cross_track_m({0, 0}) == Approx(5));
  CHECK((point.at(0) - Vec{4, 3}).norm() < 1e-9);
}

TEST_CASE("line: one that is clear is sailed by, as far as it matters", "[guidance]") {
  const auto none = stones_at({});
  const LineToKeep near = line_to_keep(kNorth, *none, {1, 10}, {});
  CHECK(near.is_clear);
  CHECK(near.along_m == Approx(10));
  CHECK(near.leave_m == Approx(near.along_m));
  CHECK(near.rejoin_m > 30.0);
  CHECK(near.rejoin_m < 100.0);
  // Near its end the goal itself is made for.
  CHECK(line_to_keep(kNorth, *none, {1, 90}, {}).rejoin_m == Approx(100));
  // What lies beyond what matters now is no reason to leave it.
  CHECK(line_to_keep(kNorth, *stones_at({60}), {0, 10}, {}).is_clear);
}

TEST_CASE("line: it is left shortly before what lies on it, and gone back to after", "[guidance]") {
  const LineToKeep line = line_to_keep(kNorth, *stones_at({30}), {0, 10}, {});
  CHECK_FALSE(line.is_clear);
  CHECK(line.leave_m > 15.0);
  CHECK(line.leave_m < 28.0);
  CHECK(line.rejoin_m > 32.0);
  CHECK(line.rejoin_m < 40.0);
  // Beside it, it is on its way round.
  const LineToKeep beside = line_to_keep(kNorth, *stones_at({30}), {2.5, 27}, {});
  CHECK(beside.leave_m == Approx(beside.along_m));
  CHECK(beside.rejoin_m == Approx(line.rejoin_m).margin(0.6));
  // Of two it is gone back to after the second, where both matter, and to no place in a zone.
  CHECK(line_to_keep(kNorth, *stones_at({20, 30}), {0, 10}, {}).rejoin_m == Approx(line.rejoin_m));
  CHECK(line_to_keep(kNorth, *stones_at({30, 40}), {0, 8}, {}).rejoin_m > 42.0);
  // What lies on it up to its end: the goal itself is made for.
  CHECK(line_to_keep(kNorth, *stones_at({98}), {0, 90}, {}).rejoin_m == Approx(100));
}

TEST_CASE("line: from far off it is gone back to at a slant", "[guidance]") {
  const LineToKeep line = line_to_keep(kNorth, *stones_at({}), {12, 30}, {});
  CHECK_FALSE(line.is_clear);
  CHECK(line.leave_m == Approx(line.along_m));
  CHECK(line.rejoin_m > 40.0);
  CHECK(line.rejoin_m < 60.0);
}

TEST_CASE("line: what is gone round stays in mind where the way round leads back", "[guidance]") {
  const auto stone = stones_at({40});
  const LineToKeep beside = line_to_keep(kNorth, *stone, {2, 36}, {});
  REQUIRE(beside.goes_round);
  // Back by so much that the line could be sailed again, or that nothing on it would matter yet.
  for (const double back_to_m : {20.0, 2.0}) {
    const LineToKeep back = line_to_keep(kNorth, *stone, {0, back_to_m}, beside);
    CHECK_FALSE(back.is_clear);
    CHECK(back.goes_round);
    CHECK(back.leave_m == Approx(back.along_m));
    CHECK(back.rejoin_m == Approx(beside.rejoin_m).margin(0.6));
    CHECK_FALSE(line_to_keep(kNorth, *stone, {0, back_to_m}, {}).goes_round);
  }
  // Once it is passed, or gone, it is forgotten; what comes after it is another.
  CHECK(line_to_keep(kNorth, *stone, {1, 46}, beside).is_clear);
  CHECK(line_to_keep(kNorth, *stones_at({}), {1, 30}, beside).is_clear);
  const LineToKeep next = line_to_keep(kNorth, *stones_at({40, 70}), {1, 46}, beside);
  CHECK_FALSE(next.goes_round);
  CHECK(next.leave_m > 55.0);
}

TEST_CASE("line: between the vehicle and a line that it is near to nothing may lie", "[guidance]") {
  auto wall = stones_at({});
  PathZone& zone = wall->zones[wall->zone_count++];
  zone.shape.shape = ObstacleShape::kPolyline;
  zone.shape.vertex_count = 2;
  zone.shape.vertices[0] = {1.5, 5.0};
  zone.shape.vertices[1] = {1.5, 35.0};
  put_zone(zone.shape, 0.5);
  CHECK_FALSE(line_to_keep(kNorth, *wall, {2.8, 10}, {}).is_clear);
  CHECK(line_to_keep(kNorth, *wall, {-2.8, 10}, {}).is_clear);
}
