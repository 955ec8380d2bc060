// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "hal_sim/scenario/limits.h"
#include "hal_sim/scenario/scenario.h"

namespace lodesman {
namespace {

constexpr double kMaxSize_m = 1e4;
constexpr double kMinSize_m = 1e-3;  // smaller than any pixel, large enough to divide by
constexpr double kMaxTime_s = 1e5;
constexpr double kCourseTolerance_m = 0.01;

const Range kCoordinate = Range::between(-kMaxCoordinate_m, kMaxCoordinate_m);
const Range kSize = Range::between(kMinSize_m, kMaxSize_m);

enum class FileShape : std::uint8_t { kCircle, kEllipse, kPolyline, kPolygon };

void read_centre(const TomlTable& table, Obstacle& obstacle) {
  const auto centre = table.pair("centre_m", kCoordinate);
  obstacle.shape = ObstacleShape::kEllipse;
  obstacle.centre_x_m = centre[0];
  obstacle.centre_y_m = centre[1];
}

void read_circle(const TomlTable& table, Obstacle& obstacle) {
  read_centre(table, obstacle);
  const double radius_m = table.number("radius_m", kSize);
  const double protection_m = table.number("protection_m", kSize);
  if (protection_m < radius_m) {
    table.refuse("protection_m", "is smaller than the obstacle");
  }
  obstacle.semi_axis_first_m = obstacle.semi_axis_second_m = radius_m;
  obstacle.protection_first_m = obstacle.protection_second_m = protection_m;
}

void read_ellipse(const TomlTable& table, Obstacle& obstacle) {
  read_centre(table, obstacle);
  const auto axes = table.pair("semi_axes_m", kSize);
  const auto protection = table.pair("protection_semi_axes_m", kSize);
  if (protection[0] < axes[0] || protection[1] < axes[1]) {
    table.refuse("protection_semi_axes_m", "is smaller than the obstacle");
  }
  obstacle.semi_axis_first_m = axes[0];
  obstacle.semi_axis_second_m = axes[1];
  obstacle.protection_first_m = protection[0];
  obstacle.protection_second_m = protection[1];
  obstacle.angle_rad = wrap_to_pi(to_rad(table.number("angle_deg", Range::between(-360.0, 360.0))));
}

void read_wall(const TomlTable& table, ObstacleShape shape, Obstacle& obstacle) {
  const std::size_t fewest = shape == ObstacleShape::kPolygon ? 3 : 2;
  const auto points = table.pairs("points_m", kCoordinate, fewest, kMaxVertices);
  obstacle.shape = shape;
  for (const auto& point : points) {
    obstacle.vertices[obstacle.vertex_count++] = {point[0], point[1]};
  }
  // Of a wall the zone is measured from its line, so that none is smaller than its obstacle.
  obstacle.protection_first_m = obstacle.protection_second_m =
      table.number("protection_m", Range::between(0.0, kMaxSize_m));
}

// What moves along the course: the centre, or a wall's first vertex.
[[nodiscard]] Eigen::Vector2d reference_point_m(const Obstacle& obstacle) {
  return obstacle.shape == ObstacleShape::kEllipse
             ? Eigen::Vector2d{obstacle.centre_x_m, obstacle.centre_y_m}
             : Eigen::Vector2d{obstacle.vertices[0].x_m, obstacle.vertices[0].y_m};
}

void read_course(const TomlTable& table, MovingObstacle& mover) {
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();
  if (table.has("velocity_m_s")) {
    const auto pair = table.pair("velocity_m_s", Range::between(-kMaxSpeed_m_s, kMaxSpeed_m_s));
    velocity_m_s = {pair[0], pair[1]};
  }
  mover.velocity_x_m_s = velocity_m_s.x();
  mover.velocity_y_m_s = velocity_m_s.y();
  if (table.has("stop_at_m")) {
    const auto pair = table.pair("stop_at_m", kCoordinate);
    const double speed_m_s = velocity_m_s.norm();
    if (!(speed_m_s > 0.0)) {
      table.refuse("stop_at_m", "needs a velocity_m_s");
    }
    const Eigen::Vector2d way_m =
        Eigen::Vector2d{pair[0], pair[1]} - reference_point_m(mover.at_start);
    const Eigen::Vector2d along = velocity_m_s / speed_m_s;
    const double ahead_m = along.dot(way_m);
    const double aside_m = along.x() * way_m.y() - along.y() * way_m.x();
    if (!(ahead_m > 0.0) || std::abs(aside_m) > kCourseTolerance_m) {
      table.refuse("stop_at_m", "is off the course");
    }
    mover.stops_at_s = ahead_m / speed_m_s;
  }
  mover.appears_at_s = table.number_or("start_s", Range::between(0.0, kMaxTime_s), 0.0);
  mover.vanishes_at_s =
      table.number_or("end_s", Range::between(0.0, kMaxTime_s), mover.vanishes_at_s);
  if (mover.vanishes_at_s <= mover.appears_at_s) {
    table.refuse("end_s", "must be after start_s");
  }
}

}  // namespace

std::vector<MovingObstacle> read_obstacles(const TomlTable& root) {
  std::vector<MovingObstacle> obstacles;
  for (const TomlTable& table : root.tables("obstacle", kMaxObstacles)) {
    MovingObstacle mover;
    mover.at_start.id = static_cast<std::uint32_t>(obstacles.size() + 1);
    switch (static_cast<FileShape>(
        table.choice("shape", {"circle", "ellipse", "polyline", "polygon"}))) {
      case FileShape::kCircle: read_circle(table, mover.at_start); break;
      case FileShape::kEllipse: read_ellipse(table, mover.at_start); break;
      case FileShape::kPolyline: read_wall(table, ObstacleShape::kPolyline, mover.at_start); break;
      case FileShape::kPolygon: read_wall(table, ObstacleShape::kPolygon, mover.at_start); break;
    }
    read_course(table, mover);
    obstacles.push_back(mover);
  }
  return obstacles;
}

}  // namespace lodesman
