// SPDX-License-Identifier: Apache-2.0
// Vectors of the pixel plane: columns to the right, rows downwards, so that a turn from +column to
// +row, which looks clockwise in the view, has a positive cross product. Pure functions; any
// thread.
#pragma once

#include <cmath>

#include "low_level/path/zone.h"

namespace lodesman {

[[nodiscard]] constexpr PointPx operator+(PointPx a, PointPx b) noexcept {
  return {a.column + b.column, a.row + b.row};
}
[[nodiscard]] constexpr PointPx operator-(PointPx a, PointPx b) noexcept {
  return {a.column - b.column, a.row - b.row};
}
[[nodiscard]] constexpr PointPx operator*(double factor, PointPx a) noexcept {
  return {factor * a.column, factor * a.row};
}
[[nodiscard]] constexpr double dot(PointPx a, PointPx b) noexcept {
  return a.column * b.column + a.row * b.row;
}
[[nodiscard]] constexpr double cross(PointPx a, PointPx b) noexcept {
  return a.column * b.row - a.row * b.column;
}
[[nodiscard]] inline double length_of(PointPx a) noexcept { return std::sqrt(dot(a, a)); }

}  // namespace lodesman
