// SPDX-License-Identifier: Apache-2.0
// How the boat answers its thrusters: surge, sway and yaw in a plane, with added mass, Coriolis
// terms, linear and quadratic drag (Fossen, Handbook of Marine Craft Hydrodynamics and Motion
// Control, 2nd ed., ch. 6-7, in three degrees of freedom). Thrust ahead is what holds the speed
// that the boat's own speed table says, so that the steady speeds are the measured ones. Plain
// values; any thread; no allocation.
#pragma once

#include <Eigen/Core>

#include "mid_level/base/frames.h"
#include "mid_level/base/speed_table.h"

namespace lodesman {

// Added masses are what of the water moves along with the hull.
struct VehicleModelParameters {
  double mass_kg = 1.0;                  // > 0
  double added_mass_surge_kg = 0.0;      // >= 0
  double added_mass_sway_kg = 0.0;       // >= 0; what it exceeds surge by turns a drifting hull
  double yaw_inertia_kg_m2 = 1.0;        // > 0
  double added_yaw_inertia_kg_m2 = 0.0;  // >= 0
  double surge_drag_n_s_per_m = 1.0;     // > 0
  double surge_drag_n_s2_per_m2 = 0.0;   // >= 0
  double sway_drag_n_s_per_m = 1.0;      // > 0
  double sway_drag_n_s2_per_m2 = 0.0;    // >= 0
  double yaw_drag_n_m_s = 1.0;           // > 0
  double yaw_drag_n_m_s2 = 0.0;          // >= 0
  double turning_n_m_per_head_ref =
      0.0;  // > 0 where it is steered, of both thrusters, a unit of HeadRef
};

// Through the water: surge [m/s] ahead, sway [m/s] to starboard, yaw rate [rad/s] clockwise.
using BodyVelocity = Eigen::Vector3d;

// What the thrusters do to the hull.
struct ThrustForces {
  double ahead_n = 0.0;
  double turning_n_m = 0.0;  // clockwise positive
};

// A hull under way.
struct VehicleMotion {
  WorldPoint position;
  double heading_rad = 0.0;  // clockwise from north; not wrapped, so that turns can be counted
  BodyVelocity velocity = BodyVelocity::Zero();
};

class VehicleModel {
 public:
  VehicleModel(const VehicleModelParameters& parameters, const SpeedTable& speeds) noexcept
      : p_{parameters}, speeds_{speeds} {}

  // Of references that were applied, each in [-100, 100].
  [[nodiscard]] ThrustForces forces(int surge_ref, int head_ref) const noexcept;

  // [m/s^2, m/s^2, rad/s^2]
  [[nodiscard]] Eigen::Vector3d acceleration(const BodyVelocity& velocity,
                                             const ThrustForces& forces) const noexcept;
  // Of the acceleration, by the velocity.
  [[nodiscard]] Eigen::Matrix3d acceleration_slope(const BodyVelocity& velocity) const noexcept;

  // One step of the midpoint rule. dt_s: [0, kStepMax_s]; longer is unstable where sway drag is
  // strong. current_m_s: of the water [world].
  [[nodiscard]] VehicleMotion advanced(const VehicleMotion& motion, const ThrustForces& forces,
                                       const Eigen::Vector2d& current_m_s,
                                       double dt_s) const noexcept;
  static constexpr double kStepMax_s = 0.05;

  // One long step, for looking ahead: each velocity runs exponentially towards where forces, drag
  // and what the others ask for would hold it, these taken from the middle of the step. Stable for
  // any dt_s >= 0; of the second order.
  [[nodiscard]] VehicleMotion carried_on(const VehicleMotion& motion, const ThrustForces& forces,
                                         const Eigen::Vector2d& current_m_s,
                                         double dt_s) const noexcept;
  // The same of the surge [m/s] alone, on a straight way.
  [[nodiscard]] double surge_carried_on(double surge_m_s, int surge_ref,
                                        double dt_s) const noexcept;

  // The way [m] through the water from so fast [m/s] >= 0 ahead to rest, thrusters at neutral.
  [[nodiscard]] double stopping_way_m(double speed_m_s) const noexcept;
  // The way [m] made good ahead, at that speed, from full HeadRef until it heads 90 degrees off:
  // the lag of the yaw and the radius after it. As if it lost no speed and did not slip, so no
  // shorter.
  [[nodiscard]] double turning_way_m(double speed_m_s) const noexcept;

 private:
  struct Pull;
  [[nodiscard]] Pull pull(const BodyVelocity& velocity, const ThrustForces& forces) const noexcept;

  VehicleModelParameters p_;
  SpeedTable speeds_;
};

// The velocity over ground [m/s] [world] of a hull with that heading.
[[nodiscard]] Eigen::Vector2d velocity_over_ground(double heading_rad, const BodyVelocity& velocity,
                                                   const Eigen::Vector2d& current_m_s) noexcept;

}  // namespace lodesman
