// SPDX-License-Identifier: Apache-2.0
// The faults that a scenario gives its devices, by scenario time. Plain data; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mid_level/config/toml_document.h"

namespace lodesman {

enum class FaultDevice : std::uint8_t { kAhrs, kThruster, kSonar, kPosition };

enum class FaultKind : std::uint8_t {
  kNone,
  kStall,       // a sensor brings nothing new; the thruster box takes commands and ignores them
  kCorrupt,     // what a sensor brings fails its check; not for the thruster box
  kDisconnect,  // the device is gone
};

struct Fault {
  FaultDevice device = FaultDevice::kAhrs;
  FaultKind kind = FaultKind::kNone;
  double at_s = 0.0;
  double duration_s = 0.0;
};

// The [[fault]] tables of a scenario. Throws StartupError.
[[nodiscard]] std::vector<Fault> read_faults(const TomlTable& root);

// The kinds that each device has, one device a line, for a help text.
[[nodiscard]] std::string fault_kinds_help();

// The faults of one device. Where two overlap, the one that comes first in the file counts.
class FaultSchedule {
 public:
  FaultSchedule(const std::vector<Fault>& faults, FaultDevice device);
  [[nodiscard]] FaultKind at(double scenario_time_s) const noexcept;

 private:
  std::vector<Fault> faults_;
};

}  // namespace lodesman
