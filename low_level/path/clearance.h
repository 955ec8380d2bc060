// SPDX-License-Identifier: Apache-2.0
// Whether a point or a segment touches a protection zone or leaves a region, worked out from the
// shapes themselves and not from pixels. Plain values and pure functions; any thread.
#pragma once

#include <array>
#include <cstdint>

#include "low_level/path/zone.h"

namespace lodesman {

// Zones are closed: what only touches a zone's edge is not clear of it. The answers are those of
// the equations in double precision, whose rounding is below 1e-9 px for shapes of the view's size.
[[nodiscard]] bool touches(const EllipsePx& ellipse, PointPx from, PointPx to) noexcept;
[[nodiscard]] bool touches(const CapsulePx& capsule, PointPx from, PointPx to) noexcept;
[[nodiscard]] bool touches(const WallPx& wall, PointPx from, PointPx to) noexcept;
[[nodiscard]] bool touches(const ZonePx& zone, PointPx from, PointPx to) noexcept;
[[nodiscard]] bool touches(const ZonePx& zone, PointPx point) noexcept;

// An upright box, edges included. It need not be the smallest one.
struct BoxPx {
  PointPx low;
  PointPx high;

  [[nodiscard]] bool meets(const BoxPx& other) const noexcept {
    return low.column <= other.high.column && other.low.column <= high.column &&
           low.row <= other.high.row && other.low.row <= high.row;
  }
};
[[nodiscard]] BoxPx box_of(PointPx from, PointPx to) noexcept;
[[nodiscard]] BoxPx box_of(const CapsulePx& capsule) noexcept;
// All of it is not a number where the zone's numbers cannot be drawn.
[[nodiscard]] BoxPx box_of(const ZonePx& zone) noexcept;

// Where a path may lie: in a disc and on the inner side of some lines, borders included. It is
// convex, so a segment lies in it if its ends do.
class RegionPx {
 public:
  // The fan of the sonar view (sonar_view.h), its two straight sides and its arc.
  [[nodiscard]] static RegionPx fan() noexcept;
  [[nodiscard]] static RegionPx rectangle(PointPx low, PointPx high) noexcept;

  // False of what is not a number.
  [[nodiscard]] bool contains(PointPx point) const noexcept;

 private:
  struct Side {
    PointPx on;       // a point of the line
    PointPx outward;  // its normal
  };
  std::array<Side, 4> sides_{};
  std::uint32_t side_count_ = 0;
  PointPx centre_;
  double radius_px_ = 0.0;
};

}  // namespace lodesman
