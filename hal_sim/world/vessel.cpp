// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/vessel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal_sim/world/hull_forces.h"

namespace lodesman {
namespace {

// x, y, heading, surge, sway, yaw rate.
using StateVector = Eigen::Matrix<double, 6, 1>;

[[nodiscard]] HullForce thrust_of(const VesselParameters& p, PropellerSpeeds speeds) noexcept {
  const double left_n = propeller_thrust_n(p, speeds.left_rad_s);
  const double right_n = propeller_thrust_n(p, speeds.right_rad_s);
  return {left_n + right_n, 0.0, (left_n - right_n) * p.thruster_offset_m};
}

[[nodiscard]] StateVector rates(const VesselParameters& p, const WaterConditions& water,
                                const HullForce& thrust, const StateVector& s) noexcept {
  const double c = std::cos(s[2]);
  const double d = std::sin(s[2]);
  const HullVelocity v{s[3], s[4], s[5]};
  const HullAcceleration a = acceleration(p, v, thrust, water.lift);
  StateVector rate;
  rate << v.sway_m_s * c + v.surge_m_s * d + water.current_x_m_s,
      v.surge_m_s * c - v.sway_m_s * d + water.current_y_m_s, v.yaw_rate_rad_s, a.surge_m_s2,
      a.sway_m_s2, a.yaw_rad_s2;
  return rate;
}

// The thrust at the beginning, in the middle and at the end of a step.
struct ThrustOverStep {
  HullForce first;
  HullForce middle;
  HullForce last;
};

[[nodiscard]] StateVector runge_kutta_4(const VesselParameters& p, const WaterConditions& water,
                                        const ThrustOverStep& thrust, const StateVector& s,
                                        double h_s) noexcept {
  const StateVector k1 = rates(p, water, thrust.first, s);
  const StateVector k2 = rates(p, water, thrust.middle, s + 0.5 * h_s * k1);
  const StateVector k3 = rates(p, water, thrust.middle, s + 0.5 * h_s * k2);
  const StateVector k4 = rates(p, water, thrust.last, s + h_s * k3);
  return s + (h_s / 6.0) * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

// A lag of the first order, exactly.
[[nodiscard]] PropellerSpeeds after(double time_s, double lag_s, PropellerSpeeds from,
                                    PropellerSpeeds told) noexcept {
  const double left = lag_s > 0.0 ? std::exp(-time_s / lag_s) : 0.0;
  return {told.left_rad_s + (from.left_rad_s - told.left_rad_s) * left,
          told.right_rad_s + (from.right_rad_s - told.right_rad_s) * left};
}

[[nodiscard]] PropellerSpeeds limited(const VesselParameters& p, PropellerSpeeds told) noexcept {
  const auto limit = [&](double rad_s) {
    return std::clamp(rad_s, -p.propeller_astern_rad_s, p.propeller_ahead_rad_s);
  };
  return {limit(told.left_rad_s), limit(told.right_rad_s)};
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
  PropellerSpeeds told{propeller_rad_s(parameters_, command.left),
                       propeller_rad_s(parameters_, command.right)};
  if (parameters_.wires_swapped) {
    std::swap(told.left_rad_s, told.right_rad_s);
  }
  told.left_rad_s *= parameters_.left_reversed ? -1.0 : 1.0;
  told.right_rad_s *= parameters_.right_reversed ? -1.0 : 1.0;
  advance(dt_s, told);
}

void Vessel::advance(double dt_s, PropellerSpeeds wanted) noexcept {
  if (!(dt_s > 0.0)) {
    return;
  }
  const PropellerSpeeds told = limited(parameters_, wanted);
  // A hair more than step_s_max is one step, not two.
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / parameters_.step_s_max - 1e-6)));
  const double h_s = dt_s / steps;
  const double lag_s = parameters_.propeller_lag_s;
  StateVector s;
  s << state_.pose.p_WV.xy_m, state_.pose.heading.rad(), state_.surge_m_s, state_.sway_m_s,
      state_.yaw_rate_rad_s;
  // Without a lag they run as told from the beginning of the step on.
  PropellerSpeeds speeds = lag_s > 0.0 ? state_.propellers : told;
  for (int i = 0; i < steps; ++i) {
    const PropellerSpeeds middle = after(h_s / 2.0, lag_s, speeds, told);
    const PropellerSpeeds last = after(h_s, lag_s, speeds, told);
    s = runge_kutta_4(parameters_, water_,
                      {thrust_of(parameters_, speeds), thrust_of(parameters_, middle),
                       thrust_of(parameters_, last)},
                      s, h_s);
    speeds = last;
  }
  state_.pose = {{s.head<2>()}, Heading::clockwise_from_y_rad(s[2])};
  state_.surge_m_s = s[3];
  state_.sway_m_s = s[4];
  state_.yaw_rate_rad_s = s[5];
  state_.propellers = speeds;
}

Eigen::Vector2d Vessel::ground_velocity_V_m_s() const noexcept {
  const VehiclePose turned{{}, state_.pose.heading};
  const WorldPoint current_W{{water_.current_x_m_s, water_.current_y_m_s}};
  return Eigen::Vector2d{state_.sway_m_s, state_.surge_m_s} + turned.to_vehicle(current_W).xy_m;
}

}  // namespace lodesman
