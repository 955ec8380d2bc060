// SPDX-License-Identifier: Apache-2.0
// An obstacle and its protection zone: the paper's circles, the ellipses of its section 5, and
// walls. Plain data for the blackboard; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mid_level/messages/fields.h"

namespace lodesman {

inline constexpr std::size_t kMaxVertices = 32;
inline constexpr std::size_t kMaxObstacles = 64;

enum class ObstacleShape : std::uint8_t {
  kEllipse,   // centre, two semi-axes, angle; a circle has two equal semi-axes
  kPolyline,  // a wall through its vertices
  kPolygon,   // a closed wall and what it encloses
};
[[nodiscard]] constexpr auto enumerators(ObstacleShape) noexcept {
  return enumerators_to<ObstacleShape::kPolygon>("ellipse", "polyline", "polygon");
}

struct Vertex {
  double x_m = 0.0;  // [m] in the frame of the obstacle's message
  double y_m = 0.0;  // [m]

  static constexpr auto fields() noexcept {
    return field_list(field("x_m", &Vertex::x_m), field("y_m", &Vertex::y_m));
  }
};

struct Obstacle {
  std::uint32_t id = 0;  // [-] of a known obstacle or a track; 0: none
  ObstacleShape shape = ObstacleShape::kEllipse;
  // Ellipse: its centre. Walls: unused.
  double centre_x_m = 0.0;  // [m]
  double centre_y_m = 0.0;  // [m]
  // Ellipse: first and second semi-axis, and the first one's direction clockwise from +y.
  double semi_axis_first_m = 0.0;   // [m] > 0
  double semi_axis_second_m = 0.0;  // [m] > 0
  double angle_rad = 0.0;           // [rad] [-pi, pi]
  // The protection zone. Ellipse: the same centre and angle, these semi-axes. Walls: every point
  // within protection_first_m of the wall (and what a polygon encloses).
  double protection_first_m = 0.0;   // [m] >= the obstacle's own
  double protection_second_m = 0.0;  // [m]
  double peak = 0.0;                 // [-] [0, 255] brightest echo in it; 0 for a known obstacle
  std::uint32_t vertex_count = 0;    // [-] walls: [2, kMaxVertices]
  std::array<Vertex, kMaxVertices> vertices{};

  // An ellipse has an extent; a wall has a side.
  [[nodiscard]] bool fits() const noexcept {
    return shape == ObstacleShape::kEllipse ? semi_axis_first_m > 0.0 && semi_axis_second_m > 0.0
                                            : vertex_count >= 2;
  }

  static constexpr auto fields() noexcept {
    using O = Obstacle;
    return field_list(field("id", &O::id), field("shape", &O::shape),
                      field("centre_x_m", &O::centre_x_m), field("centre_y_m", &O::centre_y_m),
                      field("semi_axis_first_m", &O::semi_axis_first_m).within(0.0, 1e6),
                      field("semi_axis_second_m", &O::semi_axis_second_m).within(0.0, 1e6),
                      field("angle_rad", &O::angle_rad).within(-kHalfTurn_rad, kHalfTurn_rad),
                      field("protection_first_m", &O::protection_first_m).within(0.0, 1e6),
                      field("protection_second_m", &O::protection_second_m).within(0.0, 1e6),
                      field("peak", &O::peak).within(0.0, 255.0),
                      field("vertex_count", &O::vertex_count),
                      field("vertices", &O::vertices, &O::vertex_count));
  }
};

}  // namespace lodesman
