// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "low_level/path/plane.h"
#include "mid_level/geometry/sonar_view.h"

namespace lodesman {
namespace {

// Squared distance from the origin to a segment. Where the foot lies inside the segment it comes
// from the cross product, which stays exact for long segments.
double distance_squared(PointPx from, PointPx to) noexcept {
  const PointPx along = to - from;
  const double ahead = -dot(from, along);
  const double squared = dot(along, along);
  if (ahead <= 0.0) {
    return dot(from, from);
  }
  if (ahead >= squared) {
    return dot(to, to);
  }
  const double off = cross(from, along);
  return off * off / squared;
}

double distance_squared(PointPx point, PointPx from, PointPx to) noexcept {
  return distance_squared(from - point, to - point);
}

bool cross_each_other(PointPx a, PointPx b, PointPx c, PointPx d) noexcept {
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  return ((c_side < 0.0) != (d_side < 0.0)) && ((a_side < 0.0) != (b_side < 0.0));
}

bool encloses(const WallPx& wall, PointPx point) noexcept {
  int winding = 0;
  for (std::uint32_t i = 0; wall.closed && i < wall.edge_count(); ++i) {
    const CapsulePx edge = wall.edge(i);
    const bool from_above = edge.from.row <= point.row;
    const bool to_above = edge.to.row <= point.row;
    if (from_above != to_above) {
      const double side = cross(edge.to - edge.from, point - edge.from);
      winding += from_above && side <= 0.0 ? 1 : 0;
      winding -= to_above && side >= 0.0 ? 1 : 0;
    }
  }
  return winding != 0;
}

BoxPx box_round(PointPx centre, double columns, double rows) noexcept {
  // What rounding may take from a half-extent.
  constexpr double kSlack = 1.0 + 1e-9;
  const PointPx half{columns * kSlack, rows * kSlack};
  return {centre - half, centre + half};
}

BoxPx box_of(const EllipsePx& e) noexcept {
  if (!(e.a > 0.0 && e.b > 0.0)) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    return {{kNan, kNan}, {kNan, kNan}};
  }
  return box_round(e.centre, std::hypot(e.a * e.cos_theta, e.b * e.sin_theta),
                   std::hypot(e.a * e.sin_theta, e.b * e.cos_theta));
}

BoxPx box_of(const WallPx& wall) noexcept {
  BoxPx box = box_of(wall.edge(0));
  for (std::uint32_t i = 1; i < wall.edge_count(); ++i) {
    const BoxPx next = box_of(wall.edge(i));
    box.low = {std::min(next.low.column, box.low.column), std::min(next.low.row, box.low.row)};
    box.high = {std::max(next.high.column, box.high.column), std::max(next.high.row, box.high.row)};
  }
  return box;
}

}  // namespace

bool touches(const EllipsePx& ellipse, PointPx from, PointPx to) noexcept {
  // In the frame where the ellipse is the unit circle.
  const auto unit = [&ellipse](PointPx point) {
    const PointPx d = point - ellipse.centre;
    return PointPx{(d.column * ellipse.cos_theta + d.row * ellipse.sin_theta) / ellipse.a,
                   (d.row * ellipse.cos_theta - d.column * ellipse.sin_theta) / ellipse.b};
  };
  return distance_squared(unit(from), unit(to)) <= 1.0;
}

bool touches(const CapsulePx& capsule, PointPx from, PointPx to) noexcept {
  const double nearest =
      std::min({distance_squared(from, capsule.from, capsule.to),
                distance_squared(to, capsule.from, capsule.to),
                distance_squared(capsule.from, from, to), distance_squared(capsule.to, from, to)});
  return nearest <= capsule.radius * capsule.radius ||
         cross_each_other(from, to, capsule.from, capsule.to);
}

bool touches(const WallPx& wall, PointPx from, PointPx to) noexcept {
  const BoxPx box = box_of(from, to);
  for (std::uint32_t i = 0; i < wall.edge_count(); ++i) {
    const CapsulePx edge = wall.edge(i);
    if (box_of(edge).meets(box) && touches(edge, from, to)) {
      return true;
    }
  }
  return encloses(wall, from);
}

bool touches(const ZonePx& zone, PointPx from, PointPx to) noexcept {
  return std::visit([from, to](const auto& shape) { return touches(shape, from, to); }, zone);
}

bool touches(const ZonePx& zone, PointPx point) noexcept { return touches(zone, point, point); }

BoxPx box_of(PointPx from, PointPx to) noexcept {
  return {{std::min(from.column, to.column), std::min(from.row, to.row)},
          {std::max(from.column, to.column), std::max(from.row, to.row)}};
}

BoxPx box_of(const CapsulePx& capsule) noexcept {
  const BoxPx line = box_of(capsule.from, capsule.to);
  const BoxPx round = box_round({}, capsule.radius, capsule.radius);
  return {line.low + round.low, line.high + round.high};
}

BoxPx box_of(const ZonePx& zone) noexcept {
  return std::visit([](const auto& shape) { return box_of(shape); }, zone);
}

RegionPx RegionPx::fan() noexcept {
  RegionPx region;
  region.centre_ = {kApexColumn, kApexRow};
  region.radius_px_ = kFanRadiusPx;
  const double sine = std::sqrt(3.0) / 2.0;  // of the sides' 60 degrees
  region.sides_[0] = {region.centre_, {0.5, sine}};
  region.sides_[1] = {region.centre_, {-0.5, sine}};
  region.side_count_ = 2;
  return region;
}

RegionPx RegionPx::rectangle(PointPx low, PointPx high) noexcept {
  RegionPx region;
  region.centre_ = 0.5 * (low + high);
  region.radius_px_ = length_of(high - low);
  region.sides_ = {
      {{low, {-1.0, 0.0}}, {low, {0.0, -1.0}}, {high, {1.0, 0.0}}, {high, {0.0, 1.0}}}};
  region.side_count_ = 4;
  return region;
}

bool RegionPx::contains(PointPx point) const noexcept {
  const PointPx from_centre = point - centre_;
  bool inside = dot(from_centre, from_centre) <= radius_px_ * radius_px_;
  for (std::uint32_t i = 0; i < side_count_; ++i) {
    inside = inside && dot(point - sides_[i].on, sides_[i].outward) <= 0.0;
  }
  return inside;
}

}  // namespace lodesman
