// SPDX-License-Identifier: Apache-2.0
// The faults that a scenario gives its devices, by scenario time, and one fault as a line of text,
// for whoever gives them while something runs. Plain data; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mid_level/config/toml_document.h"

namespace lodesman {

enum class FaultDevice : std::uint8_t { kAhrs, kThruster, kSonar, kPosition };

enum class FaultKind : std::uint8_t {
  kNone,
  // Of every device.
  kStall,       // a sensor brings nothing new; the thruster box takes commands and ignores them
  kCorrupt,     // what a sensor brings fails its check; not for the thruster box
  kDisconnect,  // the device is gone
  // From here on of devices that are emulated to the byte, but for what alters_pings(). Of single
  // bytes, both ways:
  kFlip,          // becomes another, with the chance `rate`
  kBurst,         // the same, but only in bad spells: 20 ms of them after 10 s, on the average
  kDrop,          // is lost
  kDuplicate,     // comes twice
  kInsert,        // has one before it that nobody sent
  kInterference,  // flips and unplugging that grow with the square of the thrust; of a sonar, rays
  // Of what the device says in one go.
  kCut,   // only its beginning comes
  kLate,  // an answer comes one to three times `value` too late
  // Of the line.
  kBatch,   // an adapter collects for `value` before it hands on
  kHang,    // silence of any length, now and then
  kReplug,  // unplugged and plugged again, now and then, half of the times under another name
  kPower,   // off for the duration, then on again
  // Of what an AHRS or a satellite receiver says: what is whole and wrong.
  kFrozen,    // the same values again and again
  kStep,      // heading or position is off by `value`
  kDrift,     // heading or position wanders off by `value` a second
  kSpike,     // heading or position is off by `value` once, now and then
  kInvalid,   // the most negative number everywhere; a position of 0, 0
  kMagnetic,  // the heading is off by `value` at full thrust
  kBit,       // its built-in test says `value`
  // Of a thruster box.
  kError,      // it reports an error now and then, with `rate` a second
  kReset,      // it forgets what it was told
  kRefuse,     // it ignores targets for the channel `value`
  kNoTimeOut,  // it does not stop by itself
  kWrongMode,  // it ignores everything on this port
  kBattery,    // its battery has `value`
  // Of datagrams: of these a sonar has kDrop, kDuplicate and kCut too.
  kReorder,  // comes after the one that was sent behind it
  kForeign,  // some that are not meant for the driver, with `rate` a second
  // Of a sonar's program.
  kRepeat,       // a ping has the number of the one before
  kJump,         // the numbers go on `value` farther, once
  kRange,        // its user sets the range to `value`, once
  kOutput,       // its user has it send the other kind of record, once
  kAverage,      // averages `value` pings
  kCentimetres,  // says in centimetres what it should say in millimetres
  // Of a satellite receiver, beside kFrozen, kStep, kDrift, kSpike and kInvalid.
  kVoid,         // has no fix, and says so
  kWeek,         // is 1024 weeks behind
  kBadChecksum,  // a sentence fails its check
  kNoChecksum,   // a sentence comes without its check
  kQuality,      // goes from one kind of fix to another, with `rate` a second
  // Of what a sonar hears, beside kFrozen and kInterference.
  kSaturated,  // everything is all but white
  kBlinded,    // `value` degrees ahead hear nothing
  kWeed,       // a third of the beams hear a haze at the head and nothing behind it
};
inline constexpr std::size_t kFaultKindCount = static_cast<std::size_t>(FaultKind::kWeed) + 1;

struct Fault {
  FaultDevice device = FaultDevice::kAhrs;
  FaultKind kind = FaultKind::kNone;
  double at_s = 0.0;
  double duration_s = 0.0;
  double rate = 0.0;   // how often; in what, the help text says
  double value = 0.0;  // how much; in what, the help text says
};

// Whether it alters the echoes of a sonar, which any simulated sonar has.
[[nodiscard]] constexpr bool alters_pings(FaultDevice device, FaultKind kind) noexcept {
  return device == FaultDevice::kSonar &&
         (kind == FaultKind::kFrozen || kind == FaultKind::kInterference ||
          kind == FaultKind::kSaturated || kind == FaultKind::kBlinded || kind == FaultKind::kWeed);
}

// Whether only a device that is emulated to the byte can have it.
[[nodiscard]] constexpr bool needs_bytes(FaultDevice device, FaultKind kind) noexcept {
  return kind > FaultKind::kDisconnect && !alters_pings(device, kind);
}

// As it is written: "flip".
[[nodiscard]] std::string_view name_of(FaultKind kind) noexcept;
[[nodiscard]] std::string_view name_of(FaultDevice device) noexcept;

// The [[fault]] tables of a scenario. Throws StartupError.
[[nodiscard]] std::vector<Fault> read_faults(const TomlTable& root);

// One fault, or why the text is none.
struct ParsedFault {
  std::optional<Fault> fault;
  std::string refusal;
};
// "ahrs flip rate=0.01 for=5": device and kind, then in any order `rate`, `value`, `at` [s] (0 when
// left out: at once) and `for` [s] (left out: to the end). Never throws StartupError.
[[nodiscard]] ParsedFault parse_fault(std::string_view text);

// The kinds that each device has, for a help text.
[[nodiscard]] std::string fault_kinds_help();

// The faults of one device that a device without bytes can have. Where two overlap, the one that
// comes first in the file counts.
class FaultSchedule {
 public:
  FaultSchedule(const std::vector<Fault>& faults, FaultDevice device);
  // The one that runs then, or one of the kind kNone.
  [[nodiscard]] Fault running(double scenario_time_s) const noexcept;
  [[nodiscard]] FaultKind at(double scenario_time_s) const noexcept {
    return running(scenario_time_s).kind;
  }

 private:
  std::vector<Fault> faults_;
};

}  // namespace lodesman
