// SPDX-License-Identifier: Apache-2.0
// A device's health on its channel. Part of the task that owns the device.
#pragma once

#include "drivers/hal/device_health.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

class DeviceReport {
 public:
  DeviceReport(Blackboard& board, Role role, DeviceId device, Duration silence_limit)
      : keeper_{silence_limit},
        writer_{writer_of(board, board.device_health[static_cast<std::size_t>(device)], role)} {}

  [[nodiscard]] DeviceHealthKeeper& keeper() noexcept { return keeper_; }
  // Once a step, after what the device brought was counted.
  void publish(Time now) noexcept {
    if (keeper_.due(now)) {
      writer_.publish(keeper_.health(), now);
    }
  }
  [[nodiscard]] std::uint64_t refused() const noexcept { return keeper_.health().refused; }

 private:
  DeviceHealthKeeper keeper_;
  Writer<DeviceHealth> writer_;
};

}  // namespace lodesman
