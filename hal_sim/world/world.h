// SPDX-License-Identifier: Apache-2.0
// The simulated world: a scenario's obstacles on their courses and the vessel among them. Owned by
// one thread.
#pragma once

#include "drivers/hal/devices.h"
#include "hal_sim/scenario/scenario.h"
#include "hal_sim/world/vessel.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

class World {
 public:
  World(const Scenario& scenario, const VesselParameters& parameters);

  // Moves the vessel on by dt_s; the obstacles are where their courses have them at
  // `scenario_time_s`. Neither allocates nor throws.
  void step(double dt_s, double scenario_time_s, ThrustCommand thrust) noexcept;

  // A mission starts: what was nearest before it no longer counts.
  void forget_the_least() noexcept;

  [[nodiscard]] const WorldTruth& truth() const noexcept { return truth_; }

 private:
  void observe(double scenario_time_s) noexcept;
  void measure_distances(double scenario_time_s) noexcept;
  void keep_the_least() noexcept;

  std::vector<MovingObstacle> obstacles_;
  double vehicle_radius_m_;
  VesselParameters parameters_;
  Vessel vessel_;
  WorldTruth truth_;
};

}  // namespace lodesman
