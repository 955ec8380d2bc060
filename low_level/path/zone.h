// SPDX-License-Identifier: Apache-2.0
// The protection zones of obstacles as shapes in the pixel plane of the sonar view, and the exact
// test of a pixel against each. Plain values and pure functions; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "mid_level/geometry/sonar_view.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

// A point of the pixel plane: a pixel's centre has whole numbers, and rows grow downwards.
struct PointPx {
  double column = 0.0;  // [px]
  double row = 0.0;     // [px]
};

// Inside where (u/a)^2 + (v/b)^2 <= 1, u along the first axis and v across it.
struct EllipsePx {
  PointPx centre;
  double a = 0.0;          // [px] > 0
  double b = 0.0;          // [px] > 0
  double cos_theta = 1.0;  // theta: the first axis, from +column towards +row
  double sin_theta = 0.0;

  [[nodiscard]] static EllipsePx with_angle(PointPx centre, double a, double b,
                                            double theta_rad) noexcept;
  [[nodiscard]] bool contains(int column, int row) const noexcept;
};

// Every point within a radius of a line from one point to another.
struct CapsulePx {
  PointPx from;
  PointPx to;
  double radius = 0.0;  // [px] >= 0

  [[nodiscard]] bool contains(int column, int row) const noexcept;
};

// Every point within a radius of a line through the vertices; closed: also from the last vertex
// to the first, and all that the line goes round. Where the line crosses itself, a point counts
// as enclosed if the line winds round it at all: more is closed to the boat, never less.
struct WallPx {
  std::array<PointPx, kMaxVertices> vertices{};
  std::uint32_t vertex_count = 0;  // [-] [1, kMaxVertices]
  double radius = 0.0;             // [px] >= 0
  bool closed = false;

  // A single vertex is one edge without length, that is, a disc.
  [[nodiscard]] std::uint32_t edge_count() const noexcept;
  [[nodiscard]] CapsulePx edge(std::uint32_t i) const noexcept;
  [[nodiscard]] bool encloses(int column, int row) const noexcept;
  [[nodiscard]] bool contains(int column, int row) const noexcept;
};

// Where an edge of a closed wall crosses the line of a row's pixel centres, and whether it does so
// upwards (-1) or downwards (+1) in the view. Nothing where it does not.
struct Crossing {
  double column = 0.0;  // [px]
  int winding = 0;
};
[[nodiscard]] std::optional<Crossing> crossing_of(const CapsulePx& edge, int row) noexcept;

using ZonePx = std::variant<EllipsePx, WallPx>;

// No wall is drawn thinner than this, half a pixel: a thinner one could pass between the centres
// of neighbouring pixels, and a path through it.
inline constexpr double kMinWallRadiusPx = 0.5;

// The zone of an obstacle given in the vehicle frame. Nothing where the obstacle cannot be drawn:
// a number that is not finite, a semi-axis not above zero, no vertex, an unknown shape.
[[nodiscard]] std::optional<ZonePx> zone_of(const Obstacle& obstacle,
                                            const SonarView& view) noexcept;

}  // namespace lodesman
