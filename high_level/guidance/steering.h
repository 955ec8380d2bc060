// SPDX-License-Identifier: Apache-2.0
// How the boat is steered: towards a point or along a course in water that moves, and at a place
// that it keeps. One law for the controller, which sails by it, and for the manoeuvres, which are
// foreseen by it. Pure functions; any thread.
#pragma once

#include "mid_level/base/frames.h"
#include "mid_level/base/heading.h"

namespace lodesman {

struct SteeringOptions {
  double heading_gain_per_deg = 0.0;  // [1/deg] > 0 Kh of eq. 9
  double heading_lead_s = 0.0;        // [s] it steers by the heading that it will have by then
};

// The speed that a mission is sailed at.
struct Cruise {
  int surge_ref = 0;       // [-] eq. 7
  double speed_m_s = 0.0;  // [m/s] > 0 what that holds through the water
};

// Nearer than this [m] a point gives no direction.
inline constexpr double kAim_m = 0.2;

// What is wanted of the helm.
struct Steering {
  double speed_share = 0.0;  // [-] of the cruise, negative astern
  Heading reference;         // where the bow shall point
  bool turns = true;         // false: neutral, wherever it points
};

// Along a way over ground [world], whose length does not matter; slower in a sharp turn.
[[nodiscard]] Steering steer_along(const Eigen::Vector2d& way, double speed_share,
                                   const Cruise& cruise, const Eigen::Vector2d& current_m_s,
                                   Heading heading) noexcept;

// Back to a place [m] [world] away the faster the farther it is, on top of what the current asks
// for; bow or stern first, whichever is nearer. There, it turns to where it shall face.
[[nodiscard]] Steering keep_place(const Eigen::Vector2d& way, Heading faced, double speed_share_max,
                                  const Cruise& cruise, const Eigen::Vector2d& current_m_s,
                                  Heading heading) noexcept;

// References for the thrusters, each in [-100, 100]; `valid` is false, and both are 0, where what
// is wanted is no number: it would be some whole number in the end.
struct Helm {
  int surge_ref = 0;
  int head_ref = 0;
  bool valid = true;
};
[[nodiscard]] Helm helm_of(double speed_share, Heading heading, Heading reference, int surge_ref,
                           double heading_gain_per_deg) noexcept;
// Steered by the heading that it will have swung to.
[[nodiscard]] Helm helm_of(const Steering& steering, double heading_rad, double yaw_rate_rad_s,
                           const Cruise& cruise, const SteeringOptions& options) noexcept;

}  // namespace lodesman
