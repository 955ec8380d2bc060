// SPDX-License-Identifier: Apache-2.0
// Whether the thrusters may turn at all, and by whose hand. Plain data for the blackboard; any
// thread.
#pragma once

#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"

namespace lodesman {

enum class ThrustOrderKind : std::uint8_t {
  kNone,
  kArm,
  kDisarm,
  kStop,       // the emergency stop, latched until ...
  kRelease,    // ... this, which leaves the thrusters disarmed
  kToMission,  // the stick is out of the hand: thrust is the mission's again
};
[[nodiscard]] constexpr auto enumerators(ThrustOrderKind) noexcept {
  return enumerators_to<ThrustOrderKind::kToMission>("none", "arm", "disarm", "stop", "release",
                                                     "to_mission");
}

// Written by the command socket; read by the thruster task, where the arming lives.
struct ThrustOrder {
  ThrustOrderKind order = ThrustOrderKind::kNone;
  std::uint64_t stops = 0;  // [-] ordered on this blackboard so far, this one included

  static constexpr auto fields() noexcept {
    return field_list(field("order", &ThrustOrder::order), field("stops", &ThrustOrder::stops));
  }
};

// A stick's place. Written by the command socket at each word of it; read by the thruster task.
struct ManualInput {
  std::int32_t surge_ref = 0;  // [-] [-100, 100]
  std::int32_t head_ref = 0;   // [-] [-100, 100] positive turns right
  bool overrides_guard = false;

  static constexpr auto fields() noexcept {
    return field_list(field("surge_ref", &ManualInput::surge_ref).within(-100, 100),
                      field("head_ref", &ManualInput::head_ref).within(-100, 100),
                      field("overrides_guard", &ManualInput::overrides_guard));
  }
};

enum class ThrustState : std::uint8_t {
  kDisarmed,  // neutral
  kArmed,     // as the helm says
  kManual,    // as the stick says; neutral where it is silent
  kStopped,   // the emergency stop: neutral, latched
};
[[nodiscard]] constexpr auto enumerators(ThrustState) noexcept {
  return enumerators_to<ThrustState::kStopped>("disarmed", "armed", "manual", "stopped");
}

// What brought the thrusters into their state.
enum class ThrustCause : std::uint8_t {
  kPowerUp,     // so it begins
  kOrder,       // an operator's word, or the stick itself
  kRemembered,  // as a low level that was here shortly before had it
  kBoxLost,     // the thruster box was gone, or not ready, for too long
  kAbort,       // of the mission: it ends manual
  kLatch,       // a stop from before the power was off
};
[[nodiscard]] constexpr auto enumerators(ThrustCause) noexcept {
  return enumerators_to<ThrustCause::kLatch>("power_up", "order", "remembered", "box_lost", "abort",
                                             "latch");
}

// What speaks against arming; each is a bit of ThrustStatus::objections.
enum class ArmObjection : std::uint8_t {
  kStopped,          // the emergency stop is latched
  kNoThrusters,      // the configuration has none
  kBoxGone,          // the thruster box is gone
  kBoxNotReady,      // it is being tried, or at fault
  kHighSilent,       // the high level says nothing
  kHelmNotAtRest,    // the helm asks for thrust already
  kStickNotAtRest,   // so does the stick
  kBatteryCritical,  // the battery is all but empty
};
inline constexpr std::size_t kArmObjectionCount = 8;
[[nodiscard]] constexpr auto enumerators(ArmObjection) noexcept {
  return enumerators_to<ArmObjection::kBatteryCritical>(
      "stopped", "no_thrusters", "box_gone", "box_not_ready", "high_silent", "helm_not_at_rest",
      "stick_not_at_rest", "battery_critical");
}
[[nodiscard]] constexpr std::uint32_t bit(ArmObjection objection) noexcept {
  return std::uint32_t{1} << static_cast<unsigned>(objection);
}

// What became of the newest order.
enum class ThrustAnswer : std::uint8_t {
  kNone,
  kObeyed,
  kRefused,     // an arm: for `refused_for`
  kNotStopped,  // a release: there is nothing to release
  kNotArmed,    // a word for the stick, or for the mission: the thrusters are not armed
  kStopCame,    // a stop stood beside it
  kTooOld,      // it was not taken in time
};
[[nodiscard]] constexpr auto enumerators(ThrustAnswer) noexcept {
  return enumerators_to<ThrustAnswer::kTooOld>("none", "obeyed", "refused", "not_stopped",
                                               "not_armed", "stop_came", "too_old");
}

// Written by the thruster task at every step; read by the command socket and displays, and by a
// thruster task that comes after.
struct ThrustStatus {
  ThrustState state = ThrustState::kDisarmed;
  ThrustCause cause = ThrustCause::kPowerUp;
  Time since{};                               // [ns] when it came into that state
  Time armed{};                               // [ns] when it was last told to arm; 0: never
  std::uint32_t objections = 0;               // [-] bits of ArmObjection: against arming now
  std::uint64_t order = 0;                    // [-] sequence of the last order answered
  ThrustAnswer answer = ThrustAnswer::kNone;  // to that order
  std::uint32_t refused_for = 0;              // [-] bits of ArmObjection, of that answer
  std::uint64_t stops = 0;  // [-] obeyed so far: ThrustOrder::stops of the last one

  static constexpr auto fields() noexcept {
    using S = ThrustStatus;
    return field_list(field("state", &S::state), field("cause", &S::cause),
                      field("since", &S::since), field("armed", &S::armed),
                      field("objections", &S::objections), field("order", &S::order),
                      field("answer", &S::answer), field("refused_for", &S::refused_for),
                      field("stops", &S::stops));
  }
};

// That the thruster box was seen to stop by itself. Written by the thruster task when it changes;
// read by a thruster task that comes after, and by displays.
struct BoxProof {
  Time proved{};               // [ns] when; 0: no proof stands
  std::uint64_t power_up = 0;  // [-] of the box, as the system knows it; 0: it does not

  static constexpr auto fields() noexcept {
    return field_list(field("proved", &BoxProof::proved), field("power_up", &BoxProof::power_up));
  }
};

enum class BatteryLevel : std::uint8_t {
  kUnknown,  // nothing tells, or nothing has told for too long
  kGood,
  kLow,
  kCritical,  // stands until the program ends
};
[[nodiscard]] constexpr auto enumerators(BatteryLevel) noexcept {
  return enumerators_to<BatteryLevel::kCritical>("unknown", "good", "low", "critical");
}

// Written by the thruster task at each change of its level and once a second; read by displays and
// the command socket.
struct BatteryStatus {
  BatteryLevel level = BatteryLevel::kUnknown;
  double volts = 0.0;       // [V] as the box measured it last; 0: never
  double rest_volts = 0.0;  // [V] filtered, as it would be without load; 0: unknown

  static constexpr auto fields() noexcept {
    using B = BatteryStatus;
    return field_list(field("level", &B::level), field("volts", &B::volts).within(0.0, 1000.0),
                      field("rest_volts", &B::rest_volts).within(0.0, 1000.0));
  }
};

}  // namespace lodesman
