// SPDX-License-Identifier: Apache-2.0
// How the tasks themselves are doing, and the devices.
// Plain data for the blackboard; any thread.
#pragma once

#include <array>
#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"

namespace lodesman {

// Written by the runner once a second, on each task's own channel; read by displays and by whoever
// watches for tasks that hang.
struct TaskHealth {
  static constexpr std::size_t kLateBuckets = 20;

  std::uint64_t steps = 0;               // [-] done so far
  std::uint64_t overruns = 0;            // [-] periods missed so far, and skipped
  std::uint64_t refused = 0;             // [-] inputs passed over so far because they were not sane
  std::uint64_t last_step_ns = 0;        // [ns] of the last step, measured
  std::uint64_t worst_step_ns = 0;       // [ns] of the longest step, measured
  std::uint64_t worst_late_ns = 0;       // [ns] from when a step was due to when it began, measured
  std::uint64_t fifo_priority = 0;       // [-] SCHED_FIFO priority that its thread holds; 0: none
  std::uint64_t wakes = 0;               // [-] of the steps: rung for, not yet due by their period
  std::uint64_t worst_wake_late_ns = 0;  // [ns] from the newest ring to when a woken step began
  std::uint64_t over_budget = 0;         // [-] steps longer than the task table's budget
  std::uint64_t past_deadline = 0;       // [-] steps that ended after the task table's deadline
  // Steps of the period that began less than 2^i us after they were due, and not less than half of
  // that; the last also counts what was later still.
  std::array<std::uint64_t, kLateBuckets> late{};       // [-]
  std::array<std::uint64_t, kLateBuckets> wake_late{};  // [-] woken ones, after the newest ring
  // All steps, by how long they took, in the same powers of two.
  std::array<std::uint64_t, kLateBuckets> took{};  // [-]

  static constexpr auto fields() noexcept {
    using T = TaskHealth;
    return field_list(
        field("steps", &T::steps), field("overruns", &T::overruns), field("refused", &T::refused),
        measured_field("last_step_ns", &T::last_step_ns),
        measured_field("worst_step_ns", &T::worst_step_ns),
        measured_field("worst_late_ns", &T::worst_late_ns),
        measured_field("fifo_priority", &T::fifo_priority), measured_field("wakes", &T::wakes),
        measured_field("worst_wake_late_ns", &T::worst_wake_late_ns),
        measured_field("over_budget", &T::over_budget),
        measured_field("past_deadline", &T::past_deadline), measured_field("late", &T::late),
        measured_field("wake_late", &T::wake_late), measured_field("took", &T::took));
  }
};

// In the order of the configuration's section [devices].
enum class DeviceId : std::uint8_t { kHeading, kSonar, kPosition, kThrusters };
[[nodiscard]] constexpr auto enumerators(DeviceId) noexcept {
  return enumerators_to<DeviceId::kThrusters>("heading", "sonar", "position", "thrusters");
}
inline constexpr std::size_t kDeviceCount = 4;

enum class DeviceStatus : std::uint8_t {
  kAbsent,        // the configuration has none
  kAwaited,       // nothing has come yet
  kWorking,       // what comes, or is taken, is whole
  kSilent,        // nothing has come for longer than its readers wait
  kCorrupt,       // what came last fails its check
  kRefused,       // what came last is whole but cannot be
  kDisconnected,  // gone, or takes no commands
};
[[nodiscard]] constexpr auto enumerators(DeviceStatus) noexcept {
  return enumerators_to<DeviceStatus::kDisconnected>("absent", "awaited", "working", "silent",
                                                     "corrupt", "refused", "disconnected");
}

// What ails a device, as far as its driver knows: why it is as its status says, or, of one that
// works, a warning.
enum class DeviceFault : std::uint8_t {
  kNone,
  // Of the line.
  kNoPort,        // there is no such port
  kPortBusy,      // another program holds it
  kNoPermission,  // this user may not open it
  kNotAPort,      // it is there and is no serial port
  kUnplugged,     // it went while it was used
  kLineFull,      // it takes no more bytes
  // Of a network.
  kNobodyListens,  // no program listens at its address
  kNoWay,          // there is no way to its address
  // Of the conversation.
  kStarting,        // it is being asked who it is, and set
  kNoAnswer,        // it says nothing that could be understood, at no speed
  kWrongDevice,     // something else answers
  kDoesNotFit,      // what was asked of it does not fit its line, or it has no such thing
  kSettingRefused,  // it does not take its settings
  // Of what a sensor says.
  kSelfTestFailed,  // its own test says that it must not be used
  kSelfTestWarning,
  kFrozen,        // the same to the last bit, though the boat moves, or the water does
  kImplausible,   // whole, but it cannot be: by its own clock or its own rates
  kUnusualBeams,  // a sonar's beams lie otherwise than its sector says
  // Of a thruster box.
  kProving,     // its own time-out is being tried
  kWrongMode,   // it is there and obeys nothing: its serial mode is another
  kNoTimeOut,   // it does not stop by itself when nobody speaks to it
  kNotNeutral,  // it is not neutral where it has to be
  kBoxError,    // it reports errors again and again
  kBoxReset,    // it has forgotten what it was told
  // Of a receiver.
  kNoService,  // nothing listens at its address
  kNoFix,      // it says that it has none
  kWrongDate,  // its date cannot be; its position is used, its date is not
  kFarOff,     // its position lies farther from the world's origin than is set: it is not used
  // Of what a sonar's pings show, beside kFrozen.
  kSaturated,     // nearly all is white
  kDeaf,          // it heard water, and hears nothing any more
  kBlindSector,   // some beams hear nothing
  kWeed,          // some beams hear a haze at the head and nothing behind it
  kInterference,  // bright rays in many bearings
};
[[nodiscard]] constexpr auto enumerators(DeviceFault) noexcept {
  return enumerators_to<DeviceFault::kInterference>(
      "none", "no_port", "port_busy", "no_permission", "not_a_port", "unplugged", "line_full",
      "nobody_listens", "no_way", "starting", "no_answer", "wrong_device", "does_not_fit",
      "setting_refused", "self_test_failed", "self_test_warning", "frozen", "implausible",
      "unusual_beams", "proving", "wrong_mode", "no_time_out", "not_neutral", "box_error",
      "box_reset", "no_service", "no_fix", "wrong_date", "far_off", "saturated", "deaf",
      "blind_sector", "weed", "interference");
}

// The same in words, for an operator: what it is and, where it is plain, what mends it.
[[nodiscard]] constexpr const char* describe(DeviceFault fault) noexcept {
  switch (fault) {
    case DeviceFault::kNone: return "";
    case DeviceFault::kNoPort: return "there is no such port";
    case DeviceFault::kPortBusy: return "another program holds the port";
    case DeviceFault::kNoPermission:
      return "this user may not open the port (lodesman doctor says how)";
    case DeviceFault::kNotAPort: return "what lies at its address is no serial port";
    case DeviceFault::kUnplugged: return "unplugged";
    case DeviceFault::kLineFull: return "it takes no more bytes";
    case DeviceFault::kNobodyListens:
      return "no program listens at its address: does the maker's program run there?";
    case DeviceFault::kNoWay: return "there is no way to its address: is the cable in?";
    case DeviceFault::kStarting: return "it is being asked who it is";
    case DeviceFault::kNoAnswer: return "it says nothing that could be understood";
    case DeviceFault::kWrongDevice: return "another device answers";
    case DeviceFault::kDoesNotFit: return "what is asked of it does not fit its line";
    case DeviceFault::kSettingRefused: return "it refuses its settings";
    case DeviceFault::kSelfTestFailed: return "its own test has failed";
    case DeviceFault::kSelfTestWarning: return "its own test gives a warning";
    case DeviceFault::kFrozen: return "it says the same again and again";
    case DeviceFault::kImplausible: return "what it says cannot be";
    case DeviceFault::kUnusualBeams:
      return "its beams lie otherwise than its sector says: its own bearings are used";
    case DeviceFault::kProving: return "its time-out is being tried";
    case DeviceFault::kWrongMode:
      return "it obeys nothing: set its serial mode to USB Dual Port with the maker's program";
    case DeviceFault::kNoTimeOut:
      return "it does not stop by itself: set its serial time-out to 0.5 s";
    case DeviceFault::kNotNeutral:
      return "it is not neutral after its time-out: set its error action to go to 1500 us";
    case DeviceFault::kBoxError: return "it reports errors again and again";
    case DeviceFault::kBoxReset: return "it has forgotten what it was told";
    case DeviceFault::kNoService: return "nothing listens at its address: is gpsd running?";
    case DeviceFault::kNoFix: return "it has no fix: has its antenna the sky above it?";
    case DeviceFault::kWrongDate: return "its date cannot be, and is not used";
    case DeviceFault::kFarOff:
      return "its position is farther from the origin than is set: is [origin] right?";
    case DeviceFault::kSaturated: return "its pings are white all over, and are not used";
    case DeviceFault::kDeaf: return "it hears nothing any more, and its pings are not used";
    case DeviceFault::kBlindSector:
      return "some of its beams hear nothing: water there is not taken for free";
    case DeviceFault::kWeed:
      return "something covers a part of it: water behind that is not taken for free";
    case DeviceFault::kInterference: return "rays cross its pings: what else is on its supply?";
  }
  return "";
}

// Written by the task that owns the device, at each change of its status or fault and once a
// second; read by displays and by the command socket.
struct DeviceHealth {
  DeviceStatus status = DeviceStatus::kAwaited;
  DeviceFault fault = DeviceFault::kNone;
  Time since{};                      // [ns] when it came to have that status
  std::uint64_t samples = 0;         // [-] whole ones so far, or commands taken
  std::uint64_t corrupt = 0;         // [-] that failed their check
  std::uint64_t refused = 0;         // [-] that could not be
  std::uint64_t disconnections = 0;  // [-] how often it went

  static constexpr auto fields() noexcept {
    using D = DeviceHealth;
    return field_list(field("status", &D::status), field("fault", &D::fault),
                      field("since", &D::since), field("samples", &D::samples),
                      field("corrupt", &D::corrupt), field("refused", &D::refused),
                      field("disconnections", &D::disconnections));
  }
};

}  // namespace lodesman
