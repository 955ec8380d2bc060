// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "deploy/operator/console/story.h"

namespace lodesman::console {
namespace {

// What an alarm is told to.
class AlarmList {
 public:
  // A need of the mode that the boat is in is critical where it is not met; otherwise a warning.
  void need(bool met, bool needed, const char* what) {
    if (!met) {
      tell(needed ? Severity::kCritical : Severity::kWarning, what);
    }
  }
  void tell(Severity severity, std::string text) { alarms_.push_back({severity, std::move(text)}); }
  [[nodiscard]] std::vector<Alarm> gravest_first() && {
    std::stable_sort(alarms_.begin(), alarms_.end(),
                     [](const Alarm& a, const Alarm& b) { return a.severity > b.severity; });
    return std::move(alarms_);
  }

 private:
  std::vector<Alarm> alarms_;
};

// Under way, or holding a place: it steers.
[[nodiscard]] bool steers(const BoardPicture& picture) noexcept {
  return picture.mission != nullptr && (picture.mission->value.state == MissionState::kUnderWay ||
                                        picture.mission->value.state == MissionState::kHolding);
}

[[nodiscard]] bool is_absent(const BoardPicture& picture, DeviceId device) noexcept {
  const auto* health = picture.devices[static_cast<std::size_t>(device)];
  return health != nullptr && health->value.status == DeviceStatus::kAbsent;
}

void judge_programs(const BoardPicture& picture, AlarmList& alarms) {
  alarms.need(picture.low_alive, true,
              "lodesman-low does not run: nothing drives the thrusters, or brakes them");
  alarms.need(picture.high_alive, true,
              "lodesman-high does not run: nobody steers or takes orders");
}

void judge_senses(const BoardPicture& picture, AlarmList& alarms) {
  const bool needed = steers(picture);
  const Time now = picture.now;
  alarms.need(is_fresh(picture.attitude, now, max_age::kAttitude), needed, "no heading");
  const bool placed = is_fresh(picture.state, now, max_age::kVehicleState);
  alarms.need(placed, needed, "no position");
  if (placed) {
    switch (picture.state->value.trust) {
      case PositionTrust::kLost: alarms.need(false, needed, "the position is lost"); break;
      case PositionTrust::kBridged:
        alarms.tell(Severity::kWarning, "the position is reckoned on since the last good fix");
        break;
      case PositionTrust::kApproaching:
        alarms.tell(Severity::kWarning, "the position moves towards fixes that were refused");
        break;
      case PositionTrust::kFrozen:
        alarms.tell(Severity::kWarning, "the receiver repeats itself: the position is reckoned on");
        break;
      case PositionTrust::kTracked:
      case PositionTrust::kReckoned: break;
    }
  }
  if (!is_absent(picture, DeviceId::kSonar)) {
    alarms.need(is_fresh(picture.obstacles, now, max_age::kSonarFrame), needed,
                "no sonar frame: nothing is seen of the water");
  }
}

void judge_devices(const BoardPicture& picture, AlarmList& alarms) {
  constexpr std::array<const char*, kDeviceCount> kNames{"heading", "sonar", "position",
                                                         "thrusters"};
  for (std::size_t i = 0; i < kDeviceCount; ++i) {
    const auto* health = picture.devices[i];
    if (health == nullptr || health->value.status == DeviceStatus::kAbsent) {
      continue;
    }
    const DeviceHealth& device = health->value;
    const bool is_well = device.status == DeviceStatus::kWorking;
    if (is_well && device.fault == DeviceFault::kNone) {
      continue;
    }
    const std::string means = describe(device.fault);
    alarms.tell(Severity::kWarning, std::string{kNames[i]} + ": " + to_string(device.status) +
                                        (means.empty() ? "" : ": " + means));
  }
}

void judge_thrust(const BoardPicture& picture, AlarmList& alarms) {
  const bool under_way =
      picture.mission != nullptr && picture.mission->value.state == MissionState::kUnderWay;
  alarms.need(is_fresh(picture.thrust, picture.now, max_age::kThrustApplied), steers(picture),
              "the thruster task is silent");
  if (picture.thrust_status != nullptr) {
    const ThrustState state = picture.thrust_status->value.state;
    if (state == ThrustState::kStopped) {
      alarms.tell(under_way ? Severity::kCritical : Severity::kWarning,
                  "the emergency stop is latched");
    } else if (state == ThrustState::kDisarmed && under_way) {
      alarms.tell(Severity::kCritical, "under way, and the thrusters are disarmed");
    } else if (state == ThrustState::kManual) {
      alarms.tell(Severity::kInfo, "thrust is by hand");
    }
  }
  if (picture.thrust != nullptr && picture.thrust->value.reason == ThrustReason::kDeviceFailed) {
    alarms.need(false, under_way, "the thruster box takes no commands");
  }
}

void judge_guard(const BoardPicture& picture, AlarmList& alarms) {
  if (!is_fresh(picture.guard, picture.now, max_age::kGuardStatus)) {
    return;
  }
  switch (picture.guard->value.state) {
    case GuardState::kBraking: alarms.tell(Severity::kCritical, "the guard brakes"); break;
    case GuardState::kHolding:
      alarms.tell(Severity::kCritical,
                  "the guard has stopped the boat, and lets it go no closer to what lies ahead");
      break;
    case GuardState::kBlind:
      alarms.need(false, steers(picture), "the guard is blind: no sonar frame is new enough");
      break;
    case GuardState::kOverridden:
      alarms.tell(Severity::kWarning, "the guard is overridden by the stick");
      break;
    case GuardState::kOff:
    case GuardState::kIdle:
    case GuardState::kWatching: break;
  }
}

void judge_battery(const BoardPicture& picture, AlarmList& alarms) {
  if (picture.battery == nullptr) {
    return;
  }
  if (picture.battery->value.level == BatteryLevel::kCritical) {
    alarms.tell(Severity::kCritical, "the battery is all but empty");
  } else if (picture.battery->value.level == BatteryLevel::kLow) {
    alarms.tell(Severity::kWarning, "the battery is low");
  }
}

[[nodiscard]] const char* in_words(NoWayCause cause) noexcept {
  switch (cause) {
    case NoWayCause::kNone: return "";
    case NoWayCause::kUnknown: return "it thrusts and stays where it is";
    case NoWayCause::kThrusters: return "the thruster box takes no commands, or says nothing";
    case NoWayCause::kNoHeading: return "the heading is lost";
    case NoWayCause::kNoPosition: return "the position is lost";
    case NoWayCause::kNoPlan: return "there is nothing to follow";
    case NoWayCause::kCurrent: return "the current is stronger than the boat";
    case NoWayCause::kDisarmed: return "the thrusters are disarmed";
    case NoWayCause::kNoSonar: return "the sonar is silent";
  }
  return "";
}

void judge_mission(const BoardPicture& picture, AlarmList& alarms) {
  if (picture.mission == nullptr) {
    return;
  }
  const MissionStatus& mission = picture.mission->value;
  alarms.need(is_fresh(picture.mission, picture.now, max_age::kMissionStatus), steers(picture),
              "the mission has fallen silent");
  if (mission.no_way != NoWayCause::kNone) {
    alarms.tell(Severity::kCritical, std::string{"no way is made: "} + in_words(mission.no_way));
  }
  if (mission.blocked_since != Time{}) {
    alarms.tell(Severity::kWarning, "the waypoint cannot be reached, and is waited for");
  }
}

}  // namespace

const char* to_string(Severity severity) noexcept {
  switch (severity) {
    case Severity::kInfo: return "info";
    case Severity::kWarning: return "warning";
    case Severity::kCritical: return "critical";
  }
  return "";
}

std::vector<Alarm> alarms_of(const BoardPicture& picture, const std::string& absence) {
  AlarmList alarms;
  if (!absence.empty()) {
    alarms.tell(Severity::kCritical, "there is no boat: " + absence);
    return std::move(alarms).gravest_first();
  }
  judge_programs(picture, alarms);
  judge_senses(picture, alarms);
  judge_devices(picture, alarms);
  judge_thrust(picture, alarms);
  judge_guard(picture, alarms);
  judge_battery(picture, alarms);
  judge_mission(picture, alarms);
  return std::move(alarms).gravest_first();
}

}  // namespace lodesman::console
