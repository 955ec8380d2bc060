// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/world_path_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "mid_level/base/frames.h"
#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using Vec = Eigen::Vector2d;

std::unique_ptr<PathRequest> world_request(const Vec& start, const Vec& goal) {
  auto request = std::make_unique<PathRequest>();
  request->space = PathSpace::kWorld;
  request->start_x_m = start.x();
  request->start_y_m = start.y();
  request->goal_x_m = goal.x();
  request->goal_y_m = goal.y();
  return request;
}

PathZone world_ellipse(const Vec& centre, double first_m, double second_m, double angle_deg = 0.0) {
  PathZone zone;
  zone.shape.centre_x_m = centre.x();
  zone.shape.centre_y_m = centre.y();
  zone.shape.angle_rad = to_rad(angle_deg);
  zone.shape.protection_first_m = first_m;
  zone.shape.protection_second_m = second_m;
  return zone;
}

// A square basin of 5 m round (100, 200) with a gap in the north, 0.8 m from its walls kept clear.
PathZone basin(double gap_m, double give_m) {
  PathZone zone;
  zone.shape.shape = ObstacleShape::kPolyline;
  zone.shape.protection_first_m = 0.8;
  zone.give_m = give_m;
  const double side_m = gap_m / 2.0;
  for (const Vec& p :
       {Vec{side_m, 5}, Vec{5, 5}, Vec{5, -5}, Vec{-5, -5}, Vec{-5, 5}, Vec{-side_m, 5}}) {
    zone.shape.vertices[zone.shape.vertex_count++] = {100.0 + p.x(), 200.0 + p.y()};
  }
  return zone;
}

std::unique_ptr<SonarPath> find_in_world(const PathRequest& request) {
  const auto finder = std::make_unique<WorldPathFinder>();
  auto path = std::make_unique<SonarPath>();
  finder->find_path(request, *path);
  return path;
}

Vec point_of(const SonarPath& path, std::uint32_t i) {
  return {path.points[i].x_m, path.points[i].y_m};
}

double length_of_line(const SonarPath& path) {
  double length_m = 0.0;
  for (std::uint32_t i = 1; i < path.point_count; ++i) {
    length_m += (point_of(path, i) - point_of(path, i - 1)).norm();
  }
  return length_m;
}

// The least distance of the line to the edge of an ellipse's zone.
double distance_to_zone_m(const SonarPath& path, const PathZone& zone) {
  Obstacle edge = zone.shape;
  edge.semi_axis_first_m = edge.protection_first_m;
  edge.semi_axis_second_m = edge.protection_second_m;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 1; i < path.point_count; ++i) {
    for (double share = 0.0; share <= 1.0; share += 0.02) {
      const Vec p = point_of(path, i - 1) + share * (point_of(path, i) - point_of(path, i - 1));
      least_m = std::min(least_m, edge_distance_m(edge, {p}));
    }
  }
  return least_m;
}

}  // namespace

TEST_CASE("world_path_finder: metres go in and come out, in any direction", "[low_level][path]") {
  for (const Vec& way : {Vec{3, 25}, Vec{-40, -9}, Vec{0, -70}}) {
    const Vec start{1000.0, -300.0};
    const auto path = find_in_world(*world_request(start, start + way));
    REQUIRE(path->reason == PathReason::kFound);
    REQUIRE(path->point_count == 2);
    CHECK((point_of(*path, 0) - start).norm() < 1e-9);
    CHECK((point_of(*path, 1) - start - way).norm() < 1e-9);
    CHECK(path->length_m == Approx(way.norm()));
    CHECK_FALSE(path->narrow);
    CHECK_FALSE(path->sides_changed);
  }
}

TEST_CASE("world_path_finder: the line touches a slanted zone and does not enter it",
          "[low_level][path]") {
  for (const double angle_deg : {35.0, -35.0, 90.0}) {
    const auto request = world_request({100, 200}, {101, 225});
    request->zones[request->zone_count++] = world_ellipse({100.3, 212}, 6.0, 1.2, angle_deg);
    const auto path = find_in_world(*request);
    REQUIRE(path->reason == PathReason::kFound);
    CHECK(distance_to_zone_m(*path, request->zones[0]) == Approx(0.0).margin(0.02));
    CHECK(path->length_m == Approx(length_of_line(*path)));
    CHECK(path->length_m > 25.02);
  }
}

TEST_CASE("world_path_finder: sides that are asked for are kept until another saves the gain",
          "[low_level][path]") {
  const auto request = world_request({0, 0}, {0, 20});
  request->zones[request->zone_count++] = world_ellipse({0.8, 10}, 3.0, 3.0);
  const auto shortest = find_in_world(*request);
  REQUIRE(shortest->point_count > 2);
  CHECK(point_of(*shortest, shortest->point_count / 2).x() < 0.0);

  request->zones[0].may_keep_to_starboard = false;  // west of it is not asked for
  request->side_gain_m = 5.0;
  const auto kept = find_in_world(*request);
  REQUIRE(kept->reason == PathReason::kFound);
  CHECK(point_of(*kept, kept->point_count / 2).x() > 0.8);
  CHECK(kept->length_m > shortest->length_m + 0.1);
  CHECK_FALSE(kept->sides_changed);

  request->side_gain_m = 0.1;
  const auto changed = find_in_world(*request);
  CHECK(point_of(*changed, changed->point_count / 2).x() < 0.0);
  CHECK(changed->length_m == Approx(shortest->length_m));
  CHECK(changed->sides_changed);
}

TEST_CASE("world_path_finder: sides that cannot be kept are given up", "[low_level][path]") {
  // East of the disc a wall leaves no way round it that is not some 190 m long.
  const auto request = world_request({0, 0}, {0, 20});
  request->zones[request->zone_count++] = world_ellipse({0.8, 10}, 3.0, 3.0);
  request->zones[0].may_keep_to_starboard = false;
  PathZone wall;
  wall.shape.shape = ObstacleShape::kPolyline;
  wall.shape.protection_first_m = 0.5;
  wall.shape.vertices[wall.shape.vertex_count++] = {1.0, 10.0};
  wall.shape.vertices[wall.shape.vertex_count++] = {100.0, 10.0};
  request->zones[request->zone_count++] = wall;
  request->side_gain_m = 5.0;
  const auto path = find_in_world(*request);
  REQUIRE(path->reason == PathReason::kFound);
  CHECK(path->sides_changed);
  CHECK(path->length_m < 22.0);
}

TEST_CASE("world_path_finder: zones give only where there is no way otherwise",
          "[low_level][path]") {
  const auto request = world_request({100, 200}, {100, 215});
  request->zones[request->zone_count++] = basin(2.0, 0.4);
  const auto wide = find_in_world(*request);
  CHECK(wide->reason == PathReason::kFound);
  CHECK_FALSE(wide->narrow);
  request->zones[0] = basin(1.0, 0.4);
  const auto narrow = find_in_world(*request);
  CHECK(narrow->reason == PathReason::kFound);
  CHECK(narrow->narrow);
  CHECK(narrow->length_m == Approx(15.0));
  request->zones[0] = basin(1.0, 0.2);
  const auto closed = find_in_world(*request);
  CHECK(closed->reason == PathReason::kNoPath);
  CHECK_FALSE(closed->narrow);
}

TEST_CASE("world_path_finder: a start or goal that only the full zone blocks is none",
          "[low_level][path]") {
  const auto request = world_request({0, 0}, {0, 20});
  request->zones[request->zone_count++] = world_ellipse({0, 21}, 2.0, 2.0);
  CHECK(find_in_world(*request)->reason == PathReason::kGoalBlocked);
  request->zones[0].give_m = 1.2;
  const auto path = find_in_world(*request);
  CHECK(path->reason == PathReason::kFound);
  CHECK(path->narrow);
}

TEST_CASE("world_path_finder: where it is ringed in, the line leads as near as there is",
          "[low_level][path]") {
  const auto request = world_request({97, 197}, {103, 230});
  request->zones[request->zone_count++] = basin(0.2, 0.0);
  request->zones[request->zone_count++] = world_ellipse({99, 200}, 1.5, 1.5);
  const auto path = find_in_world(*request);
  REQUIRE(path->reason == PathReason::kNoPath);
  REQUIRE(path->point_count >= 2);
  CHECK((point_of(*path, 0) - Vec{97, 197}).norm() < 1e-9);
  const Vec end = point_of(*path, path->point_count - 1);
  CHECK((end - Vec{103, 230}).norm() < (Vec{97, 197} - Vec{103, 230}).norm() - 2.0);
  CHECK(std::abs(end.x() - 100.0) < 4.2);
  CHECK(std::abs(end.y() - 200.0) < 4.2);
  CHECK(path->length_m == Approx(length_of_line(*path)));
}

TEST_CASE("world_path_finder: among too many spiked walls it ends at its limit, without a line",
          "[low_level][path]") {
  std::mt19937 random{3};
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>{low, high}(random);
  };
  const auto request = world_request({0, 0}, {-2, 27});
  while (request->zone_count < kMaxObstacles) {
    PathZone& zone = request->zones[request->zone_count++];
    zone.shape.shape = ObstacleShape::kPolygon;
    zone.shape.protection_first_m = between(0.03, 0.18);
    const Vec centre{between(-23, 23), between(3, 26)};
    const double radius_m = between(0.5, 3.6);
    for (std::uint32_t i = 0; i < kMaxVertices; ++i) {
      const double turn_rad = 2.0 * std::numbers::pi * i / kMaxVertices;
      const double out_m = i % 2 == 0 ? radius_m : 0.6 * radius_m;
      zone.shape.vertices[zone.shape.vertex_count++] = {centre.x() + out_m * std::sin(turn_rad),
                                                        centre.y() + out_m * std::cos(turn_rad)};
    }
  }
  const auto path = find_in_world(*request);
  CHECK(path->reason == PathReason::kLimit);
  CHECK(path->expansions == WorldPathFinder::kMaxTried);
  CHECK(path->point_count == 0);
}

TEST_CASE("world_path_finder: nothing is remembered from one request to the next",
          "[low_level][path]") {
  WorldPathFinder finder;
  const auto path = std::make_unique<SonarPath>();
  const auto narrow = world_request({100, 200}, {100, 215});
  narrow->zones[narrow->zone_count++] = basin(1.0, 0.4);
  finder.find_path(*narrow, *path);
  REQUIRE(path->narrow);
  finder.find_path(*world_request({0, 0}, {0, 20}), *path);
  CHECK(path->point_count == 2);
  CHECK_FALSE(path->narrow);
}

TEST_CASE("world_path_finder: nothing is allocated once it is made", "[low_level][path]") {
  WorldPathFinder finder;
  const auto path = std::make_unique<SonarPath>();
  const auto request = world_request({97, 197}, {103, 230});
  request->zones[request->zone_count++] = basin(0.2, 0.0);
  request->zones[request->zone_count++] = world_ellipse({99, 200}, 1.5, 1.5);
  request->zones[1].may_keep_to_port = false;
  const AllocationScope scope;
  finder.find_path(*request, *path);
  const auto allocations = scope.count();
  CHECK(path->expansions > 3);
  CHECK(allocations == 0);
}

}  // namespace lodesman::testing
