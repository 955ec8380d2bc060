// SPDX-License-Identifier: Apache-2.0
// The AHRS and position tasks: publish what the devices say, each sample once,
// but for what is not sane. Each is stepped by
// its runner's thread.
#pragma once

#include "drivers/hal/devices.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

class AhrsTask final : public Task {
 public:
  AhrsTask(Blackboard& board, Role role, HeadingSensor& sensor)
      : sensor_{sensor}, attitudes_{writer_of(board, board.attitude, role)} {}
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override { return refused_; }

 private:
  HeadingSensor& sensor_;
  Writer<Attitude> attitudes_;
  std::uint64_t refused_ = 0;
};

class PositionTask final : public Task {
 public:
  PositionTask(Blackboard& board, Role role, PositionSensor& sensor)
      : sensor_{sensor}, fixes_{writer_of(board, board.position_fix, role)} {}
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override { return refused_; }

 private:
  PositionSensor& sensor_;
  Writer<PositionFix> fixes_;
  std::uint64_t refused_ = 0;
};

}  // namespace lodesman
