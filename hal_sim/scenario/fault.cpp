// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/fault.h"

#include <algorithm>
#include <iterator>

namespace lodesman {
namespace {

constexpr std::size_t kMaxFaults = 64;
constexpr double kMaxFaultTime_s = 1e5;

}  // namespace

std::vector<Fault> read_faults(const TomlTable& root) {
  std::vector<Fault> faults;
  for (const TomlTable& table : root.tables("fault", kMaxFaults)) {
    Fault fault;
    fault.device =
        static_cast<FaultDevice>(table.choice("device", {"ahrs", "thruster", "sonar", "position"}));
    const std::size_t kind = fault.device == FaultDevice::kThruster
                                 ? 2 * table.choice("kind", {"stall", "disconnect"})
                                 : table.choice("kind", {"stall", "corrupt", "disconnect"});
    fault.kind = static_cast<FaultKind>(static_cast<std::size_t>(FaultKind::kStall) + kind);
    fault.at_s = table.number("at_s", Range::between(0.0, kMaxFaultTime_s));
    fault.duration_s = table.number("duration_s", Range::above(0.0, kMaxFaultTime_s));
    faults.push_back(fault);
  }
  return faults;
}

std::string fault_kinds_help() {
  return "ahrs: stall (nothing new), corrupt (samples fail their check), disconnect (gone)\n"
         "sonar: stall, corrupt, disconnect\n"
         "position: stall, corrupt, disconnect\n"
         "thruster: stall (takes commands and ignores them), disconnect (takes none); after either "
         "the box's own time-out stops both thrusters\n";
}

FaultSchedule::FaultSchedule(const std::vector<Fault>& faults, FaultDevice device) {
  std::copy_if(faults.begin(), faults.end(), std::back_inserter(faults_),
               [device](const Fault& fault) { return fault.device == device; });
}

FaultKind FaultSchedule::at(double scenario_time_s) const noexcept {
  for (const Fault& fault : faults_) {
    if (scenario_time_s >= fault.at_s && scenario_time_s < fault.at_s + fault.duration_s) {
      return fault.kind;
    }
  }
  return FaultKind::kNone;
}

}  // namespace lodesman
