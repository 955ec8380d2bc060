// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr HullSize kHull{2.04, 1.20};

[[nodiscard]] Obstacle ellipse(double x_m, double y_m, double first_m, double second_m,
                               double angle_rad) {
  Obstacle obstacle;
  obstacle.centre_x_m = x_m;
  obstacle.centre_y_m = y_m;
  obstacle.semi_axis_first_m = first_m;
  obstacle.semi_axis_second_m = second_m;
  obstacle.angle_rad = angle_rad;
  return obstacle;
}

[[nodiscard]] Obstacle wall(ObstacleShape shape, const std::vector<Vec>& points) {
  Obstacle obstacle;
  obstacle.shape = shape;
  for (const Vec& p : points) {
    obstacle.vertices[obstacle.vertex_count++] = {p.x(), p.y()};
  }
  return obstacle;
}

[[nodiscard]] VehiclePose pose_at(double x_m, double y_m, double heading_rad) {
  return {{{x_m, y_m}}, Heading::clockwise_from_y_rad(heading_rad)};
}

// Points of the obstacle's edge, close together, and the largest gap between two neighbours.
struct Samples {
  std::vector<Vec> points;
  double gap_m = 0.0;
};

void add_ring(const Obstacle& e, double share, int count, Samples& samples) {
  const Vec along{std::sin(e.angle_rad), std::cos(e.angle_rad)};
  const Vec across{along.y(), -along.x()};
  for (int i = 0; i < count; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / count;
    samples.points.push_back(Vec{e.centre_x_m, e.centre_y_m} +
                             share * (std::cos(angle_rad) * e.semi_axis_first_m * along +
                                      std::sin(angle_rad) * e.semi_axis_second_m * across));
  }
}

[[nodiscard]] Samples edge_of(const Obstacle& o) {
  constexpr int kCount = 4000;
  Samples samples;
  if (o.shape == ObstacleShape::kEllipse) {
    add_ring(o, 1.0, kCount, samples);
    samples.gap_m =
        2.0 * std::numbers::pi * std::max(o.semi_axis_first_m, o.semi_axis_second_m) / kCount;
    return samples;
  }
  const std::uint32_t sides = o.vertex_count - (o.shape == ObstacleShape::kPolygon ? 0 : 1);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % o.vertex_count;
    const Vec a{o.vertices[i].x_m, o.vertices[i].y_m};
    const Vec b{o.vertices[j].x_m, o.vertices[j].y_m};
    for (int k = 0; k <= 1000; ++k) {
      samples.points.push_back(a + (b - a) * (k / 1000.0));
    }
    samples.gap_m = std::max(samples.gap_m, (b - a).norm() / 1000.0);
  }
  return samples;
}

// By the implicit equation, or by the angle that the edge turns through as seen from p.
[[nodiscard]] bool within(const Obstacle& o, const Vec& p) {
  if (o.shape == ObstacleShape::kPolyline) {
    return false;
  }
  if (o.shape == ObstacleShape::kEllipse) {
    const double x_m = p.x() - o.centre_x_m;
    const double y_m = p.y() - o.centre_y_m;
    const double first = x_m * std::sin(o.angle_rad) + y_m * std::cos(o.angle_rad);
    const double second = x_m * std::cos(o.angle_rad) - y_m * std::sin(o.angle_rad);
    return std::hypot(first / o.semi_axis_first_m, second / o.semi_axis_second_m) < 1.0;
  }
  double turned_rad = 0.0;
  for (std::uint32_t i = 0; i < o.vertex_count; ++i) {
    const Vertex& next = o.vertices[(i + 1) % o.vertex_count];
    const Vec a = Vec{o.vertices[i].x_m, o.vertices[i].y_m} - p;
    const Vec b = Vec{next.x_m, next.y_m} - p;
    turned_rad += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(turned_rad) > std::numbers::pi;
}

[[nodiscard]] double sampled_edge_distance(const Samples& samples, const Vec& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec& q : samples.points) {
    nearest = std::min(nearest, (q - p).norm());
  }
  return nearest;
}

// Distance of a point from the hull, by its four sides.
[[nodiscard]] double hull_distance(const VehiclePose& pose, const Vec& q) {
  const Vec v = pose.to_vehicle({q}).xy_m;
  const double right = std::abs(v.x()) - kHull.beam_m / 2.0;
  const double ahead = std::abs(v.y()) - kHull.length_m / 2.0;
  if (right > 0.0 && ahead > 0.0) {
    return std::hypot(right, ahead);
  }
  return std::max(right, ahead);
}

[[nodiscard]] std::vector<Obstacle> some_obstacles(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place{-4.0, 4.0};
  std::uniform_real_distribution<double> size{0.05, 3.0};
  std::uniform_real_distribution<double> angle{-3.1, 3.1};
  const double radius_m = size(random);
  const double x_m = place(random);
  const double y_m = place(random);
  return {ellipse(place(random), place(random), radius_m, radius_m, 0.0),
          ellipse(place(random), place(random), size(random), size(random), angle(random)),
          ellipse(place(random), place(random), 3.0, 0.02, angle(random)),
          wall(ObstacleShape::kPolyline, {{place(random), place(random)},
                                          {place(random), place(random)},
                                          {place(random), place(random)}}),
          wall(ObstacleShape::kPolygon, {{x_m, y_m},
                                         {x_m + size(random), y_m},
                                         {x_m + size(random), y_m + size(random)},
                                         {x_m + 0.3, y_m + 0.3},
                                         {x_m, y_m + size(random)}})};
}

TEST_CASE("clearance: edge distances agree with dense sampling", "[hal_sim][clearance]") {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> place{-6.0, 6.0};
  for (int round = 0; round < 40; ++round) {
    for (const Obstacle& o : some_obstacles(random)) {
      const Samples edge = edge_of(o);
      for (int i = 0; i < 5; ++i) {
        const Vec p{place(random), place(random)};
        const double distance_m = edge_distance_m(o, {p});
        const double sampled_m = sampled_edge_distance(edge, p);
        INFO("round " << round << " shape " << static_cast<int>(o.shape));
        CHECK(std::abs(distance_m) <= sampled_m + 1e-9);
        CHECK(std::abs(distance_m) >= sampled_m - edge.gap_m);
        CHECK((distance_m < 0.0) == within(o, p));
        CHECK(edge_distance_bound_m(o, {p}) <= distance_m + 1e-9);
      }
    }
  }
}

TEST_CASE("clearance: hull clearances agree with dense sampling, apart and overlapping",
          "[hal_sim][clearance]") {
  std::mt19937_64 random{11};
  std::uniform_real_distribution<double> place{-3.0, 3.0};
  std::uniform_real_distribution<double> angle{-3.1, 3.1};
  int overlapping = 0;
  int apart = 0;
  for (int round = 0; round < 30; ++round) {
    for (const Obstacle& o : some_obstacles(random)) {
      const VehiclePose pose = pose_at(place(random), place(random), angle(random));
      const Samples edge = edge_of(o);
      double sampled_m = std::numeric_limits<double>::infinity();
      for (const Vec& q : edge.points) {
        sampled_m = std::min(sampled_m, hull_distance(pose, q));
      }
      // As deep as possible: where the obstacle covers some of the hull's middle.
      for (double y_m = -0.42; y_m <= 0.42; y_m += 0.02) {
        if (within(o, pose.to_world({{0.0, y_m}}).xy_m)) {
          sampled_m = std::min(sampled_m, -kHull.beam_m / 2.0);
        }
      }
      const double clearance_m = hull_clearance_m(o, pose, kHull);
      INFO("round " << round << " shape " << static_cast<int>(o.shape));
      CHECK(clearance_m <= sampled_m + 1e-9);
      CHECK(clearance_m >= sampled_m - edge.gap_m - 0.02);
      (clearance_m < 0.0 ? overlapping : apart) += 1;
    }
  }
  CHECK(overlapping > 20);
  CHECK(apart > 20);
}

TEST_CASE("clearance: circles, by hand", "[hal_sim][clearance]") {
  const Obstacle circle = ellipse(0.0, 10.0, 0.5, 0.5, 0.0);
  CHECK(edge_distance_m(circle, {{0.0, 0.0}}) == Approx(9.5));
  CHECK(edge_distance_m(circle, {{0.0, 10.0}}) == Approx(-0.5));
  CHECK(edge_distance_m(circle, {{0.3, 10.0}}) == Approx(-0.2));
  CHECK(hull_clearance_m(circle, pose_at(0.0, 0.0, 0.0), kHull) == Approx(9.5 - 1.02));
  CHECK(hull_clearance_m(circle, pose_at(0.0, 0.0, to_rad(90.0)), kHull) == Approx(9.5 - 0.6));
  CHECK(hull_clearance_m(circle, pose_at(0.0, 10.0, 0.7), kHull) == Approx(-0.6));
  // Off a corner: the distance along the diagonal.
  CHECK(hull_clearance_m(circle, pose_at(-3.6, 10.0 - 5.02, 0.0), kHull) == Approx(4.5));
}

TEST_CASE("clearance: ellipses on their axes and in their centre", "[hal_sim][clearance]") {
  const Obstacle lying = ellipse(0.0, 0.0, 3.0, 0.3, to_rad(90.0));  // along x
  CHECK(edge_distance_m(lying, {{5.0, 0.0}}) == Approx(2.0));
  CHECK(edge_distance_m(lying, {{0.0, 1.3}}) == Approx(1.0));
  CHECK(edge_distance_m(lying, {{0.0, 0.0}}) == Approx(-0.3));
  CHECK(edge_distance_m(lying, {{3.0, 0.0}}) == Approx(0.0).margin(1e-12));
  CHECK(edge_distance_m(lying, {{2.999, 1e-300}}) == Approx(-0.001));
  const Obstacle thin = ellipse(0.0, 0.0, 1e4, 1e-3, 0.0);
  CHECK(edge_distance_m(thin, {{2.0, 5.0}}) == Approx(1.999));
  CHECK(hull_clearance_m(thin, pose_at(2.0, 5.0, 0.0), kHull) == Approx(1.399));
}

TEST_CASE("clearance: a wall across the hull is as deep as it goes", "[hal_sim][clearance]") {
  const VehiclePose pose = pose_at(0.0, 0.0, 0.0);
  const auto across = wall(ObstacleShape::kPolyline, {{-5.0, 0.9}, {5.0, 0.9}});
  CHECK(hull_clearance_m(across, pose, kHull) == Approx(-0.12));
  const auto bow = wall(ObstacleShape::kPolyline, {{-5.0, 1.52}, {5.0, 1.52}});
  CHECK(hull_clearance_m(bow, pose, kHull) == Approx(0.5));
  const auto probe = wall(ObstacleShape::kPolyline, {{0.4, 0.0}, {5.0, 0.0}});
  CHECK(hull_clearance_m(probe, pose, kHull) == Approx(-0.2));
  const auto around =
      wall(ObstacleShape::kPolygon, {{-9.0, -9.0}, {9.0, -9.0}, {9.0, 9.0}, {-9.0, 9.0}});
  CHECK(hull_clearance_m(around, pose, kHull) == Approx(-0.6));
  CHECK(edge_distance_m(around, {{1.0, 0.0}}) == Approx(-8.0));
  const auto point = wall(ObstacleShape::kPolyline, {{0.0, 3.0}, {0.0, 3.0}});
  CHECK(edge_distance_m(point, {{0.0, 0.0}}) == Approx(3.0));
  CHECK(hull_clearance_m(point, pose, kHull) == Approx(1.98));
}

}  // namespace
}  // namespace lodesman
