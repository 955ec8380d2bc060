// SPDX-License-Identifier: Apache-2.0
// The simulated thruster box: hands each command to the world; the world applies the box's
// time-out (sim_link.h). Commanded by the one thread that owns it.
#pragma once

#include "drivers/hal/devices.h"
#include "hal_sim/scenario/scenario.h"
#include "hal_sim/world/sim_link.h"

namespace lodesman {

// Its faults: stalled, the box takes commands and does nothing with them; disconnected, it takes
// none. In both cases its last command holds until its time-out, as in a real box.
class SimThrusterPair final : public ThrusterPair {
 public:
  // The link must outlive the box. Throws StartupError when the link has a box already.
  SimThrusterPair(const Scenario& scenario, SimLink& link);
  [[nodiscard]] CommandStatus command(ThrustCommand command, Time now) noexcept override;

 private:
  FaultSchedule faults_;
  Reader<WorldSample> world_;
  Writer<SimThrust> thrust_;
};

}  // namespace lodesman
