// SPDX-License-Identifier: Apache-2.0
// Keeps count of what a device brings, and says when that is to be told. Owned by the one task that
// owns the device; it is handed the time and never blocks.
#pragma once

#include "drivers/hal/devices.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/health.h"

namespace lodesman {

class DeviceHealthKeeper {
 public:
  static constexpr Duration kTellPeriod = std::chrono::seconds{1};

  // silence_limit: nothing for longer than this is silence.
  explicit DeviceHealthKeeper(Duration silence_limit) noexcept : silence_limit_{silence_limit} {}

  // The configuration has no such device.
  void absent(Time now) noexcept { become(DeviceStatus::kAbsent, now); }
  // What one poll brought; `sane`: whether a fresh sample could be believed.
  void polled(ReadStatus status, bool sane, Time now) noexcept;
  // What became of a command. One that is not taken is no news of the device.
  void commanded(CommandStatus status, Time now) noexcept;
  // What it says ails it.
  void ails(DeviceFault fault) noexcept {
    changed_ |= health_.fault != fault;
    health_.fault = fault;
  }

  // Whether there is something to tell: a new status, or a second has gone by. Asked once a step.
  [[nodiscard]] bool due(Time now) noexcept;
  [[nodiscard]] const DeviceHealth& health() const noexcept { return health_; }

 private:
  void become(DeviceStatus status, Time now) noexcept;

  Duration silence_limit_;
  DeviceHealth health_;
  Time heard_{};
  Time told_{};
  bool changed_ = true;
};

}  // namespace lodesman
