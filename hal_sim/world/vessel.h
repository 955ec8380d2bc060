// SPDX-License-Identifier: Apache-2.0
// The simulated vessel: surge, sway and yaw of a hull under two propellers that follow their
// commands with a lag, in water that may move. Written apart from the controller's own model and
// thrust map. A Vessel belongs to one thread; parameters are plain data.
#pragma once

#include "drivers/hal/devices.h"
#include "hal_sim/scenario/vessel_parameters.h"
#include "mid_level/base/frames.h"

namespace lodesman {

struct PropellerSpeeds {
  double left_rad_s = 0.0;  // ahead positive
  double right_rad_s = 0.0;
};

struct VesselState {
  VehiclePose pose;
  double surge_m_s = 0.0;       // through the water
  double sway_m_s = 0.0;        // through the water, to starboard
  double yaw_rate_rad_s = 0.0;  // clockwise positive
  PropellerSpeeds propellers{};
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

  // Moves on by dt_s, in equal parts of at most step_s_max. The box's wires are those of the hull.
  void advance(double dt_s, ThrustCommand thrust) noexcept;
  // The same under speeds that the propellers themselves are told.
  void advance(double dt_s, PropellerSpeeds told) noexcept;

  [[nodiscard]] const VesselState& state() const noexcept { return state_; }
  // Velocity over ground, in the vehicle frame: x to starboard, y ahead.
  [[nodiscard]] Eigen::Vector2d ground_velocity_V_m_s() const noexcept;

 private:
  VesselParameters parameters_;
  WaterConditions water_;
  VesselState state_;
};

}  // namespace lodesman
