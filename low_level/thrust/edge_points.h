// SPDX-License-Identifier: Apache-2.0
// The edges of obstacles near the boat, as points close enough together that no hull slips between
// them. Pure; bounded work; no allocation; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "mid_level/messages/sonar.h"

namespace lodesman {

struct EdgePoint {
  double x_m = 0.0;            // [m] in the frame of the obstacles
  double y_m = 0.0;            // [m]
  std::uint32_t obstacle = 0;  // [-] index in the list
};

class EdgePoints {
 public:
  static constexpr std::size_t kMaxPoints = 1024;
  static constexpr double kSpacing_m = 0.1;  // a hull's corner enters a wall by half of it unseen

  // Points of the edges within reach_m of the origin. Where there are more than there is room for,
  // those within half of the reach, and so on: what is nearest is always kept.
  void take(const SonarObstacles& seen, double reach_m) noexcept;

  [[nodiscard]] std::span<const EdgePoint> points() const noexcept {
    return std::span{points_}.first(count_);
  }

 private:
  void add(const Obstacle& obstacle) noexcept;
  void add_side(const EdgePoint& a, const EdgePoint& b) noexcept;
  void add_arc(const Obstacle& ellipse, double from_rad, double to_rad) noexcept;
  void add_point(const EdgePoint& point) noexcept;

  std::array<EdgePoint, kMaxPoints> points_{};
  std::size_t count_ = 0;
  std::uint32_t obstacle_ = 0;  // at hand
  double reach_m_ = 0.0;
  bool is_full_ = false;
};

}  // namespace lodesman
