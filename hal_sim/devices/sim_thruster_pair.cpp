// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/devices/sim_thruster_pair.h"

namespace lodesman {

SimThrusterPair::SimThrusterPair(const Scenario& scenario, SimLink& link)
    : faults_{scenario.faults, FaultDevice::kThruster},
      world_{link.world},
      thrust_{link.thrust, Role::kLow, "simulated thrust"} {}

CommandStatus SimThrusterPair::command(ThrustCommand command, Time now) noexcept {
  const Stamped<WorldSample>* world = world_.latest();
  const FaultKind fault = world != nullptr && world->value.started != 0
                              ? faults_.at(world->value.scenario_time_s)
                              : FaultKind::kNone;
  if (fault == FaultKind::kNone) {
    thrust_.publish({command.left, command.right}, now);
  }
  return fault == FaultKind::kDisconnect ? CommandStatus::kDisconnected : CommandStatus::kTaken;
}

}  // namespace lodesman
