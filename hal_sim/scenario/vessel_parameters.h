// SPDX-License-Identifier: Apache-2.0
// What a simulated hull is like: the coefficients of its equations of motion in surge, sway and yaw
// (Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2nd ed., ch. 3, 6 and 8), and
// the speeds that it settles at. Axes: x ahead, y to starboard, z down through midships, so that
// yaw is clockwise positive. Plain data; pure functions.
#pragma once

#include <cstdint>
#include <filesystem>

#include "mid_level/config/toml_document.h"

namespace lodesman {

// hal_sim/vessels/*.toml, where each value has its reason; docs/vessels.md says what each one is.
struct VesselParameters {
  // Rigid body.
  double mass_kg = 0.0;
  double yaw_inertia_kg_m2 = 0.0;          // about the centre of gravity
  double centre_of_gravity_ahead_m = 0.0;  // of midships
  // Added mass, as what is to be added: positive where the water resists.
  double surge_added_mass_kg = 0.0;
  double sway_added_mass_kg = 0.0;
  double yaw_added_inertia_kg_m2 = 0.0;
  double sway_yaw_added_mass_kg_m = 0.0;  // of either sign
  // What a drifting hull is turned out of its course by beyond the Munk moment of these masses: a
  // moment a unit of surge times sway speed. Negative: turned back, as by a skeg.
  double drift_moment_kg = 0.0;
  // Size.
  double hull_length_m = 0.0;
  double hull_beam_m = 0.0;
  // Two propellers, each with thrust that grows with the square of its speed.
  double thruster_offset_m = 0.0;       // of each from the centre line
  double thrust_ahead_n = 0.0;          // of one, at full speed ahead
  double thrust_astern_n = 0.0;         // of one, at full speed astern
  double propeller_ahead_rad_s = 0.0;   // full speed ahead
  double propeller_astern_rad_s = 0.0;  // full speed astern
  double propeller_lag_s = 0.0;         // of the first order; 0: at once
  // Drag.
  double surge_drag_n_s_per_m = 0.0;    // linear
  double surge_drag_n_s2_per_m2 = 0.0;  // quadratic
  double sway_drag_n_s_per_m = 0.0;     // linear
  double sway_drag_n_s2_per_m2 = 0.0;   // quadratic
  double yaw_drag_n_m_s = 0.0;          // linear
  double yaw_drag_n_m_s2 = 0.0;         // quadratic
  // Cross-flow drag: over strips of this length together, of this draught.
  double cross_flow_length_m = 0.0;
  double cross_flow_draught_m = 0.0;
  double cross_flow_coefficient = 0.0;  // 0: none
  // Side force where a scenario has `lift`; without it the track is held by a linear drag instead.
  double track_hold_n_s_per_m = 0.0;
  double lift_kg_per_m = 0.0;         // side force a unit of speed squared and of small drift angle
  double lift_ahead_m = 0.0;          // where it acts, ahead of midships when the hull goes ahead
  double lift_saturation_deg = 45.0;  // drift angle about which it stops growing
  double lift_drag_n_s2_per_m2 =
      0.0;  // of the flow that no longer follows the hull, about midships
  // Of a load whose weight pulls along a deck that is not level: as surge force at rest and how it
  // grows with the surge speed, and as mass that only centripetal force has to turn.
  double trim_force_n = 0.0;
  double trim_force_n_s_per_m = 0.0;
  double trim_force_n_s2_per_m2 = 0.0;
  double heel_mass_kg = 0.0;
  // Between the box and the propellers.
  bool wires_swapped = false;  // the left command reaches the right propeller
  bool left_reversed = false;
  bool right_reversed = false;
  // Said of hulls that do not hold a straight course by themselves.
  bool straight_line_unstable = false;
  double step_s_max = 0.0;  // longest step of the integration
};

// Of a [vessel] table, looked at by require_sound_hull. Throws StartupError.
[[nodiscard]] VesselParameters read_vessel_parameters(const TomlTable& vessel);
[[nodiscard]] VesselParameters load_vessel(const std::filesystem::path& path);

// Speed of a propeller that a command asks for: none at 127 and 128, otherwise in proportion to the
// distance to 128.
[[nodiscard]] double propeller_rad_s(const VesselParameters& vessel, std::uint8_t command) noexcept;

// Thrust of one propeller: with the square of its speed, which is clamped to the full ones.
[[nodiscard]] double propeller_thrust_n(const VesselParameters& vessel, double rad_s) noexcept;
[[nodiscard]] double thrust_n(const VesselParameters& vessel, std::uint8_t command) noexcept;

// The speed through the water that thrust ahead settles at on a straight course; +infinity where it
// never does.
[[nodiscard]] double settled_speed_m_s(const VesselParameters& vessel, double ahead_n) noexcept;

// The same of a SurgeRef in [0, 100], under the integer commands that eqs 13-14 give for it.
[[nodiscard]] double steady_speed_m_s(const VesselParameters& vessel, int surge_ref) noexcept;

}  // namespace lodesman
