// SPDX-License-Identifier: Apache-2.0
// A disc or an ellipse that a path may lead round, as the polygon of tangents that stands in for
// its edge, and the tangents to that polygon. Plain values and pure functions; any thread.
#pragma once

#include <cstdint>

#include "low_level/path/zone.h"

namespace lodesman {

// The polygon's sides touch the shape grown by kClearancePx, so that a path along them is clear of
// the shape whatever the rounding.
inline constexpr double kClearancePx = 1e-3;
// The polygon has the fewest corners, a power of two, that stand out by no more than
// kOvershootPx, except that even the largest shapes get no more than kMaxCorners. Going round
// n corners is tan(pi/n) / (pi/n) times as long as the edge: 1.3 % at 16, 0.08 % at 64.
inline constexpr double kOvershootPx = 0.02;
inline constexpr std::uint32_t kMinCorners = 16;
inline constexpr std::uint32_t kMaxCorners = 256;

// Where a path from a point meets the polygon so that it can go round it.
struct Tangents {
  std::uint32_t up = 0;    // the corner from which it goes on to corners of higher number
  std::uint32_t down = 0;  // and to lower
};

class RoundBody {
 public:
  RoundBody() = default;
  explicit RoundBody(const EllipsePx& ellipse) noexcept;

  // Corners are numbered from 0 in the sense from +column to +row, round and round.
  [[nodiscard]] std::uint32_t corner_count() const noexcept { return corners_; }
  [[nodiscard]] PointPx corner(std::uint32_t k) const noexcept;

  [[nodiscard]] PointPx centre() const noexcept { return centre_; }
  // From the centre to the farthest corner or more.
  [[nodiscard]] double reach_px() const noexcept { return reach_px_; }

  // From a point in the polygon both are the corner nearest to it in angle. Between a shape and a
  // corner of its polygon the way to that corner is clear.
  [[nodiscard]] Tangents tangents_from(PointPx point) const noexcept;
  [[nodiscard]] bool holds(PointPx point) const noexcept;  // in the polygon

 private:
  [[nodiscard]] PointPx unit(PointPx point) const noexcept;

  PointPx centre_;
  PointPx first_;     // the semi-axes as vectors
  PointPx second_;    //
  PointPx to_first_;  // and their inverse: what takes the grown shape to the unit circle
  PointPx to_second_;
  double reach_px_ = 0.0;
  double corner_radius_ = 0.0;  // of the corners where the shape is the unit circle
  std::uint32_t corners_ = 0;
};

}  // namespace lodesman
