// SPDX-License-Identifier: Apache-2.0
// The poses of the last seconds, so that what was seen can be put where the vehicle was when it was
// seen. Owned by one thread; no allocation.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "mid_level/base/frames.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

class PoseHistory {
 public:
  void add(const VehicleState& state) noexcept;
  // Interpolated, in the world; empty when `at` lies outside what is remembered (but for 0.1 s
  // after the newest, which counts as the newest).
  [[nodiscard]] std::optional<VehiclePose> at(Time at) const noexcept;
  // The same in the odometry frame, which no fix ever moves.
  [[nodiscard]] std::optional<VehiclePose> odometry_at(Time at) const noexcept;
  // [m] From the odometry frame to the world, by the newest estimate; nought without one.
  [[nodiscard]] Eigen::Vector2d world_from_odometry_m() const noexcept;

 private:
  struct Poses {
    VehiclePose world;
    VehiclePose odometry;
  };
  [[nodiscard]] std::optional<Poses> poses_at(Time at) const noexcept;

  static constexpr std::size_t kSize = 160;  // two seconds and more, with a step every 14 ms
  std::array<VehicleState, kSize> ring_{};
  std::size_t count_ = 0;  // ever added
};

}  // namespace lodesman
