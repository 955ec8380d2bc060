// SPDX-License-Identifier: Apache-2.0
// The simulated vessel: surge, sway and yaw of the paper's ASV under two thrusters, written apart
// from the controller's own thrust map. A Vessel belongs to one thread; parameters are plain data.
#pragma once

#include <filesystem>

#include "drivers/hal/devices.h"
#include "mid_level/base/config/toml_document.h"
#include "mid_level/base/frames.h"

namespace lodesman {

// deploy/config/vessel.toml, where each value has its reason.
struct VesselParameters {
  double mass_kg = 0.0;
  double yaw_inertia_kg_m2 = 0.0;
  double hull_length_m = 0.0;
  double hull_beam_m = 0.0;
  double thruster_offset_m = 0.0;       // of each thruster from the centre line
  double full_thrust_n = 0.0;           // of one thruster, 128 counts from neutral
  double surge_drag_n_s_per_m = 0.0;    // linear
  double surge_drag_n_s2_per_m2 = 0.0;  // quadratic
  double sway_drag_n_s_per_m = 0.0;     // linear
  double sway_drag_n_s2_per_m2 = 0.0;   // quadratic
  double yaw_drag_n_m_s = 0.0;          // linear
  double yaw_drag_n_m_s2 = 0.0;         // quadratic
  double drift_moment_kg = 0.0;         // turning moment a unit of surge speed x sway speed
  double lift_share = 0.0;              // [0, 1) of the linear sway drag that lift takes away ...
  double lift_half_surge_m_s = 0.0;     // ... at high surge speed; half of it at this one
  double step_s_max = 0.0;              // longest step of the integration
};

// Of a [vessel] table. Throws StartupError.
[[nodiscard]] VesselParameters read_vessel_parameters(const TomlTable& vessel);
[[nodiscard]] VesselParameters load_vessel(const std::filesystem::path& path);

// Thrust of one thruster: none at 127 and 128, otherwise with the square of the distance to 128.
[[nodiscard]] double thrust_n(const VesselParameters& vessel, std::uint8_t command) noexcept;

inline constexpr int kMaxSurgeRef = 100;

// The speed through the water that a SurgeRef in [0, 100] settles at on a straight course, under
// the integer commands that eqs 13-14 give for it.
[[nodiscard]] double steady_speed_m_s(const VesselParameters& vessel, int surge_ref) noexcept;

struct HeldSpeed {
  int surge_ref = 0;
  double speed_m_s = 0.0;
};
// The SurgeRef in [1, 100] whose steady speed is nearest.
[[nodiscard]] HeldSpeed surge_ref_for(const VesselParameters& vessel, double speed_m_s) noexcept;

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
