// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/faulty_device.h"

namespace lodesman {
namespace {

// What is injected again and again while the fault runs is counted where it is.
[[nodiscard]] constexpr bool counts_at_begin(FaultKind kind) noexcept {
  switch (kind) {
    case FaultKind::kCorrupt:
    case FaultKind::kSpike:
    case FaultKind::kError:
    case FaultKind::kForeign:
    case FaultKind::kRepeat:
    case FaultKind::kBadChecksum:
    case FaultKind::kNoChecksum:
    case FaultKind::kQuality: return false;
    default: return true;
  }
}

}  // namespace

const FaultyDevice::Running* FaultyDevice::running(FaultKind kind) const noexcept {
  const auto& running = running_[static_cast<std::size_t>(kind)];
  return running ? &*running : nullptr;
}

void FaultyDevice::begin_fault(const Fault& fault, Time now) {
  if (!has_fault(fault.kind)) {
    return;
  }
  running_[static_cast<std::size_t>(fault.kind)] = Running{fault, now};
  if (counts_at_begin(fault.kind)) {
    note(fault.kind, now);
  }
  begun(fault, now);
}

void FaultyDevice::end_fault(const Fault& fault, Time now) {
  auto& running = running_[static_cast<std::size_t>(fault.kind)];
  if (!running || running->fault.at_s < fault.at_s || running->fault.at_s > fault.at_s) {
    return;
  }
  running.reset();
  if (fault.kind == FaultKind::kPower) {
    power_cycle(now);
  }
}

}  // namespace lodesman
