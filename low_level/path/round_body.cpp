// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/round_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "low_level/path/plane.h"

namespace lodesman {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

std::array<PointPx, kMaxCorners> make_directions() noexcept {
  std::array<PointPx, kMaxCorners> directions{};
  for (std::uint32_t k = 0; k < kMaxCorners; ++k) {
    const double angle = kTurn * k / kMaxCorners;
    directions[k] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}
const std::array<PointPx, kMaxCorners> kDirectionOf = make_directions();

double corner_radius(std::uint32_t corners) noexcept {
  return 1.0 / std::cos(std::numbers::pi / corners);
}

// The sides that a point sees, as the polygon's first and last corner of them; none where the
// first is the last.
struct Seen {
  int first;
  int last;
};

// `at` in the frame of the unit circle, where side k touches it at angle (k + 1/2) step and corner
// k lies at angle k step.
Seen sides_seen_from(PointPx at, double step) noexcept {
  const double angle = std::atan2(at.row, at.column);
  const double distance = length_of(at);
  const double half = distance > 1.0 ? std::acos(1.0 / distance) : 0.0;
  const double first = std::floor((angle - half) / step - 0.5) + 1.0;
  const double last = std::ceil((angle + half) / step - 0.5);
  if (first < last) {
    return {static_cast<int>(first), static_cast<int>(last)};
  }
  const int nearest = static_cast<int>(std::floor(angle / step + 0.5));
  return {nearest, nearest};
}

}  // namespace

RoundBody::RoundBody(const EllipsePx& ellipse) noexcept : centre_{ellipse.centre} {
  const double a = ellipse.a + kClearancePx;
  const double b = ellipse.b + kClearancePx;
  first_ = {a * ellipse.cos_theta, a * ellipse.sin_theta};
  second_ = {-b * ellipse.sin_theta, b * ellipse.cos_theta};
  to_first_ = {ellipse.cos_theta / a, ellipse.sin_theta / a};
  to_second_ = {-ellipse.sin_theta / b, ellipse.cos_theta / b};
  const double longer = std::max(a, b);
  corners_ = kMinCorners;
  while (corners_ < kMaxCorners && longer * (corner_radius(corners_) - 1.0) > kOvershootPx) {
    corners_ *= 2;
  }
  corner_radius_ = corner_radius(corners_);
  reach_px_ = longer * corner_radius_;
}

PointPx RoundBody::corner(std::uint32_t k) const noexcept {
  const PointPx at = corner_radius_ * kDirectionOf[k * (kMaxCorners / corners_)];
  return centre_ + at.column * first_ + at.row * second_;
}

Tangents RoundBody::tangents_from(PointPx point) const noexcept {
  const Seen seen = sides_seen_from(unit(point), kTurn / corners_);
  const std::uint32_t mask = corners_ - 1;  // a power of two less one: takes numbers round
  return {static_cast<std::uint32_t>(seen.last) & mask,
          static_cast<std::uint32_t>(seen.first) & mask};
}

bool RoundBody::holds(PointPx point) const noexcept {
  const Seen seen = sides_seen_from(unit(point), kTurn / corners_);
  return seen.first == seen.last;
}

PointPx RoundBody::unit(PointPx point) const noexcept {
  const PointPx d = point - centre_;
  return {dot(d, to_first_), dot(d, to_second_)};
}

}  // namespace lodesman
