// SPDX-License-Identifier: Apache-2.0
// The Thruster task: turns the helm's references into thrust commands (eqs 13-14) and hands them to
// the box; neutral whenever the helm has fallen silent, in every mode. What the box did not take is
// reported as not done.
// Stepped by its runner's thread.
#pragma once

#include "drivers/hal/devices.h"
#include "low_level/tasks/device_report.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

class ThrusterTask final : public Task {
 public:
  // Without thrusters nothing is applied, and that is said.
  ThrusterTask(Blackboard& board, Role role, ThrusterPair* thrusters)
      : thrusters_{thrusters},
        helm_{board.helm_command},
        applied_{writer_of(board, board.thrust_applied, role)},
        device_{board, role, DeviceId::kThrusters, max_age::kThrustApplied} {}

  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override { return helm_.refused(); }
  void enter_safe_state(Time now) noexcept override;

 private:
  [[nodiscard]] ThrustApplied as_commanded(Time now) noexcept;
  [[nodiscard]] ThrustReason command(ThrustCommand thrust, Time now) noexcept;

  ThrusterPair* thrusters_;
  Reader<HelmCommand> helm_;
  Writer<ThrustApplied> applied_;
  DeviceReport device_;
};

}  // namespace lodesman
