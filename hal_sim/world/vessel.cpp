// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/vessel.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

// x, y, heading, surge, sway, yaw rate.
using StateVector = Eigen::Matrix<double, 6, 1>;

struct Thrust {
  double ahead_n = 0.0;
  double turning_n_m = 0.0;  // clockwise positive
};

// How much of the linear sway drag is left where lift acts: the faster the hull goes ahead, the
// less it holds against sliding, so that the lateral force which lift adds grows with surge speed
// and with the drift angle, and never outweighs the drag. (Ours: the paper gives no figures.)
[[nodiscard]] double sway_hold(const VesselParameters& p, double surge_m_s) noexcept {
  const double u2 = surge_m_s * surge_m_s;
  return 1.0 - p.lift_share * u2 / (u2 + p.lift_half_surge_m_s * p.lift_half_surge_m_s);
}

[[nodiscard]] StateVector rates(const VesselParameters& p, const WaterConditions& water,
                                const Thrust& thrust, const StateVector& s) noexcept {
  const double c = std::cos(s[2]);
  const double d = std::sin(s[2]);
  const double u = s[3];
  const double v = s[4];
  const double r = s[5];
  const double hold = water.lift ? sway_hold(p, u) : 1.0;
  const double surge_drag_n = (p.surge_drag_n_s_per_m + p.surge_drag_n_s2_per_m2 * std::abs(u)) * u;
  const double sway_drag_n =
      (p.sway_drag_n_s_per_m * hold + p.sway_drag_n_s2_per_m2 * std::abs(v)) * v;
  const double yaw_drag_n_m = (p.yaw_drag_n_m_s + p.yaw_drag_n_m_s2 * std::abs(r)) * r;
  // The water that meets a drifting hull turns it further out of its course.
  const double drift_n_m = -p.drift_moment_kg * u * v;
  StateVector rate;
  rate << v * c + u * d + water.current_x_m_s,  //
      u * c - v * d + water.current_y_m_s,      //
      r,                                        //
      (thrust.ahead_n - surge_drag_n) / p.mass_kg + v * r, -sway_drag_n / p.mass_kg - u * r,
      (thrust.turning_n_m + drift_n_m - yaw_drag_n_m) / p.yaw_inertia_kg_m2;
  return rate;
}

[[nodiscard]] StateVector runge_kutta_4(const VesselParameters& p, const WaterConditions& water,
                                        const Thrust& thrust, const StateVector& s,
                                        double h_s) noexcept {
  const StateVector k1 = rates(p, water, thrust, s);
  const StateVector k2 = rates(p, water, thrust, s + 0.5 * h_s * k1);
  const StateVector k3 = rates(p, water, thrust, s + 0.5 * h_s * k2);
  const StateVector k4 = rates(p, water, thrust, s + h_s * k3);
  return s + (h_s / 6.0) * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

}  // namespace

Vessel::Vessel(const VesselParameters& parameters, const WaterConditions& water,
               const VehiclePose& start) noexcept
    : parameters_{parameters}, water_{water} {
  state_.pose = start;
}

Vessel Vessel::under_way(const VesselParameters& parameters, const WaterConditions& water,
                         const VesselState& state) noexcept {
  Vessel vessel{parameters, water, state.pose};
  vessel.state_ = state;
  return vessel;
}

void Vessel::advance(double dt_s, ThrustCommand command) noexcept {
  if (!(dt_s > 0.0)) {
    return;
  }
  const double left_n = thrust_n(parameters_, command.left);
  const double right_n = thrust_n(parameters_, command.right);
  const Thrust thrust{left_n + right_n, (left_n - right_n) * parameters_.thruster_offset_m};
  // A hair more than step_s_max is one step, not two.
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / parameters_.step_s_max - 1e-6)));
  const double h_s = dt_s / steps;
  StateVector s;
  s << state_.pose.p_WV.xy_m, state_.pose.heading.rad(), state_.surge_m_s, state_.sway_m_s,
      state_.yaw_rate_rad_s;
  for (int i = 0; i < steps; ++i) {
    s = runge_kutta_4(parameters_, water_, thrust, s, h_s);
  }
  state_.pose = {{s.head<2>()}, Heading::clockwise_from_y_rad(s[2])};
  state_.surge_m_s = s[3];
  state_.sway_m_s = s[4];
  state_.yaw_rate_rad_s = s[5];
}

Eigen::Vector2d Vessel::ground_velocity_V_m_s() const noexcept {
  const VehiclePose turned{{}, state_.pose.heading};
  const WorldPoint current_W{{water_.current_x_m_s, water_.current_y_m_s}};
  return Eigen::Vector2d{state_.sway_m_s, state_.surge_m_s} + turned.to_vehicle(current_W).xy_m;
}

}  // namespace lodesman
