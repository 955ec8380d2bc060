// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/edge_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodesman {
namespace {

constexpr int kReachHalvings_max = 6;
constexpr int kFirstArcs = 8;  // of an ellipse; each bends by 45 degrees of its parameter
// An arc of the largest ellipse that a message may hold, 1000 km, is halved to less than a metre;
// what a sonar can show, 350 m, to the spacing.
constexpr int kArcHalvings_max = 20;

[[nodiscard]] EdgePoint on_ellipse(const Obstacle& ellipse, double parameter_rad) noexcept {
  const double along_m = ellipse.semi_axis_first_m * std::cos(parameter_rad);
  const double across_m = ellipse.semi_axis_second_m * std::sin(parameter_rad);
  const double sine = std::sin(ellipse.angle_rad);
  const double cosine = std::cos(ellipse.angle_rad);
  return {ellipse.centre_x_m + along_m * sine + across_m * cosine,
          ellipse.centre_y_m + along_m * cosine - across_m * sine};
}

// The part of a segment nearest to the origin, as a share of its length.
[[nodiscard]] double nearest_share(const EdgePoint& a, const EdgePoint& b) noexcept {
  const double dx_m = b.x_m - a.x_m;
  const double dy_m = b.y_m - a.y_m;
  const double squared = dx_m * dx_m + dy_m * dy_m;
  return squared > 0.0 ? std::clamp(-(a.x_m * dx_m + a.y_m * dy_m) / squared, 0.0, 1.0) : 0.0;
}

[[nodiscard]] EdgePoint between(const EdgePoint& a, const EdgePoint& b, double share) noexcept {
  return {std::lerp(a.x_m, b.x_m, share), std::lerp(a.y_m, b.y_m, share)};
}

[[nodiscard]] double range_m(const EdgePoint& p) noexcept { return std::hypot(p.x_m, p.y_m); }

}  // namespace

void EdgePoints::take(const SonarObstacles& seen, double reach_m) noexcept {
  reach_m_ = reach_m;
  for (int i = 0; i <= kReachHalvings_max; ++i) {
    count_ = 0;
    is_full_ = false;
    const std::uint32_t count = std::min<std::uint32_t>(seen.count, kMaxObstacles);
    for (obstacle_ = 0; obstacle_ < count; ++obstacle_) {
      add(seen.obstacles[obstacle_]);
    }
    if (!is_full_) {
      return;
    }
    reach_m_ /= 2.0;
  }
}

void EdgePoints::add(const Obstacle& obstacle) noexcept {
  if (obstacle.shape == ObstacleShape::kEllipse) {
    constexpr double kArc_rad = 2.0 * std::numbers::pi / kFirstArcs;
    for (int i = 0; i < kFirstArcs; ++i) {
      add_arc(obstacle, i * kArc_rad, (i + 1) * kArc_rad);
    }
    return;
  }
  const std::uint32_t count = std::min<std::uint32_t>(obstacle.vertex_count, kMaxVertices);
  const auto vertex = [&obstacle](std::uint32_t i) noexcept {
    return EdgePoint{obstacle.vertices[i].x_m, obstacle.vertices[i].y_m};
  };
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    add_side(vertex(i), vertex(i + 1));
  }
  if (obstacle.shape == ObstacleShape::kPolygon && count > 2) {
    add_side(vertex(count - 1), vertex(0));
  }
}

// The part within reach, from its point nearest to the origin to both sides.
void EdgePoints::add_side(const EdgePoint& a, const EdgePoint& b) noexcept {
  const double length_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  const double middle_m = nearest_share(a, b) * length_m;
  const double off_m = range_m(between(a, b, nearest_share(a, b)));
  if (off_m > reach_m_) {
    return;
  }
  const double half_m = std::sqrt(reach_m_ * reach_m_ - off_m * off_m);
  const double from_m = std::max(0.0, middle_m - half_m);
  const double to_m = std::min(length_m, middle_m + half_m);
  const int parts = static_cast<int>(std::ceil((to_m - from_m) / kSpacing_m));
  for (int i = 0; i <= parts && !is_full_; ++i) {
    const double at_m =
        parts > 0 ? std::lerp(from_m, to_m, static_cast<double>(i) / parts) : from_m;
    add_point(between(a, b, length_m > 0.0 ? at_m / length_m : 0.0));
  }
}

// Halved until it is short. An arc that begins at a multiple of its own length bends away from its
// chord by less than the chord is long.
void EdgePoints::add_arc(const Obstacle& ellipse, double from_rad, double to_rad) noexcept {
  struct Arc {
    double from_rad = 0.0;
    double to_rad = 0.0;
    int halvings = kArcHalvings_max;
  };
  std::array<Arc, kArcHalvings_max + 1> waiting{};
  std::size_t count = 0;
  waiting[count++] = {from_rad, to_rad};
  while (count > 0 && !is_full_) {
    const Arc arc = waiting[--count];
    const EdgePoint a = on_ellipse(ellipse, arc.from_rad);
    const EdgePoint b = on_ellipse(ellipse, arc.to_rad);
    const double chord_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    if (range_m(between(a, b, nearest_share(a, b))) - chord_m > reach_m_) {
      continue;
    }
    if (chord_m > kSpacing_m && arc.halvings > 0) {
      const double middle_rad = (arc.from_rad + arc.to_rad) / 2.0;
      waiting[count++] = {middle_rad, arc.to_rad, arc.halvings - 1};
      waiting[count++] = {arc.from_rad, middle_rad, arc.halvings - 1};
    } else if (range_m(a) <= reach_m_) {
      add_point(a);
    }
  }
}

void EdgePoints::add_point(const EdgePoint& point) noexcept {
  if (count_ == points_.size()) {
    is_full_ = true;
    return;
  }
  points_[count_++] = {point.x_m, point.y_m, obstacle_};
}

}  // namespace lodesman
