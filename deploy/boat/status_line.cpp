// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/status_line.h"

namespace lodesman {

LowStatusLine::LowStatusLine(const Blackboard& board)
    : thrust_{board.thrust_status},
      devices_{Reader<DeviceHealth>{board.device_health[0]},
               Reader<DeviceHealth>{board.device_health[1]},
               Reader<DeviceHealth>{board.device_health[2]},
               Reader<DeviceHealth>{board.device_health[3]}} {}

std::string LowStatusLine::text() {
  const auto* thrust = thrust_.latest();
  std::string line = "thrusters ";
  line += thrust != nullptr ? to_string(thrust->value.state) : "unknown";
  const char* between = "; ";
  for (std::size_t i = 0; i < kDeviceCount; ++i) {
    const auto* newest = devices_[i].latest();
    if (newest == nullptr) {
      continue;
    }
    line += between;
    line += to_string(static_cast<DeviceId>(i));
    line += std::string{" "} + to_string(newest->value.status);
    if (newest->value.fault != DeviceFault::kNone) {
      line += std::string{" ("} + to_string(newest->value.fault) + ")";
    }
    between = ", ";
  }
  return line;
}

HighStatusLine::HighStatusLine(const Blackboard& board) : mission_{board.mission_status} {}

std::string HighStatusLine::text(bool low_is_alive) {
  const auto* mission = mission_.latest();
  std::string line = "mission ";
  line += mission != nullptr ? to_string(mission->value.state) : "unknown";
  if (mission != nullptr && mission->value.cause != MissionCause::kOrder) {
    line += std::string{" ("} + to_string(mission->value.cause) + ")";
  }
  return low_is_alive ? line : line + "; neutral: lodesman-low is gone";
}

}  // namespace lodesman
