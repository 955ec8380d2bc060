// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/echo.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;
constexpr double kMiss = std::numeric_limits<double>::infinity();

[[nodiscard]] double ellipse_range(const Obstacle& o, const Vec& from, const Vec& direction) {
  const Vec first{std::sin(o.angle_rad), std::cos(o.angle_rad)};
  const Vec second{first.y(), -first.x()};
  const Vec offset = from - Vec{o.centre_x_m, o.centre_y_m};
  // In the frame that makes the ellipse a unit circle: |p + t d| = 1.
  const Vec p{first.dot(offset) / o.semi_axis_first_m, second.dot(offset) / o.semi_axis_second_m};
  const Vec d{first.dot(direction) / o.semi_axis_first_m,
              second.dot(direction) / o.semi_axis_second_m};
  const double a = d.squaredNorm();
  const double b = p.dot(d);
  // b^2 - a (p^2 - 1), written so that nothing cancels when the ellipse is far away.
  const double cross = p.x() * d.y() - p.y() * d.x();
  const double root2 = a - cross * cross;
  if (root2 < 0.0) {
    return kMiss;
  }
  const double root = std::sqrt(root2);
  const double near = (-b - root) / a;
  const double far = (-b + root) / a;
  return near >= 0.0 ? near : far >= 0.0 ? far : kMiss;
}

[[nodiscard]] double side_range(const Vec& a, const Vec& b, const Vec& from, const Vec& direction) {
  const Vec side = b - a;
  const Vec offset = a - from;
  const double parallel = direction.x() * side.y() - direction.y() * side.x();
  const double range = (offset.x() * side.y() - offset.y() * side.x()) / parallel;
  const double share = (offset.x() * direction.y() - offset.y() * direction.x()) / parallel;
  // False for a side along the ray, too: a wall seen end on gives no echo.
  return range >= 0.0 && share >= 0.0 && share <= 1.0 && std::isfinite(range) ? range : kMiss;
}

}  // namespace

double ray_range_m(const Obstacle& obstacle, const WorldPoint& from_W,
                   const Vec& direction_W) noexcept {
  if (obstacle.shape == ObstacleShape::kEllipse) {
    return ellipse_range(obstacle, from_W.xy_m, direction_W);
  }
  double nearest = kMiss;
  const auto vertex = [&](std::uint32_t i) noexcept {
    return Vec{obstacle.vertices[i].x_m, obstacle.vertices[i].y_m};
  };
  for (std::uint32_t i = 0; i + 1 < obstacle.vertex_count; ++i) {
    nearest = std::min(nearest, side_range(vertex(i), vertex(i + 1), from_W.xy_m, direction_W));
  }
  if (obstacle.shape == ObstacleShape::kPolygon && obstacle.vertex_count > 1) {
    nearest = std::min(nearest, side_range(vertex(obstacle.vertex_count - 1), vertex(0),
                                           from_W.xy_m, direction_W));
  }
  return nearest;
}

}  // namespace lodesman
