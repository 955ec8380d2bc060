// SPDX-License-Identifier: Apache-2.0
// The AHRS and position tasks: publish what the devices say, each sample once, but for what is not
// sane, and how the devices are. Each is stepped by its runner's thread.
#pragma once

#include <limits>
#include <optional>

#include "drivers/hal/devices.h"
#include "low_level/tasks/device_report.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

class AhrsTask final : public Task {
 public:
  // turn_rad: [-pi, pi] clockwise, of the sensor's own ahead from the vehicle's.
  AhrsTask(Blackboard& board, Role role, HeadingSensor& sensor, double turn_rad = 0.0)
      : sensor_{sensor},
        turn_rad_{turn_rad},
        attitudes_{writer_of(board, board.attitude, role)},
        device_{board, role, DeviceId::kHeading, max_age::kAttitude} {}
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override { return device_.refused(); }

 private:
  HeadingSensor& sensor_;
  double turn_rad_;
  Writer<Attitude> attitudes_;
  DeviceReport device_;
};

struct PositionTaskOptions {
  std::optional<GeoPoint> origin{};  // of the world; empty: as the blackboard says, in time
  // [m] > 0 no fix farther from it is used: it is another's, or the origin is. Until the origin is
  // known there is no limit.
  double far_max_m = std::numeric_limits<double>::infinity();
};

class PositionTask final : public Task {
 public:
  // A place that repeats itself to the last digit for so long, by fixes made while the thrusters
  // were driven, is told of as frozen: its receiver's own speed may be frozen with it, so that its
  // driver sees nothing. The fixes are given nevertheless, for a boat may be held at a quay; the
  // estimator, which knows how far the boat should have come, believes them or not.
  static constexpr Duration kFrozenFor = std::chrono::seconds{10};
  static constexpr int kDrivingSurgeRef = 10;

  // Without a sensor there are no fixes, and that is said.
  PositionTask(Blackboard& board, Role role, PositionSensor* sensor,
               const PositionTaskOptions& options = {})
      : sensor_{sensor},
        options_{options},
        fixes_{writer_of(board, board.position_fix, role)},
        origin_{board.world_origin},
        thrust_{board.thrust_applied},
        device_{board, role, DeviceId::kPosition, max_age::kPositionFix} {}
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override {
    return device_.refused() + refused_by(origin_, thrust_);
  }

 private:
  [[nodiscard]] bool is_near(const PositionFix& fix) noexcept;
  void look_for_frozen(const PositionFix& fix, Time now) noexcept;

  PositionSensor* sensor_;
  PositionTaskOptions options_;
  bool is_far_ = false;  // by the last fix that it was asked of
  Writer<PositionFix> fixes_;
  Reader<WorldOrigin> origin_;
  Reader<ThrustApplied> thrust_;
  GeoPoint place_;     // of the last fix
  Time same_since_{};  // [ns] of the first of those in a row there, made under thrust
  bool is_frozen_ = false;
  DeviceReport device_;
};

}  // namespace lodesman
