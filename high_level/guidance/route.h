// SPDX-License-Identifier: Apache-2.0
// A way to go: a line through points of the world. Plain values and pure functions; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mid_level/base/frames.h"

namespace lodesman {

struct Route {
  static constexpr std::size_t kMaxPoints = 600;

  std::array<Eigen::Vector2d, kMaxPoints> points{};  // [m] [world]
  std::uint32_t count = 0;                           // [-] [0, kMaxPoints]

  void clear() noexcept { count = 0; }
  // False, and nothing added, when it is full.
  bool add(const Eigen::Vector2d& point) noexcept {
    if (count == kMaxPoints) {
      return false;
    }
    points[count++] = point;
    return true;
  }
  [[nodiscard]] bool empty() const noexcept { return count == 0; }
  [[nodiscard]] const Eigen::Vector2d& end() const noexcept { return points[count - 1]; }
  [[nodiscard]] double length_m() const noexcept;
};

// A place on a route: on the leg from point `leg` to the next, a share of it along.
struct RoutePlace {
  std::uint32_t leg = 0;
  double share = 0.0;  // [0, 1]
};

// The nearest place, not before `from` and on no leg that begins more than within_m beyond it.
[[nodiscard]] RoutePlace nearest_place(const Route& route, const Eigen::Vector2d& point,
                                       RoutePlace from, double within_m) noexcept;
[[nodiscard]] Eigen::Vector2d point_at(const Route& route, RoutePlace place) noexcept;
// So far along the route from a place; its end where the route ends before.
[[nodiscard]] Eigen::Vector2d point_ahead(const Route& route, RoutePlace place,
                                          double ahead_m) noexcept;
[[nodiscard]] double remaining_m(const Route& route, RoutePlace place) noexcept;

}  // namespace lodesman
