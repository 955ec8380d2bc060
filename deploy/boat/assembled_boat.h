// SPDX-License-Identifier: Apache-2.0
// The low level on the devices that the configuration names, and the world of those that are
// simulated: what lodesman-low runs, and what lock-step runs beside the high level. Made before any
// task runs; everything that is wrong throws StartupError.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "deploy/boat/configuration.h"
#include "deploy/boat/named_scenario.h"
#include "deploy/boat/voyage.h"

namespace lodesman {

[[nodiscard]] bool is_simulated(const BoatConfig& config);
[[nodiscard]] bool has_real_thrusters(const BoatConfig& config);
[[nodiscard]] bool has_real_devices(const BoatConfig& config);

// The scenario that the configuration names; empty where no device is simulated. Refuses a world
// that nothing belongs to, and a simulated device without one.
[[nodiscard]] std::optional<Scenario> simulated_scenario(const BoatConfig& config);

// Refuses devices that do not go together, and addresses that no device can be made of, with the
// place in the configuration. `scenario`: of the simulated world, where there is one.
void require_sound(const BoatConfig& config, const Scenario* scenario);

class AssembledBoat {
 public:
  AssembledBoat(Blackboard& board, const BoatConfig& config, const Scenario* scenario);
  AssembledBoat(const AssembledBoat&) = delete;
  AssembledBoat& operator=(const AssembledBoat&) = delete;
  ~AssembledBoat();

  // The low level's tasks, and the world's where there is one.
  [[nodiscard]] std::vector<TaskEntry> tasks();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman
