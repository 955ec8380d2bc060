// SPDX-License-Identifier: Apache-2.0
// The AHRS and position tasks: publish what the devices say, each sample once, but for what is not
// sane, and how the devices are. Each is stepped by its runner's thread.
#pragma once

#include "drivers/hal/devices.h"
#include "low_level/tasks/device_report.h"
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

class PositionTask final : public Task {
 public:
  // Without a sensor there are no fixes, and that is said.
  PositionTask(Blackboard& board, Role role, PositionSensor* sensor)
      : sensor_{sensor},
        fixes_{writer_of(board, board.position_fix, role)},
        device_{board, role, DeviceId::kPosition, max_age::kPositionFix} {}
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override { return device_.refused(); }

 private:
  PositionSensor* sensor_;
  Writer<PositionFix> fixes_;
  DeviceReport device_;
};

}  // namespace lodesman
