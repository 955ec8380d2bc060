// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/echo.h"

#include <algorithm>
#include <cmath>

#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;
constexpr double kMiss = std::numeric_limits<double>::infinity();

// The axes of an ellipse, and a ray in the frame that makes it a unit circle: |p + t d| = 1.
struct RayOfCircle {
  RayOfCircle(const Obstacle& o, const Vec& from, const Vec& direction) noexcept
      : first{std::sin(o.angle_rad), std::cos(o.angle_rad)}, second{first.y(), -first.x()} {
    const Vec offset = from - Vec{o.centre_x_m, o.centre_y_m};
    p = {first.dot(offset) / o.semi_axis_first_m, second.dot(offset) / o.semi_axis_second_m};
    d = {first.dot(direction) / o.semi_axis_first_m, second.dot(direction) / o.semi_axis_second_m};
    const double a = d.squaredNorm();
    const double b = p.dot(d);
    // b^2 - a (p^2 - 1), written so that nothing cancels when the ellipse is far away.
    const double cross = p.x() * d.y() - p.y() * d.x();
    const double root2 = a - cross * cross;
    if (root2 < 0.0) {
      return;
    }
    const double root = std::sqrt(root2);
    near = (-b - root) / a;
    far = (-b + root) / a;
  }
  [[nodiscard]] double range_m() const noexcept {
    return near >= 0.0 ? near : far >= 0.0 ? far : kMiss;
  }

  Vec first;
  Vec second;
  Vec p;
  Vec d;
  double near = -1.0;  // [m] both negative: it is missed, or lies behind
  double far = -1.0;
};

[[nodiscard]] double side_range(const Vec& a, const Vec& b, const Vec& from, const Vec& direction) {
  const Vec side = b - a;
  const Vec offset = a - from;
  const double parallel = direction.x() * side.y() - direction.y() * side.x();
  const double range = (offset.x() * side.y() - offset.y() * side.x()) / parallel;
  const double share = (offset.x() * direction.y() - offset.y() * direction.x()) / parallel;
  // False for a side along the ray, too: a wall seen end on gives no echo.
  return range >= 0.0 && share >= 0.0 && share <= 1.0 && std::isfinite(range) ? range : kMiss;
}

[[nodiscard]] SurfaceHit ellipse_hit(const Obstacle& o, const Vec& from, const Vec& direction) {
  const RayOfCircle ray{o, from, direction};
  SurfaceHit hit;
  hit.range_m = ray.range_m();
  if (!std::isfinite(hit.range_m)) {
    return hit;
  }
  hit.leaves_m = ray.far;
  const Vec on_circle = ray.p + hit.range_m * ray.d;
  const Vec normal = on_circle.x() / o.semi_axis_first_m * ray.first +
                     on_circle.y() / o.semi_axis_second_m * ray.second;
  hit.cos_incidence = std::abs(normal.dot(direction)) / normal.norm();
  hit.along_m =
      std::atan2(on_circle.y(), on_circle.x()) * 0.5 * (o.semi_axis_first_m + o.semi_axis_second_m);
  return hit;
}

}  // namespace

double ray_range_m(const Obstacle& obstacle, const WorldPoint& from_W,
                   const Vec& direction_W) noexcept {
  if (obstacle.shape == ObstacleShape::kEllipse) {
    return RayOfCircle{obstacle, from_W.xy_m, direction_W}.range_m();
  }
  double nearest = kMiss;
  for_each_side(obstacle, [&](const Vec& a, const Vec& b) noexcept {
    nearest = std::min(nearest, side_range(a, b, from_W.xy_m, direction_W));
  });
  return nearest;
}

SurfaceHit surface_hit(const Obstacle& obstacle, const WorldPoint& from_W,
                       const Vec& direction_W) noexcept {
  if (obstacle.shape == ObstacleShape::kEllipse) {
    return ellipse_hit(obstacle, from_W.xy_m, direction_W);
  }
  SurfaceHit hit;
  double passed_m = 0.0;
  for_each_side(obstacle, [&](const Vec& a, const Vec& b) noexcept {
    const double range_m = side_range(a, b, from_W.xy_m, direction_W);
    const Vec side = b - a;
    const double length_m = side.norm();
    if (range_m < hit.range_m) {
      hit.range_m = hit.leaves_m = range_m;
      hit.cos_incidence =
          std::abs(side.x() * direction_W.y() - side.y() * direction_W.x()) / length_m;
      hit.along_m = passed_m + (from_W.xy_m + range_m * direction_W - a).norm();
    }
    passed_m += length_m;
  });
  return hit;
}

}  // namespace lodesman
