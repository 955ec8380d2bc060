// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/vessel_parameters.h"

#include <cmath>

namespace lodesman {
namespace {

constexpr double kNeutralCommand = 128.0;

// The integer command of eqs 13-14 for a straight course, SurgeRef >= 0. Written here once more
// on purpose: the plant must not agree with the controller by construction.
[[nodiscard]] std::uint8_t straight_command(int surge_ref) noexcept {
  return static_cast<std::uint8_t>(12.8 * std::sqrt(surge_ref / 2.0) + kNeutralCommand);
}

}  // namespace

VesselParameters read_vessel_parameters(const TomlTable& vessel) {
  const Range positive = Range::above(0.0, 1e6);
  const Range not_negative = Range::between(0.0, 1e6);
  VesselParameters p;
  p.mass_kg = vessel.number("mass_kg", positive);
  p.yaw_inertia_kg_m2 = vessel.number("yaw_inertia_kg_m2", positive);
  p.hull_length_m = vessel.number("hull_length_m", positive);
  p.hull_beam_m = vessel.number("hull_beam_m", positive);
  p.thruster_offset_m = vessel.number("thruster_offset_m", positive);
  p.full_thrust_n = vessel.number("full_thrust_n", positive);
  p.surge_drag_n_s_per_m = vessel.number("surge_drag_n_s_per_m", positive);
  p.surge_drag_n_s2_per_m2 = vessel.number("surge_drag_n_s2_per_m2", not_negative);
  p.sway_drag_n_s_per_m = vessel.number("sway_drag_n_s_per_m", positive);
  p.sway_drag_n_s2_per_m2 = vessel.number("sway_drag_n_s2_per_m2", not_negative);
  p.yaw_drag_n_m_s = vessel.number("yaw_drag_n_m_s", positive);
  p.yaw_drag_n_m_s2 = vessel.number("yaw_drag_n_m_s2", not_negative);
  p.drift_moment_kg = vessel.number("drift_moment_kg", not_negative);
  p.lift_share = vessel.number("lift_share", Range::between(0.0, 0.999));
  p.lift_half_surge_m_s = vessel.number("lift_half_surge_m_s", positive);
  p.step_s_max = vessel.number("step_s_max", Range::above(0.0, 0.1));
  return p;
}

VesselParameters load_vessel(const std::filesystem::path& path) {
  const TomlDocument document = TomlDocument::from_file(path);
  const VesselParameters parameters = read_vessel_parameters(document.root().table("vessel"));
  document.require_all_keys_read();
  return parameters;
}

double thrust_n(const VesselParameters& vessel, std::uint8_t command) noexcept {
  if (command == 127 || command == 128) {
    return 0.0;
  }
  const double share = (command - kNeutralCommand) / kNeutralCommand;
  return vessel.full_thrust_n * share * std::abs(share);
}

double steady_speed_m_s(const VesselParameters& vessel, int surge_ref) noexcept {
  const double force_n = 2.0 * thrust_n(vessel, straight_command(surge_ref));
  const double linear = vessel.surge_drag_n_s_per_m;
  const double quadratic = vessel.surge_drag_n_s2_per_m2;
  // The positive root of quadratic u^2 + linear u = force, in the form that allows quadratic = 0.
  return 2.0 * force_n / (linear + std::sqrt(linear * linear + 4.0 * quadratic * force_n));
}

}  // namespace lodesman
