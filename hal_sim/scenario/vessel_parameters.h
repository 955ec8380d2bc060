// SPDX-License-Identifier: Apache-2.0
// What the simulated vessel is like, and the speeds that it settles at. Plain data; pure functions.
#pragma once

#include <cstdint>
#include <filesystem>

#include "mid_level/config/toml_document.h"

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

// The speed through the water that a SurgeRef in [0, 100] settles at on a straight course, under
// the integer commands that eqs 13-14 give for it.
[[nodiscard]] double steady_speed_m_s(const VesselParameters& vessel, int surge_ref) noexcept;

}  // namespace lodesman
