// SPDX-License-Identifier: Apache-2.0
// A low level on simulated devices with the world they live in: what lodesman-low runs in a
// simulation, and what lock-step runs beside the high level. Made before any task runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deploy/boat/scenario_voyage.h"

namespace lodesman {

// Refuses, with the place in the configuration, a device address that a simulation cannot make.
void require_devices(const TomlDocument& configuration, const Scenario& scenario);

class SimulatedBoat {
 public:
  SimulatedBoat(Blackboard& board, const TomlDocument& configuration, const Scenario& scenario);
  SimulatedBoat(const SimulatedBoat&) = delete;
  SimulatedBoat& operator=(const SimulatedBoat&) = delete;
  ~SimulatedBoat();

  // The world's task and the low level's.
  [[nodiscard]] std::vector<TaskEntry> tasks();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman
