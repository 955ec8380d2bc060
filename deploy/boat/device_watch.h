// SPDX-License-Identifier: Apache-2.0
// Says in the log, once a change, what ails the devices, what becomes of the thrusters' arming and
// what the guard does;
// and once, what time it is by the receiver and by this machine, which may have no clock.
// The main thread of lodesman-low.
#pragma once

#include <array>
#include <string>

#include "deploy/boat/configuration.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

class DeviceWatch {
 public:
  DeviceWatch(const Blackboard& board, const DeviceAddresses& addresses);

  void say_news(Time now);

 private:
  struct Told {
    DeviceStatus status = DeviceStatus::kAwaited;
    DeviceFault fault = DeviceFault::kNone;
  };

  void look_at(DeviceId id, Time now);
  void look_at_arming();
  void look_at_guard();
  void look_at_clock();

  std::array<std::string, kDeviceCount> addresses_;
  std::array<Reader<DeviceHealth>, kDeviceCount> devices_;
  std::array<Told, kDeviceCount> told_{};
  Reader<ThrustStatus> arming_;
  Reader<BatteryStatus> battery_;
  Reader<GuardStatus> guard_;
  Reader<PositionFix> fixes_;
  bool has_told_utc_ = false;
  ThrustState told_state_ = ThrustState::kDisarmed;
  std::uint64_t told_trips_ = 0;
  GuardState told_guard_ = GuardState::kIdle;
  BatteryLevel told_level_ = BatteryLevel::kUnknown;
};

}  // namespace lodesman
