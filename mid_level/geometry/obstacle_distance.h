// SPDX-License-Identifier: Apache-2.0
// How far a point is from an obstacle, exactly and signed. Pure functions with bounded work and no
// allocation; any thread.
#pragma once

#include "mid_level/base/frames.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

// From a point to the obstacle's edge, negative inside. A polyline has no inside. Both in the same
// frame, which need not be the world's.
[[nodiscard]] double edge_distance_m(const Obstacle& obstacle, const WorldPoint& p_W) noexcept;

// Never more than the distance from the point to the obstacle's edge, and quick to compute.
[[nodiscard]] double edge_distance_bound_m(const Obstacle& obstacle,
                                           const WorldPoint& p_W) noexcept;

// From a point to a side of a wall.
[[nodiscard]] double segment_distance_m(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                        const Eigen::Vector2d& p) noexcept;

// Whether a polygon holds a point (even-odd).
[[nodiscard]] bool encloses(const Obstacle& polygon, const Eigen::Vector2d& p) noexcept;

// Direction of an ellipse's first semi-axis.
[[nodiscard]] inline Eigen::Vector2d first_axis(double angle_rad) noexcept {
  return {std::sin(angle_rad), std::cos(angle_rad)};
}

// Calls visit(a, b) for each side of a wall: one fewer than vertices for a polyline.
template <class Visit>
void for_each_side(const Obstacle& wall, Visit visit) noexcept {
  const auto vertex = [&wall](std::uint32_t i) {
    return Eigen::Vector2d{wall.vertices[i].x_m, wall.vertices[i].y_m};
  };
  for (std::uint32_t i = 0; i + 1 < wall.vertex_count; ++i) {
    visit(vertex(i), vertex(i + 1));
  }
  if (wall.shape == ObstacleShape::kPolygon && wall.vertex_count > 1) {
    visit(vertex(wall.vertex_count - 1), vertex(0));
  }
}

}  // namespace lodesman
