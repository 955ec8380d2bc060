// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/vehicle_model.h"

#include <cmath>

namespace lodesman {
namespace {

constexpr int kMaxHeadRef = 100;

[[nodiscard]] double drag(double linear, double quadratic, double velocity) noexcept {
  return (linear + quadratic * std::abs(velocity)) * velocity;
}
[[nodiscard]] double drag_slope(double linear, double quadratic, double velocity) noexcept {
  return linear + 2.0 * quadratic * std::abs(velocity);
}

// [-] (1 - e^-x) / x, x >= 0, with 1 + x + x^2/2 + x^3/6 for e^x: much faster, 0.5 % off at x =
// 0.65, which is a quarter of a second of the shipped hull's yaw, and stable for ever longer steps.
[[nodiscard]] double mean_decay(double x) noexcept {
  const double rest = 1.0 + x * (0.5 + x / 6.0);
  return rest / (1.0 + x * rest);
}

// How far [m or rad] it runs out against such drag alone.
[[nodiscard]] double run_out(double inertia, double linear, double quadratic,
                             double velocity) noexcept {
  const double x = quadratic * velocity / linear;
  return inertia * velocity / linear * (x > 1e-9 ? std::log1p(x) / x : 1.0);
}

}  // namespace

// What changes each velocity: an acceleration, and a rate [1/s] > 0 at which it fades.
struct VehicleModel::Pull {
  Eigen::Array3d by;
  Eigen::Array3d fading_per_s;
};

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

VehicleModel::Pull VehicleModel::pull(const BodyVelocity& velocity,
                                      const ThrustForces& forces) const noexcept {
  const double u = velocity[0];
  const double v = velocity[1];
  const double r = velocity[2];
  const double surge_kg = p_.mass_kg + p_.added_mass_surge_kg;
  const double sway_kg = p_.mass_kg + p_.added_mass_sway_kg;
  const double yaw_kg_m2 = p_.yaw_inertia_kg_m2 + p_.added_yaw_inertia_kg_m2;
  return {{(forces.ahead_n + sway_kg * v * r) / surge_kg, -surge_kg * u * r / sway_kg,
           (forces.turning_n_m - (sway_kg - surge_kg) * u * v) / yaw_kg_m2},
          {(p_.surge_drag_n_s_per_m + p_.surge_drag_n_s2_per_m2 * std::abs(u)) / surge_kg,
           (p_.sway_drag_n_s_per_m + p_.sway_drag_n_s2_per_m2 * std::abs(v)) / sway_kg,
           (p_.yaw_drag_n_m_s + p_.yaw_drag_n_m_s2 * std::abs(r)) / yaw_kg_m2}};
}

VehicleMotion VehicleModel::carried_on(const VehicleMotion& motion, const ThrustForces& forces,
                                       const Eigen::Vector2d& current_m_s,
                                       double dt_s) const noexcept {
  const auto after = [&motion](const Pull& pull, double time_s) -> BodyVelocity {
    const Eigen::Array3d v = motion.velocity.array();
    const Eigen::Array3d rate = pull.by - pull.fading_per_s * v;
    const Eigen::Array3d x = pull.fading_per_s * time_s;
    return v + time_s * rate * Eigen::Array3d{mean_decay(x[0]), mean_decay(x[1]), mean_decay(x[2])};
  };
  const BodyVelocity middle = after(pull(motion.velocity, forces), 0.5 * dt_s);
  const double middle_rad = motion.heading_rad + 0.25 * dt_s * (motion.velocity[2] + middle[2]);
  VehicleMotion next;
  next.velocity = after(pull(middle, forces), dt_s);
  next.heading_rad = motion.heading_rad + dt_s * middle[2];
  next.position = {motion.position.xy_m +
                   dt_s * velocity_over_ground(middle_rad, middle, current_m_s)};
  return next;
}

double VehicleModel::surge_carried_on(double surge_m_s, int surge_ref, double dt_s) const noexcept {
  VehicleMotion motion;
  motion.velocity[0] = surge_m_s;
  return carried_on(motion, forces(surge_ref, 0), Eigen::Vector2d::Zero(), dt_s).velocity[0];
}

double VehicleModel::stopping_way_m(double speed_m_s) const noexcept {
  return run_out(p_.mass_kg + p_.added_mass_surge_kg, p_.surge_drag_n_s_per_m,
                 p_.surge_drag_n_s2_per_m2, speed_m_s);
}

double VehicleModel::turning_way_m(double speed_m_s) const noexcept {
  const double linear = p_.yaw_drag_n_m_s;
  const double turning_n_m = forces(0, kMaxHeadRef).turning_n_m;
  // What the drag holds: linear r + quadratic r^2 = turning, written so that 0 may be quadratic.
  const double steady_rad_s =
      2.0 * turning_n_m /
      (linear + std::sqrt(linear * linear + 4.0 * p_.yaw_drag_n_m_s2 * turning_n_m));
  const double lag_s = (p_.yaw_inertia_kg_m2 + p_.added_yaw_inertia_kg_m2) / linear;
  return speed_m_s * (lag_s + 1.0 / steady_rad_s);
}

Eigen::Vector2d velocity_over_ground(double heading_rad, const BodyVelocity& velocity,
                                     const Eigen::Vector2d& current_m_s) noexcept {
  const double s = std::sin(heading_rad);
  const double c = std::cos(heading_rad);
  return {velocity[0] * s + velocity[1] * c + current_m_s.x(),
          velocity[0] * c - velocity[1] * s + current_m_s.y()};
}

}  // namespace lodesman
