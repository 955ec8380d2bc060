// SPDX-License-Identifier: Apache-2.0
// The simulated vessel: surge, sway and yaw of the paper's ASV under two thrusters, written apart
// from the controller's own thrust map. A Vessel belongs to one thread; parameters are plain data.
#pragma once

#include "drivers/hal/devices.h"
#include "hal_sim/scenario/vessel_parameters.h"
#include "mid_level/base/frames.h"

namespace lodesman {

struct VesselState {
  VehiclePose pose;
  double surge_m_s = 0.0;       // through the water
  double sway_m_s = 0.0;        // through the water, to starboard
  double yaw_rate_rad_s = 0.0;  // clockwise positive
};

// What of the environment moves the vessel.
struct WaterConditions {
  double current_x_m_s = 0.0;  // [world]
  double current_y_m_s = 0.0;  // [world]
  bool lift = false;
};

class Vessel {
 public:
  Vessel(const VesselParameters& parameters, const WaterConditions& water,
         const VehiclePose& start) noexcept;
  // One that is under way already.
  [[nodiscard]] static Vessel under_way(const VesselParameters& parameters,
                                        const WaterConditions& water,
                                        const VesselState& state) noexcept;

  // Moves on by dt_s, in equal parts of at most step_s_max.
  void advance(double dt_s, ThrustCommand thrust) noexcept;

  [[nodiscard]] const VesselState& state() const noexcept { return state_; }
  // Velocity over ground, in the vehicle frame: x to starboard, y ahead.
  [[nodiscard]] Eigen::Vector2d ground_velocity_V_m_s() const noexcept;

 private:
  VesselParameters parameters_;
  WaterConditions water_;
  VesselState state_;
};

}  // namespace lodesman
