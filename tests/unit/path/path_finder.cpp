// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/path_finder.h"

#include <cmath>
#include <limits>
#include <memory>

#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/path/reference_search.h"

namespace lodesman::testing {
namespace {

constexpr double kRange = 30.0;

struct Rig {
  std::unique_ptr<SonarObstacles> obstacles = std::make_unique<SonarObstacles>();
  std::unique_ptr<SonarPath> path = std::make_unique<SonarPath>();
  std::unique_ptr<PathRequest> request = std::make_unique<PathRequest>();
  PathFinder finder;

  void add_disc(double x_m, double y_m, double protection_m) {
    Obstacle& o = obstacles->obstacles[obstacles->count++];
    o.centre_x_m = x_m;
    o.centre_y_m = y_m;
    o.protection_first_m = protection_m;
    o.protection_second_m = protection_m;
  }
  PathReason find(double goal_x_m, double goal_y_m, double range_m = kRange) {
    request->id = 7;
    request->frame = 41;
    request->goal_x_m = goal_x_m;
    request->goal_y_m = goal_y_m;
    obstacles->range_m = range_m;
    finder.find_path(*obstacles, *request, *path);
    return path->reason;
  }
};

TEST_CASE("path_finder: a path leads from the apex to the goal's pixel and carries its frame",
          "[low_level][path]") {
  Rig rig;
  rig.obstacles->frame = 41;
  rig.obstacles->captured = Time{Duration{123456789}};
  rig.path->plan_time_ns = 99;
  rig.add_disc(0.0, 10.0, 3.5);
  REQUIRE(rig.find(3.0, 20.0) == PathReason::kFound);
  REQUIRE(rig.path->request == 7);
  REQUIRE(rig.path->frame == 41);
  REQUIRE(rig.path->captured == Time{Duration{123456789}});
  REQUIRE(rig.path->plan_time_ns == 99);
  REQUIRE(rig.path->expansions > 0);
  const std::span<const PathPixel> pixels{rig.path->pixels.data(), rig.path->pixel_count};
  require_walkable(rig.finder.grid(), pixels, pixel(433, 499), pixel(483, 166),
                   rig.path->cost_10_14);
}

TEST_CASE("path_finder: the paper's obstacle dead ahead is passed to starboard",
          "[low_level][path]") {
  Rig rig;
  rig.add_disc(0.0, 10.0, 3.5);
  REQUIRE(rig.find(0.0, 20.0) == PathReason::kFound);
  const SonarView view{kRange};
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < rig.path->pixel_count; ++i) {
    REQUIRE(rig.path->pixels[i].column >= kApexColumn);
    const VehiclePoint p = view.to_vehicle(rig.path->pixels[i]);
    nearest_m = std::min(nearest_m, std::hypot(p.xy_m.x(), p.xy_m.y() - 10.0));
  }
  REQUIRE(nearest_m > 3.5);
  REQUIRE(nearest_m < 3.7);
}

TEST_CASE("path_finder: each reason reaches the message", "[low_level][path]") {
  Rig rig;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  REQUIRE(rig.find(0.0, 20.0) == PathReason::kFound);
  REQUIRE(rig.find(0.0, -1.0) == PathReason::kGoalOutOfView);
  REQUIRE(rig.path->pixel_count == 0);
  REQUIRE(rig.path->cost_10_14 == 0);
  REQUIRE(rig.find(20.0, 2.0) == PathReason::kGoalOutOfView);
  REQUIRE(rig.find(0.0, 1e300) == PathReason::kGoalOutOfView);
  REQUIRE(rig.find(nan, 5.0) == PathReason::kGoalOutOfView);
  rig.add_disc(0.0, 20.0, 1.0);
  REQUIRE(rig.find(0.0, 20.0) == PathReason::kGoalBlocked);
  rig.obstacles->obstacles[0].protection_first_m = 40.0;
  REQUIRE(rig.find(0.0, 29.0) == PathReason::kStartBlocked);
  REQUIRE(rig.find(nan, 29.0) == PathReason::kStartBlocked);

  Obstacle& bar = rig.obstacles->obstacles[0];
  bar.shape = ObstacleShape::kPolyline;
  bar.protection_first_m = 0.5;
  bar.vertex_count = 2;
  bar.vertices[0] = {-30.0, 10.0};
  bar.vertices[1] = {30.0, 10.0};
  REQUIRE(rig.find(0.0, 20.0) == PathReason::kNoPath);

  rig.obstacles->count = 0;
  rig.finder = PathFinder{SearchLimits{0}};
  REQUIRE(rig.find(3.0, 20.0) == PathReason::kLimit);
}

TEST_CASE("path_finder: an obstacle that cannot be drawn leaves no path", "[low_level][path]") {
  Rig rig;
  rig.add_disc(std::numeric_limits<double>::quiet_NaN(), 10.0, 1.0);
  REQUIRE(rig.find(0.0, 20.0) == PathReason::kStartBlocked);
  REQUIRE(rig.finder.grid().free_pixels() == 0);
}

TEST_CASE("path_finder: counts beyond a message's room are not believed", "[low_level][path]") {
  Rig rig;
  for (std::size_t i = 0; i < kMaxObstacles; ++i) {
    rig.add_disc(-10.0, 20.0, 1.0);
  }
  rig.obstacles->count = 1000;
  rig.obstacles->obstacles[0].shape = ObstacleShape::kPolyline;
  rig.obstacles->obstacles[0].vertex_count = 1000;
  for (Vertex& vertex : rig.obstacles->obstacles[0].vertices) {
    vertex = {-10.0, 20.0};
  }
  REQUIRE(rig.find(0.0, 20.0) == PathReason::kFound);
}

TEST_CASE("path_finder: a range that is no range has every goal out of view", "[low_level][path]") {
  Rig rig;
  for (const double range_m : {0.0, -30.0, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
    REQUIRE(rig.find(0.0, 20.0, range_m) == PathReason::kGoalOutOfView);
  }
}

TEST_CASE("path_finder: the goal's pixel is the nearest one", "[low_level][path]") {
  const SonarView view{kRange};
  const auto nearest = [&view](double x_m, double y_m) {
    return nearest_pixel(view, VehiclePoint{{x_m, y_m}});
  };
  REQUIRE(same(*nearest(0.0, 0.0), pixel(433, 499)));
  REQUIRE(same(*nearest(0.6, 12.0), pixel(443, 299)));
  REQUIRE(same(*nearest(0.62, 12.02), pixel(443, 299)));
  REQUIRE(same(*nearest(0.64, 11.98), pixel(444, 299)));
  REQUIRE(same(*nearest(-0.62, 12.04), pixel(423, 298)));
  REQUIRE_FALSE(nearest(0.0, 29.98));
  REQUIRE_FALSE(nearest(0.0, -0.04));
}

TEST_CASE("path_finder: nothing is allocated once it is made", "[low_level][path]") {
  Rig rig;
  rig.add_disc(1.0, 10.0, 3.5);
  Obstacle& polygon = rig.obstacles->obstacles[rig.obstacles->count++];
  polygon.shape = ObstacleShape::kPolygon;
  polygon.protection_first_m = 0.7;
  polygon.vertex_count = 3;
  polygon.vertices[0] = {-6.0, 12.0};
  polygon.vertices[1] = {-9.0, 14.0};
  polygon.vertices[2] = {-5.0, 17.0};
  const AllocationScope scope;
  rig.find(0.0, 20.0);
  const std::uint64_t allocations = scope.count();
  REQUIRE(allocations == 0);
  REQUIRE(rig.path->reason == PathReason::kFound);
}

}  // namespace
}  // namespace lodesman::testing
