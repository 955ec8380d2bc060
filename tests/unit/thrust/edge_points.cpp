// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/edge_points.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

[[nodiscard]] Obstacle ellipse(double x_m, double y_m, double first_m, double second_m,
                               double angle_rad = 0.0) {
  Obstacle obstacle;
  obstacle.centre_x_m = x_m;
  obstacle.centre_y_m = y_m;
  obstacle.semi_axis_first_m = first_m;
  obstacle.semi_axis_second_m = second_m;
  obstacle.angle_rad = angle_rad;
  return obstacle;
}

struct Scene {
  std::unique_ptr<SonarObstacles> seen = std::make_unique<SonarObstacles>();
  std::unique_ptr<EdgePoints> edges = std::make_unique<EdgePoints>();

  void add(const Obstacle& obstacle) { seen->obstacles[seen->count++] = obstacle; }
  // How far the points are from a place, at the least.
  [[nodiscard]] double nearest_m(double x_m, double y_m) const {
    double nearest_m = 1e9;
    for (const EdgePoint& p : edges->points()) {
      nearest_m = std::min(nearest_m, std::hypot(p.x_m - x_m, p.y_m - y_m));
    }
    return nearest_m;
  }
};

}  // namespace

TEST_CASE("edge points: all of an edge within reach, close together, and nothing else",
          "[low_level][thrust]") {
  for (const Obstacle& obstacle :
       {ellipse(0.0, 4.0, 0.05, 0.05), ellipse(1.0, 3.0, 1.5, 0.4, 0.7),
        ellipse(-2.0, 4.0, 0.01, 3.0, -1.2), ellipse(0.0, 340.0, 338.0, 338.0),
        ellipse(30.0, 2.0, 300.0, 0.5, std::numbers::pi / 2.0)}) {
    Scene scene;
    scene.add(obstacle);
    scene.edges->take(*scene.seen, 6.0);
    const auto points = scene.edges->points();
    REQUIRE(!points.empty());
    for (const EdgePoint& p : points) {
      CHECK(std::abs(edge_distance_m(obstacle, {{p.x_m, p.y_m}})) < 1e-6);
      CHECK(std::hypot(p.x_m, p.y_m) <= 6.0);
    }
    // Seen from any place within reach, the nearest point is hardly farther than the edge.
    for (double x_m = -3.0; x_m <= 3.0; x_m += 0.5) {
      for (double y_m = -1.0; y_m <= 3.0; y_m += 0.5) {
        const double edge_m = std::abs(edge_distance_m(obstacle, {{x_m, y_m}}));
        if (std::hypot(x_m, y_m) + edge_m < 5.8) {
          CHECK(scene.nearest_m(x_m, y_m) <= edge_m + EdgePoints::kSpacing_m);
        }
      }
    }
  }
}

TEST_CASE("edge points: walls, posts and corners", "[low_level][thrust]") {
  Obstacle wall;
  wall.shape = ObstacleShape::kPolygon;
  wall.vertex_count = 3;
  wall.vertices[0] = {-500.0, 3.0};
  wall.vertices[1] = {500.0, 3.0};
  wall.vertices[2] = {0.0, 900.0};
  Scene scene;
  scene.add(wall);
  Obstacle post;
  post.shape = ObstacleShape::kPolyline;
  post.vertex_count = 2;
  post.vertices[0] = post.vertices[1] = {2.0, 1.0};
  scene.add(post);
  scene.edges->take(*scene.seen, 6.0);
  for (double x_m = -5.0; x_m <= 5.0; x_m += 0.25) {
    CHECK(scene.nearest_m(x_m, 3.0) <= EdgePoints::kSpacing_m / 2.0 + 1e-9);
  }
  CHECK(scene.nearest_m(2.0, 1.0) < 1e-9);
  for (const EdgePoint& p : scene.edges->points()) {
    CHECK(p.obstacle == (p.y_m < 2.0 ? 1U : 0U));
  }
}

TEST_CASE("edge points: of more than there is room for the nearest are kept",
          "[low_level][thrust]") {
  Scene scene;
  for (int i = 0; i < 64; ++i) {
    scene.add(ellipse(i % 8 - 4.0, i / 8 + 1.0, 0.9, 0.9));
  }
  scene.edges->take(*scene.seen, 12.0);
  REQUIRE(!scene.edges->points().empty());
  CHECK(scene.edges->points().size() <= EdgePoints::kMaxPoints);
  const double nearest_m = edge_distance_m(ellipse(0.0, 1.0, 0.9, 0.9), {});
  CHECK(scene.nearest_m(0.0, 0.0) == Approx(std::abs(nearest_m)).margin(0.1));
}

TEST_CASE("edge points: a count beyond the list harms nobody", "[low_level][thrust]") {
  Scene scene;
  scene.add(ellipse(0.0, 4.0, 0.5, 0.5));
  scene.seen->count = 4'000'000'000U;
  scene.seen->obstacles[1].shape = ObstacleShape::kPolygon;
  scene.seen->obstacles[1].vertex_count = 4'000'000'000U;
  scene.edges->take(*scene.seen, 6.0);
  CHECK(scene.nearest_m(0.0, 3.5) < EdgePoints::kSpacing_m);
}
