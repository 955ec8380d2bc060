// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/hull_forces.h"

#include <cmath>

#include "mid_level/base/heading.h"

namespace lodesman {
namespace {

constexpr double kWater_kg_m3 = 1025.0;
// The reference implementation's stations, each for a strip (Fossen, 2nd ed., section 6.4).
constexpr int kStrips = 21;

// What is left of the payload's weight along a deck that is not level.
[[nodiscard]] double trim_n(const VesselParameters& p, double surge_m_s) noexcept {
  return p.trim_force_n +
         (p.trim_force_n_s_per_m + p.trim_force_n_s2_per_m2 * surge_m_s) * surge_m_s;
}

// -C(v) v of rigid body and added mass (Fossen, 2nd ed., ch. 3 and 6), in the horizontal plane. The
// difference of the added masses is the Munk moment; the drift moment beyond it goes with it.
[[nodiscard]] HullForce coriolis(const VesselParameters& p, const HullVelocity& velocity) noexcept {
  const double u = velocity.surge_m_s;
  const double v = velocity.sway_m_s;
  const double r = velocity.yaw_rate_rad_s;
  const double cg_m = p.centre_of_gravity_ahead_m;
  const double added_sway_kg_m_s = p.sway_added_mass_kg * v + p.sway_yaw_added_mass_kg_m * r;
  HullForce force;
  force.surge_n = p.mass_kg * r * (v + cg_m * r) + added_sway_kg_m_s * r;
  force.sway_n = -(p.mass_kg + p.heel_mass_kg + p.surge_added_mass_kg) * u * r;
  force.yaw_n_m = -p.mass_kg * cg_m * u * r - added_sway_kg_m_s * u +
                  (p.surge_added_mass_kg - p.drift_moment_kg) * u * v;
  return force;
}

[[nodiscard]] HullForce operator+(const HullForce& a, const HullForce& b) noexcept {
  return {a.surge_n + b.surge_n, a.sway_n + b.sway_n, a.yaw_n_m + b.yaw_n_m};
}

}  // namespace

HullForce drag(const VesselParameters& p, const HullVelocity& velocity, bool lift) noexcept {
  const double u = velocity.surge_m_s;
  const double v = velocity.sway_m_s;
  const double r = velocity.yaw_rate_rad_s;
  const double sway_linear = p.sway_drag_n_s_per_m + (lift ? 0.0 : p.track_hold_n_s_per_m);
  return {-(p.surge_drag_n_s_per_m + p.surge_drag_n_s2_per_m2 * std::abs(u)) * u,
          -(sway_linear + p.sway_drag_n_s2_per_m2 * std::abs(v)) * v,
          -(p.yaw_drag_n_m_s + p.yaw_drag_n_m_s2 * std::abs(r)) * r};
}

HullForce cross_flow_drag(const VesselParameters& p, const HullVelocity& velocity) noexcept {
  HullForce force;
  if (p.cross_flow_coefficient <= 0.0) {
    return force;
  }
  const double strip_m = p.cross_flow_length_m / kStrips;
  const double half_density =
      0.5 * kWater_kg_m3 * p.cross_flow_coefficient * p.cross_flow_draught_m * strip_m;
  for (int i = 0; i < kStrips; ++i) {
    const double ahead_m = (i - (kStrips - 1) / 2.0) * strip_m;
    const double sideways_m_s = velocity.sway_m_s + ahead_m * velocity.yaw_rate_rad_s;
    const double strip_n = -half_density * std::abs(sideways_m_s) * sideways_m_s;
    force.sway_n += strip_n;
    force.yaw_n_m += ahead_m * strip_n;
  }
  return force;
}

HullForce lift_force(const VesselParameters& p, const HullVelocity& velocity) noexcept {
  const double ahead_m = velocity.surge_m_s < 0.0 ? -p.lift_ahead_m : p.lift_ahead_m;
  const double sideways_m_s = velocity.sway_m_s + ahead_m * velocity.yaw_rate_rad_s;
  const double speed_m_s = std::hypot(velocity.surge_m_s, sideways_m_s);
  if (speed_m_s <= 0.0) {
    return {};
  }
  const double sine = sideways_m_s / speed_m_s;
  const double saturation = std::sin(to_rad(p.lift_saturation_deg));
  const double of_angle = sine / std::hypot(1.0, sine / saturation);
  const double side_n = -p.lift_kg_per_m * speed_m_s * speed_m_s * of_angle;
  const double separated_n =
      -p.lift_drag_n_s2_per_m2 * std::abs(velocity.sway_m_s) * velocity.sway_m_s;
  return {0.0, side_n + separated_n, ahead_m * side_n};
}

HullAcceleration acceleration(const VesselParameters& p, const HullVelocity& velocity,
                              const HullForce& thrust, bool lift) noexcept {
  HullForce sum = thrust + coriolis(p, velocity) + drag(p, velocity, lift) +
                  cross_flow_drag(p, velocity) + (lift ? lift_force(p, velocity) : HullForce{});
  sum.surge_n += trim_n(p, velocity.surge_m_s);
  const double cg_m = p.centre_of_gravity_ahead_m;
  const double sway_kg = p.mass_kg + p.sway_added_mass_kg;
  const double coupling_kg_m = p.mass_kg * cg_m + p.sway_yaw_added_mass_kg_m;
  const double yaw_kg_m2 =
      p.yaw_inertia_kg_m2 + p.mass_kg * cg_m * cg_m + p.yaw_added_inertia_kg_m2;
  const double determinant = sway_kg * yaw_kg_m2 - coupling_kg_m * coupling_kg_m;
  return {sum.surge_n / (p.mass_kg + p.surge_added_mass_kg),
          (yaw_kg_m2 * sum.sway_n - coupling_kg_m * sum.yaw_n_m) / determinant,
          (sway_kg * sum.yaw_n_m - coupling_kg_m * sum.sway_n) / determinant};
}

}  // namespace lodesman
