// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace lodesman::cli {
namespace {

constexpr int kCorners = 72;  // a side every 5 degrees: round at every size a picture has

// The first semi-axis points `angle_rad` clockwise from +y.
Line ellipse(Point centre, double first, double second, double angle_rad) {
  const double sine = std::sin(angle_rad);
  const double cosine = std::cos(angle_rad);
  Line line;
  for (int i = 0; i <= kCorners; ++i) {
    const double turn_rad = 2.0 * std::numbers::pi * (i % kCorners) / kCorners;
    const double along = first * std::cos(turn_rad);
    const double across = second * std::sin(turn_rad);
    line.push_back(
        {centre[0] + along * sine + across * cosine, centre[1] + along * cosine - across * sine});
  }
  return line;
}

Line band(Point a, Point b, double half_width) {
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  if (length <= 0.0) {
    return {};
  }
  const double x = -(b[1] - a[1]) / length * half_width;
  const double y = (b[0] - a[0]) / length * half_width;
  return {{a[0] + x, a[1] + y},
          {b[0] + x, b[1] + y},
          {b[0] - x, b[1] - y},
          {a[0] - x, a[1] - y},
          {a[0] + x, a[1] + y}};
}

}  // namespace

Line circle(Point centre, double radius) { return ellipse(centre, radius, radius, 0.0); }

Line outline(const Obstacle& obstacle) {
  if (obstacle.shape == ObstacleShape::kEllipse) {
    return ellipse({obstacle.centre_x_m, obstacle.centre_y_m}, obstacle.semi_axis_first_m,
                   obstacle.semi_axis_second_m, obstacle.angle_rad);
  }
  Line line;
  const std::size_t count = std::min<std::size_t>(obstacle.vertex_count, kMaxVertices);
  for (std::size_t i = 0; i < count; ++i) {
    line.push_back({obstacle.vertices[i].x_m, obstacle.vertices[i].y_m});
  }
  if (obstacle.shape == ObstacleShape::kPolygon && !line.empty()) {
    const Point first = line.front();
    line.push_back(first);
  }
  return line;
}

bool has_zone(const Obstacle& obstacle) {
  if (obstacle.shape == ObstacleShape::kEllipse) {
    return obstacle.protection_first_m > obstacle.semi_axis_first_m ||
           obstacle.protection_second_m > obstacle.semi_axis_second_m;
  }
  return obstacle.protection_first_m > 0.0;
}

std::vector<Line> zone_shapes(const Obstacle& obstacle) {
  if (!has_zone(obstacle)) {
    return {};
  }
  if (obstacle.shape == ObstacleShape::kEllipse) {
    return {ellipse({obstacle.centre_x_m, obstacle.centre_y_m}, obstacle.protection_first_m,
                    obstacle.protection_second_m, obstacle.angle_rad)};
  }
  std::vector<Line> shapes;
  const Line wall = outline(obstacle);
  for (std::size_t i = 0; i < wall.size(); ++i) {
    shapes.push_back(circle(wall[i], obstacle.protection_first_m));
    if (i > 0) {
      shapes.push_back(band(wall[i - 1], wall[i], obstacle.protection_first_m));
    }
  }
  if (obstacle.shape == ObstacleShape::kPolygon) {
    shapes.push_back(wall);
  }
  return shapes;
}

}  // namespace lodesman::cli
