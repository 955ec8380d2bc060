// SPDX-License-Identifier: Apache-2.0
// A leg of a mission, from one of its waypoints to the next: how far along it a place lies, and how
// far off. Pure functions with bounded work and no allocation; any thread.
#pragma once

#include <Eigen/Core>

namespace lodesman {

struct Leg {
  Eigen::Vector2d from_W = Eigen::Vector2d::Zero();  // [m] [world]
  Eigen::Vector2d to_W = Eigen::Vector2d::Zero();    // [m] [world]

  [[nodiscard]] double length_m() const noexcept { return (to_W - from_W).norm(); }
  // [m] Along the leg to the place abeam of a point, in [0, length_m()].
  [[nodiscard]] double along_m(const Eigen::Vector2d& point_W) const noexcept;
  // The place so far along it [m] [world].
  [[nodiscard]] Eigen::Vector2d at(double along_m) const noexcept;
  // [m] From the leg's line to a point, positive to starboard of it; of a leg without length the
  // distance.
  [[nodiscard]] double cross_track_m(const Eigen::Vector2d& point_W) const noexcept;
};

}  // namespace lodesman
