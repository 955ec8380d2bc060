// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/readiness.h"

#include <cstdio>
#include <utility>

#include "high_level/tasks/thrust_desk.h"

namespace lodesman {
namespace {

// Pings that come and show nothing: not even what was seen before goes on to be looked at.
[[nodiscard]] bool shows_nothing(DeviceFault fault) noexcept {
  return fault == DeviceFault::kSaturated || fault == DeviceFault::kFrozen ||
         fault == DeviceFault::kDeaf;
}

}  // namespace

Readiness::Readiness(const Blackboard& board, bool arms_by_itself)
    : arms_by_itself_{arms_by_itself},
      attitude_{board.attitude},
      state_{board.vehicle_state},
      obstacles_{board.sonar_obstacles},
      thrust_{board.thrust_applied},
      arming_{board.thrust_status},
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
  add_thrust(reasons, now);
  if (attitude_.fresh(now, max_age::kAttitude) == nullptr) {
    reasons.push_back(lacking("heading", DeviceId::kHeading, now));
  }
  if (state_.fresh(now, max_age::kVehicleState) == nullptr) {
    reasons.push_back(lacking("position", DeviceId::kPosition, now));
  }
  add_sonar(reasons, now);
  return reasons;
}

std::vector<std::string> Readiness::warnings() {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < kDeviceCount; ++i) {
    const auto id = static_cast<DeviceId>(i);
    const auto* health = device(id);
    if (health != nullptr && health->value.status == DeviceStatus::kWorking &&
        health->value.fault != DeviceFault::kNone) {
      warnings.push_back(std::string{to_string(id)} + ": " + describe(health->value.fault));
    }
  }
  return warnings;
}

// It shows nothing from when that is known on, though its last frame may be fresh for a while.
void Readiness::add_sonar(std::vector<std::string>& reasons, Time now) {
  const auto* health = device(DeviceId::kSonar);
  if (health != nullptr && health->value.status == DeviceStatus::kWorking &&
      shows_nothing(health->value.fault)) {
    reasons.push_back(std::string{"the sonar shows nothing of the water: "} +
                      describe(health->value.fault));
  } else if (obstacles_.fresh(now, max_age::kSonarFrame) == nullptr) {
    reasons.push_back(lacking("sonar frame", DeviceId::kSonar, now));
  }
}

// A boat that has no thrusters sails dry: that is no reason.
void Readiness::add_thrust(std::vector<std::string>& reasons, Time now) {
  const auto* thrust = thrust_.fresh(now, max_age::kThrustApplied);
  const auto* arming = arming_.fresh(now, max_age::kThrustStatus);
  if (thrust == nullptr || arming == nullptr) {
    reasons.emplace_back("the low level is silent");
    return;
  }
  if (thrust->value.reason == ThrustReason::kNoThrusters) {
    return;
  }
  std::uint32_t objections = arming->value.objections;
  if ((objections & bit(ArmObjection::kBoxGone)) != 0) {
    reasons.push_back(lacking("thrusters", DeviceId::kThrusters, now));
    objections &= ~bit(ArmObjection::kBoxGone);
  }
  const ThrustState state = arming->value.state;
  if (state == ThrustState::kArmed || state == ThrustState::kManual) {
    objections &= bit(ArmObjection::kBoxNotReady);  // the others are for arming
  } else if (state == ThrustState::kDisarmed && !arms_by_itself_) {
    reasons.emplace_back("the thrusters are disarmed (lodesman arm)");
  }
  const auto* box = device(DeviceId::kThrusters);
  for (std::string& words : in_words(objections, box != nullptr ? &box->value : nullptr)) {
    reasons.push_back(std::move(words));
  }
}

}  // namespace lodesman
