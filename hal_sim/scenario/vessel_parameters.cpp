// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/vessel_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal_sim/scenario/hull_check.h"

namespace lodesman {
namespace {

constexpr double kNeutralCommand = 128.0;
constexpr double kLargest = 1e6;

// The integer command of eqs 13-14 for a straight course, SurgeRef >= 0. Written here once more
// on purpose: the plant must not agree with the controller by construction.
[[nodiscard]] std::uint8_t straight_command(int surge_ref) noexcept {
  const double command = 12.8 * std::sqrt(surge_ref / 2.0) + kNeutralCommand;
  return static_cast<std::uint8_t>(std::min(command, 255.0));
}

constexpr Range kPositive = Range::above(0.0, kLargest);
constexpr Range kNotNegative = Range::between(0.0, kLargest);
constexpr Range kEitherSign = Range::between(-kLargest, kLargest);

void read_body(const TomlTable& vessel, VesselParameters& p) {
  p.mass_kg = vessel.number("mass_kg", kPositive);
  p.yaw_inertia_kg_m2 = vessel.number("yaw_inertia_kg_m2", kPositive);
  p.centre_of_gravity_ahead_m = vessel.number("centre_of_gravity_ahead_m", kEitherSign);
  p.surge_added_mass_kg = vessel.number("surge_added_mass_kg", kNotNegative);
  p.sway_added_mass_kg = vessel.number("sway_added_mass_kg", kNotNegative);
  p.yaw_added_inertia_kg_m2 = vessel.number("yaw_added_inertia_kg_m2", kNotNegative);
  p.sway_yaw_added_mass_kg_m = vessel.number("sway_yaw_added_mass_kg_m", kEitherSign);
  p.drift_moment_kg = vessel.number("drift_moment_kg", kEitherSign);
  p.hull_length_m = vessel.number("hull_length_m", kPositive);
  p.hull_beam_m = vessel.number("hull_beam_m", kPositive);
  p.step_s_max = vessel.number("step_s_max", Range::above(0.0, 0.1));
}

void read_propellers(const TomlTable& vessel, VesselParameters& p) {
  p.thruster_offset_m = vessel.number("thruster_offset_m", kPositive);
  p.thrust_ahead_n = vessel.number("thrust_ahead_n", kPositive);
  p.thrust_astern_n = vessel.number("thrust_astern_n", kPositive);
  p.propeller_ahead_rad_s = vessel.number("propeller_ahead_rad_s", kPositive);
  p.propeller_astern_rad_s = vessel.number("propeller_astern_rad_s", kPositive);
  p.propeller_lag_s = vessel.number("propeller_lag_s", Range::between(0.0, 10.0));
  p.wires_swapped = vessel.boolean_or("wires_swapped", false);
  p.left_reversed = vessel.boolean_or("left_reversed", false);
  p.right_reversed = vessel.boolean_or("right_reversed", false);
}

void read_drag(const TomlTable& vessel, VesselParameters& p) {
  p.surge_drag_n_s_per_m = vessel.number("surge_drag_n_s_per_m", kPositive);
  p.surge_drag_n_s2_per_m2 = vessel.number("surge_drag_n_s2_per_m2", kNotNegative);
  p.sway_drag_n_s_per_m = vessel.number("sway_drag_n_s_per_m", kNotNegative);
  p.sway_drag_n_s2_per_m2 = vessel.number("sway_drag_n_s2_per_m2", kNotNegative);
  p.yaw_drag_n_m_s = vessel.number("yaw_drag_n_m_s", kPositive);
  p.yaw_drag_n_m_s2 = vessel.number("yaw_drag_n_m_s2", kNotNegative);
  p.cross_flow_length_m = vessel.number("cross_flow_length_m", kPositive);
  p.cross_flow_draught_m = vessel.number("cross_flow_draught_m", kNotNegative);
  p.cross_flow_coefficient = vessel.number("cross_flow_coefficient", Range::between(0.0, 3.0));
}

void read_side_force(const TomlTable& vessel, VesselParameters& p) {
  p.track_hold_n_s_per_m = vessel.number("track_hold_n_s_per_m", kNotNegative);
  p.lift_kg_per_m = vessel.number("lift_kg_per_m", kNotNegative);
  p.lift_ahead_m = vessel.number("lift_ahead_m", kEitherSign);
  p.lift_saturation_deg = vessel.number("lift_saturation_deg", Range::between(2.0, 90.0));
  p.lift_drag_n_s2_per_m2 = vessel.number("lift_drag_n_s2_per_m2", kNotNegative);
  p.trim_force_n = vessel.number("trim_force_n", kEitherSign);
  p.trim_force_n_s_per_m = vessel.number("trim_force_n_s_per_m", kEitherSign);
  p.trim_force_n_s2_per_m2 = vessel.number("trim_force_n_s2_per_m2", kEitherSign);
  p.heel_mass_kg = vessel.number("heel_mass_kg", kNotNegative);
  p.straight_line_unstable = vessel.boolean_or("straight_line_unstable", false);
}

}  // namespace

VesselParameters read_vessel_parameters(const TomlTable& vessel) {
  VesselParameters p;
  read_body(vessel, p);
  read_propellers(vessel, p);
  read_drag(vessel, p);
  read_side_force(vessel, p);
  require_sound_hull(vessel, p);
  return p;
}

VesselParameters load_vessel(const std::filesystem::path& path) {
  const TomlDocument document = TomlDocument::from_file(path);
  const VesselParameters parameters = read_vessel_parameters(document.root().table("vessel"));
  document.require_all_keys_read();
  return parameters;
}

double propeller_rad_s(const VesselParameters& vessel, std::uint8_t command) noexcept {
  if (command == 127 || command == 128) {
    return 0.0;
  }
  const double share = (command - kNeutralCommand) / kNeutralCommand;
  return share * (share > 0.0 ? vessel.propeller_ahead_rad_s : vessel.propeller_astern_rad_s);
}

double propeller_thrust_n(const VesselParameters& vessel, double rad_s) noexcept {
  const bool ahead = rad_s > 0.0;
  const double full = ahead ? vessel.propeller_ahead_rad_s : vessel.propeller_astern_rad_s;
  const double share = std::clamp(rad_s / full, -1.0, 1.0);
  return (ahead ? vessel.thrust_ahead_n : vessel.thrust_astern_n) * share * std::abs(share);
}

double thrust_n(const VesselParameters& vessel, std::uint8_t command) noexcept {
  return propeller_thrust_n(vessel, propeller_rad_s(vessel, command));
}

double settled_speed_m_s(const VesselParameters& vessel, double ahead_n) noexcept {
  const double force_n = ahead_n + vessel.trim_force_n;
  const double linear = vessel.surge_drag_n_s_per_m - vessel.trim_force_n_s_per_m;
  const double quadratic = vessel.surge_drag_n_s2_per_m2 - vessel.trim_force_n_s2_per_m2;
  const double under_root = linear * linear + 4.0 * quadratic * force_n;
  if (linear <= 0.0 || under_root < 0.0) {
    return std::numeric_limits<double>::infinity();
  }
  // The lesser root of quadratic u^2 + linear u = force, in the form that allows quadratic = 0.
  return 2.0 * force_n / (linear + std::sqrt(under_root));
}

double steady_speed_m_s(const VesselParameters& vessel, int surge_ref) noexcept {
  return settled_speed_m_s(vessel, 2.0 * thrust_n(vessel, straight_command(surge_ref)));
}

}  // namespace lodesman
