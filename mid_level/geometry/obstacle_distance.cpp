// SPDX-License-Identifier: Apache-2.0
#include "mid_level/geometry/obstacle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr int kNewtonSteps_max = 100;

// The nearest point of an ellipse (x/a)^2 + (y/b)^2 = 1, a >= b, to a point of the first quadrant
// is (a^2 x / (s + a^2 - b^2), b^2 y / s), where s > 0 solves
// (a x / (s + a^2 - b^2))^2 + (b y / s)^2 = 1. The left side falls and is convex in s, so that
// Newton's steps from the left never overshoot.
[[nodiscard]] Vec nearest_on_ellipse(double a, double b, const Vec& p) noexcept {
  const double gap = (a - b) * (a + b);
  // On the long axis between the evolute's cusps the equation has no root with s > 0.
  if (p.y() <= 0.0) {
    if (a * p.x() < gap) {
      const double x = a * a * p.x() / gap;
      const double share = x / a;
      return {x, b * std::sqrt(std::max(0.0, 1.0 - share * share))};
    }
    return {a, 0.0};
  }
  // At each of these one of the two terms is 1 already: both lie left of the root.
  double s = std::max(b * p.y(), a * p.x() - gap);
  for (int i = 0; i < kNewtonSteps_max; ++i) {
    const double first = a * p.x() / (s + gap);
    const double second = b * p.y() / s;
    const double excess = first * first + second * second - 1.0;
    const double slope = -2.0 * (first * first / (s + gap) + second * second / s);
    const double step = -excess / slope;
    s += std::max(step, 0.0);
    if (step <= 1e-15 * s) {
      break;
    }
  }
  return {a * a * p.x() / (s + gap), b * b * p.y() / s};
}

// From p to the ellipse with these semi-axes along x and y, negative inside.
[[nodiscard]] double ellipse_distance(double along_x, double along_y, const Vec& p) noexcept {
  Vec q = p.cwiseAbs();
  double a = along_x;
  double b = along_y;
  if (a < b) {
    std::swap(a, b);
    std::swap(q.x(), q.y());
  }
  const double distance = (q - nearest_on_ellipse(a, b, q)).norm();
  const double x = q.x() / a;
  const double y = q.y() / b;
  return x * x + y * y < 1.0 ? -distance : distance;
}

[[nodiscard]] double wall_distance(const Obstacle& wall, const Vec& p) noexcept {
  double nearest = std::numeric_limits<double>::infinity();
  for_each_side(wall, [&](const Vec& a, const Vec& b) {
    nearest = std::min(nearest, segment_distance_m(a, b, p));
  });
  return wall.shape == ObstacleShape::kPolygon && encloses(wall, p) ? -nearest : nearest;
}

}  // namespace

double segment_distance_m(const Vec& a, const Vec& b, const Vec& p) noexcept {
  const Vec way = b - a;
  const double length2 = way.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp(way.dot(p - a) / length2, 0.0, 1.0) : 0.0;
  return (p - (a + share * way)).norm();
}

// Whether a ray from p crosses an odd number of sides.
bool encloses(const Obstacle& polygon, const Vec& p) noexcept {
  bool inside = false;
  for_each_side(polygon, [&](const Vec& a, const Vec& b) {
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) {
      inside = !inside;
    }
  });
  return inside;
}

double edge_distance_m(const Obstacle& obstacle, const WorldPoint& p_W) noexcept {
  if (obstacle.shape != ObstacleShape::kEllipse) {
    return wall_distance(obstacle, p_W.xy_m);
  }
  const Vec offset = p_W.xy_m - Vec{obstacle.centre_x_m, obstacle.centre_y_m};
  const Vec along = first_axis(obstacle.angle_rad);
  const Vec in_axes{along.dot(offset), along.x() * offset.y() - along.y() * offset.x()};
  return ellipse_distance(obstacle.semi_axis_first_m, obstacle.semi_axis_second_m, in_axes);
}

double edge_distance_bound_m(const Obstacle& obstacle, const WorldPoint& p_W) noexcept {
  if (obstacle.shape != ObstacleShape::kEllipse) {
    return -std::numeric_limits<double>::infinity();  // walls are quick anyway
  }
  const Vec offset = p_W.xy_m - Vec{obstacle.centre_x_m, obstacle.centre_y_m};
  return offset.norm() - std::max(obstacle.semi_axis_first_m, obstacle.semi_axis_second_m);
}

}  // namespace lodesman
