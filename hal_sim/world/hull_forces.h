// SPDX-License-Identifier: Apache-2.0
// What the water does to a hull that moves through it, and what of its accelerations that leaves:
// the equations of motion in surge, sway and yaw (Fossen, Handbook of Marine Craft Hydrodynamics
// and Motion Control, 2nd ed., ch. 3, 6 and 8), M dv/dt + C(v) v + D(v) v = thrust, all velocities
// through the water. Axes: x ahead, y to starboard, yaw clockwise positive. Pure functions.
#pragma once

#include "hal_sim/scenario/vessel_parameters.h"

namespace lodesman {

struct HullVelocity {
  double surge_m_s = 0.0;
  double sway_m_s = 0.0;
  double yaw_rate_rad_s = 0.0;
};

// Forces in newtons, the moment in newton metres about midships.
struct HullForce {
  double surge_n = 0.0;
  double sway_n = 0.0;
  double yaw_n_m = 0.0;
};

struct HullAcceleration {
  double surge_m_s2 = 0.0;
  double sway_m_s2 = 0.0;
  double yaw_rad_s2 = 0.0;
};

// Linear and quadratic drag; `lift`: nothing holds the track but the hull's own lift.
[[nodiscard]] HullForce drag(const VesselParameters& hull, const HullVelocity& v,
                             bool lift) noexcept;
// Strips across the hull, each with the quadratic drag of its own sideways speed.
[[nodiscard]] HullForce cross_flow_drag(const VesselParameters& hull,
                                        const HullVelocity& v) noexcept;
// The side force of a slender hull that is met at a drift angle: in proportion to the square of the
// speed and, until it saturates, to the angle. It acts where the water leaves the hull.
[[nodiscard]] HullForce lift_force(const VesselParameters& hull, const HullVelocity& v) noexcept;

[[nodiscard]] HullAcceleration acceleration(const VesselParameters& hull, const HullVelocity& v,
                                            const HullForce& thrust, bool lift) noexcept;

}  // namespace lodesman
