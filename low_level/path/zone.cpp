// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/zone.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

bool is_finite(PointPx point) noexcept {
  return std::isfinite(point.column) && std::isfinite(point.row);
}

PointPx point_of(double x_m, double y_m, const SonarView& view) noexcept {
  return {view.column_of(x_m), view.row_of(y_m)};
}

std::optional<ZonePx> ellipse_of(const Obstacle& obstacle, const SonarView& view) noexcept {
  EllipsePx ellipse;
  ellipse.centre = point_of(obstacle.centre_x_m, obstacle.centre_y_m, view);
  ellipse.a = obstacle.protection_first_m / view.metres_per_pixel();
  ellipse.b = obstacle.protection_second_m / view.metres_per_pixel();
  if (ellipse.a < ellipse.b || ellipse.b < ellipse.a) {
    // The obstacle's angle runs clockwise from straight ahead, and ahead is -row: its first axis
    // points sin(angle) to starboard and cos(angle) up the view, so theta = angle - pi/2.
    ellipse.cos_theta = std::sin(obstacle.angle_rad);
    ellipse.sin_theta = -std::cos(obstacle.angle_rad);
  }  // else a circle: without rotation it is drawn as symmetric as it is
  const bool drawable = is_finite(ellipse.centre) && std::isfinite(obstacle.angle_rad) &&
                        std::isfinite(ellipse.a) && std::isfinite(ellipse.b) && ellipse.a > 0.0 &&
                        ellipse.b > 0.0;
  return drawable ? std::optional<ZonePx>{ellipse} : std::nullopt;
}

std::optional<ZonePx> wall_of(const Obstacle& obstacle, const SonarView& view) noexcept {
  WallPx wall;
  wall.vertex_count = std::min(obstacle.vertex_count, std::uint32_t{kMaxVertices});
  wall.radius = std::max(obstacle.protection_first_m / view.metres_per_pixel(), kMinWallRadiusPx);
  wall.closed = obstacle.shape == ObstacleShape::kPolygon;
  bool drawable = wall.vertex_count > 0 && std::isfinite(obstacle.protection_first_m) &&
                  std::isfinite(wall.radius);
  for (std::uint32_t i = 0; i < wall.vertex_count; ++i) {
    wall.vertices[i] = point_of(obstacle.vertices[i].x_m, obstacle.vertices[i].y_m, view);
    drawable = drawable && is_finite(wall.vertices[i]);
  }
  return drawable ? std::optional<ZonePx>{wall} : std::nullopt;
}

}  // namespace

EllipsePx EllipsePx::with_angle(PointPx centre, double a, double b, double theta_rad) noexcept {
  return {centre, a, b, std::cos(theta_rad), std::sin(theta_rad)};
}

bool EllipsePx::contains(int column, int row) const noexcept {
  const double dx = column - centre.column;
  const double dy = row - centre.row;
  const double u = (dx * cos_theta + dy * sin_theta) / a;
  const double v = (-dx * sin_theta + dy * cos_theta) / b;
  return u * u + v * v <= 1.0;
}

bool CapsulePx::contains(int column, int row) const noexcept {
  const double along_x = to.column - from.column;
  const double along_y = to.row - from.row;
  const double dx = column - from.column;
  const double dy = row - from.row;
  const double length_squared = along_x * along_x + along_y * along_y;
  const double nearest = length_squared > 0.0
                             ? std::clamp((dx * along_x + dy * along_y) / length_squared, 0.0, 1.0)
                             : 0.0;
  const double off_x = dx - nearest * along_x;
  const double off_y = dy - nearest * along_y;
  return off_x * off_x + off_y * off_y <= radius * radius;
}

std::uint32_t WallPx::edge_count() const noexcept {
  return closed || vertex_count < 2 ? vertex_count : vertex_count - 1;
}

CapsulePx WallPx::edge(std::uint32_t i) const noexcept {
  const std::uint32_t next = i + 1 < vertex_count ? i + 1 : 0;
  return {vertices[i], vertices[next], radius};
}

bool WallPx::encloses(int column, int row) const noexcept {
  if (!closed) {
    return false;
  }
  int winding = 0;
  for (std::uint32_t i = 0; i < edge_count(); ++i) {
    const std::optional<Crossing> crossing = crossing_of(edge(i), row);
    if (crossing && crossing->column <= column) {
      winding += crossing->winding;
    }
  }
  return winding != 0;
}

bool WallPx::contains(int column, int row) const noexcept {
  for (std::uint32_t i = 0; i < edge_count(); ++i) {
    if (edge(i).contains(column, row)) {
      return true;
    }
  }
  return encloses(column, row);
}

std::optional<Crossing> crossing_of(const CapsulePx& edge, int row) noexcept {
  const bool from_above = edge.from.row <= row;
  const bool to_above = edge.to.row <= row;
  if (from_above == to_above) {
    return std::nullopt;
  }
  const double share = (row - edge.from.row) / (edge.to.row - edge.from.row);
  return Crossing{edge.from.column + share * (edge.to.column - edge.from.column),
                  from_above ? 1 : -1};
}

std::optional<ZonePx> zone_of(const Obstacle& obstacle, const SonarView& view) noexcept {
  switch (obstacle.shape) {
    case ObstacleShape::kEllipse: return ellipse_of(obstacle, view);
    case ObstacleShape::kPolyline:
    case ObstacleShape::kPolygon: return wall_of(obstacle, view);
  }
  return std::nullopt;
}

}  // namespace lodesman
