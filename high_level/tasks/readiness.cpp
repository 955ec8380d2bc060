// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/readiness.h"

#include <cstdio>

namespace lodesman {

Readiness::Readiness(const Blackboard& board)
    : attitude_{board.attitude},
      state_{board.vehicle_state},
      obstacles_{board.sonar_obstacles},
      thrust_{board.thrust_applied},
      devices_{Reader<DeviceHealth>{board.device_health[0]},
               Reader<DeviceHealth>{board.device_health[1]},
               Reader<DeviceHealth>{board.device_health[2]},
               Reader<DeviceHealth>{board.device_health[3]}} {}

std::string Readiness::lacking(const char* what, DeviceId id, Time now) {
  const auto* health = device(id);
  std::string text = std::string{"no "} + what;
  if (health == nullptr || health->value.status == DeviceStatus::kWorking) {
    return text;
  }
  char since[32];
  std::snprintf(since, sizeof since, "%.1f s", to_seconds(now - health->value.since));
  return text + ": its device is " + to_string(health->value.status) + " for " + since;
}

std::vector<std::string> Readiness::reasons(Time now) {
  std::vector<std::string> reasons;
  const auto* thrust = thrust_.fresh(now, max_age::kThrustApplied);
  if (thrust == nullptr) {
    reasons.emplace_back("the low level is silent");
  } else if (thrust->value.reason == ThrustReason::kDeviceFailed) {
    reasons.push_back(lacking("thrusters", DeviceId::kThrusters, now));
  }
  if (attitude_.fresh(now, max_age::kAttitude) == nullptr) {
    reasons.push_back(lacking("heading", DeviceId::kHeading, now));
  }
  if (state_.fresh(now, max_age::kVehicleState) == nullptr) {
    reasons.push_back(lacking("position", DeviceId::kPosition, now));
  }
  if (obstacles_.fresh(now, max_age::kSonarFrame) == nullptr) {
    reasons.push_back(lacking("sonar frame", DeviceId::kSonar, now));
  }
  return reasons;
}

}  // namespace lodesman
