// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/vehicle_model.h"

#include <cmath>

namespace lodesman {
namespace {

[[nodiscard]] double drag(double linear, double quadratic, double velocity) noexcept {
  return (linear + quadratic * std::abs(velocity)) * velocity;
}
[[nodiscard]] double drag_slope(double linear, double quadratic, double velocity) noexcept {
  return linear + 2.0 * quadratic * std::abs(velocity);
}

}  // namespace

ThrustForces VehicleModel::forces(int surge_ref, int head_ref) const noexcept {
  const double steady_m_s = speeds_.speed_m_s(surge_ref);
  return {drag(p_.surge_drag_n_s_per_m, p_.surge_drag_n_s2_per_m2, steady_m_s),
          p_.turning_n_m_per_head_ref * head_ref};
}

Eigen::Vector3d VehicleModel::acceleration(const BodyVelocity& velocity,
                                           const ThrustForces& forces) const noexcept {
  const double u = velocity[0];
  const double v = velocity[1];
  const double r = velocity[2];
  const double surge_kg = p_.mass_kg + p_.added_mass_surge_kg;
  const double sway_kg = p_.mass_kg + p_.added_mass_sway_kg;
  const double yaw_kg_m2 = p_.yaw_inertia_kg_m2 + p_.added_yaw_inertia_kg_m2;
  const double surge_n =
      forces.ahead_n - drag(p_.surge_drag_n_s_per_m, p_.surge_drag_n_s2_per_m2, u);
  const double sway_n = -drag(p_.sway_drag_n_s_per_m, p_.sway_drag_n_s2_per_m2, v);
  const double yaw_n_m = forces.turning_n_m - drag(p_.yaw_drag_n_m_s, p_.yaw_drag_n_m_s2, r);
  return {(surge_n + sway_kg * v * r) / surge_kg, (sway_n - surge_kg * u * r) / sway_kg,
          (yaw_n_m - (sway_kg - surge_kg) * u * v) / yaw_kg_m2};
}

Eigen::Matrix3d VehicleModel::acceleration_slope(const BodyVelocity& velocity) const noexcept {
  const double u = velocity[0];
  const double v = velocity[1];
  const double r = velocity[2];
  const double surge_kg = p_.mass_kg + p_.added_mass_surge_kg;
  const double sway_kg = p_.mass_kg + p_.added_mass_sway_kg;
  const double yaw_kg_m2 = p_.yaw_inertia_kg_m2 + p_.added_yaw_inertia_kg_m2;
  const double munk_kg = sway_kg - surge_kg;
  Eigen::Matrix3d slope;
  slope << -drag_slope(p_.surge_drag_n_s_per_m, p_.surge_drag_n_s2_per_m2, u) / surge_kg,
      sway_kg * r / surge_kg, sway_kg * v / surge_kg,  //
      -surge_kg * r / sway_kg,
      -drag_slope(p_.sway_drag_n_s_per_m, p_.sway_drag_n_s2_per_m2, v) / sway_kg,
      -surge_kg * u / sway_kg,  //
      -munk_kg * v / yaw_kg_m2, -munk_kg * u / yaw_kg_m2,
      -drag_slope(p_.yaw_drag_n_m_s, p_.yaw_drag_n_m_s2, r) / yaw_kg_m2;
  return slope;
}

VehicleMotion VehicleModel::advanced(const VehicleMotion& motion, const ThrustForces& forces,
                                     const Eigen::Vector2d& current_m_s,
                                     double dt_s) const noexcept {
  const BodyVelocity middle = motion.velocity + 0.5 * dt_s * acceleration(motion.velocity, forces);
  const double middle_rad = motion.heading_rad + 0.5 * dt_s * motion.velocity[2];
  VehicleMotion next;
  next.position = {motion.position.xy_m +
                   dt_s * velocity_over_ground(middle_rad, middle, current_m_s)};
  next.heading_rad = motion.heading_rad + dt_s * middle[2];
  next.velocity = motion.velocity + dt_s * acceleration(middle, forces);
  return next;
}

Eigen::Vector2d velocity_over_ground(double heading_rad, const BodyVelocity& velocity,
                                     const Eigen::Vector2d& current_m_s) noexcept {
  const double s = std::sin(heading_rad);
  const double c = std::cos(heading_rad);
  return {velocity[0] * s + velocity[1] * c + current_m_s.x(),
          velocity[0] * c - velocity[1] * s + current_m_s.y()};
}

}  // namespace lodesman
