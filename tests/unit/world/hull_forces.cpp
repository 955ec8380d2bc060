// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/hull_forces.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/scenario/hull_check.h"
#include "hal_sim/world/vessel.h"
#include "tests/support/catch.h"
#include "tests/support/shipped_vessel.h"

namespace lodesman {
namespace {

using testing::shipped_vessel;

[[nodiscard]] VesselParameters otter() { return load_vessel(LODESMAN_OTTER); }

// A hull that nothing brakes.
[[nodiscard]] VesselParameters frictionless() {
  VesselParameters p = otter();
  p.surge_drag_n_s_per_m = p.sway_drag_n_s_per_m = 0.0;
  p.yaw_drag_n_m_s = p.yaw_drag_n_m_s2 = 0.0;
  p.cross_flow_coefficient = p.heel_mass_kg = 0.0;
  p.trim_force_n = p.trim_force_n_s_per_m = p.trim_force_n_s2_per_m2 = 0.0;
  p.sway_yaw_added_mass_kg_m = 7.0;
  return p;
}

[[nodiscard]] double energy_j(const VesselParameters& p, const VesselState& s) {
  const double cg_m = p.centre_of_gravity_ahead_m;
  const double inertia = p.yaw_inertia_kg_m2 + p.mass_kg * cg_m * cg_m + p.yaw_added_inertia_kg_m2;
  const double coupling = p.mass_kg * cg_m + p.sway_yaw_added_mass_kg_m;
  return 0.5 * (p.mass_kg + p.surge_added_mass_kg) * s.surge_m_s * s.surge_m_s +
         0.5 * (p.mass_kg + p.sway_added_mass_kg) * s.sway_m_s * s.sway_m_s +
         coupling * s.sway_m_s * s.yaw_rate_rad_s +
         0.5 * inertia * s.yaw_rate_rad_s * s.yaw_rate_rad_s;
}

TEST_CASE("hull: Coriolis forces of body and added mass do no work", "[hal_sim][vessel]") {
  const VesselParameters p = frictionless();
  VesselState start;
  start.surge_m_s = 1.0;
  start.sway_m_s = 0.3;
  start.yaw_rate_rad_s = 0.5;
  Vessel vessel = Vessel::under_way(p, {}, start);
  double most_changed_m_s = 0.0;
  for (int i = 0; i < 100; ++i) {
    vessel.advance(0.1, PropellerSpeeds{});
    most_changed_m_s = std::max(most_changed_m_s, std::abs(vessel.state().sway_m_s - 0.3));
    CHECK(energy_j(p, vessel.state()) == Approx(energy_j(p, start)).epsilon(1e-5));
  }
  CHECK(most_changed_m_s > 0.3);
}

TEST_CASE("hull: cross-flow drag is that of a plate, sideways and about its middle",
          "[hal_sim][vessel]") {
  VesselParameters p = otter();
  const double of_plate = 0.5 * 1025.0 * p.cross_flow_coefficient * p.cross_flow_draught_m;
  const double l = p.cross_flow_length_m;
  const HullForce sideways = cross_flow_drag(p, {1.0, -0.4, 0.0});
  CHECK(sideways.sway_n == Approx(of_plate * l * 0.16));
  CHECK(sideways.surge_n == Approx(0.0).margin(0.0));
  CHECK(sideways.yaw_n_m == Approx(0.0).margin(1e-9));
  const HullForce turning = cross_flow_drag(p, {1.0, 0.0, 0.4});
  CHECK(turning.yaw_n_m == Approx(-of_plate * 0.16 * std::pow(l, 4) / 32.0).epsilon(0.01));
  CHECK(turning.sway_n == Approx(0.0).margin(1e-9));
  p.cross_flow_coefficient = 0.0;
  CHECK(cross_flow_drag(p, {0.0, 1.0, 1.0}).sway_n == Approx(0.0).margin(0.0));
}

TEST_CASE("hull: lift grows with the speed squared and the drift angle, and saturates",
          "[hal_sim][vessel]") {
  VesselParameters p = shipped_vessel();
  p.lift_drag_n_s2_per_m2 = 0.0;
  const auto side_n = [&](double speed_m_s, double drift_deg) {
    const double drift_rad = to_rad(drift_deg);
    return lift_force(p, {speed_m_s * std::cos(drift_rad), -speed_m_s * std::sin(drift_rad), 0.0})
        .sway_n;
  };
  CHECK(side_n(1.0, 0.0) == Approx(0.0).margin(1e-12));
  CHECK(side_n(1.0, 1.0) == Approx(p.lift_kg_per_m * to_rad(1.0)).epsilon(0.01));
  CHECK(side_n(1.0, 2.0) == Approx(2.0 * side_n(1.0, 1.0)).epsilon(0.03));
  CHECK(side_n(2.0, 5.0) == Approx(4.0 * side_n(1.0, 5.0)));
  CHECK(side_n(1.0, -5.0) == Approx(-side_n(1.0, 5.0)));
  // Far beyond the angle of saturation it is nearly the same as at three times that angle.
  const double most_n = p.lift_kg_per_m * std::sin(to_rad(p.lift_saturation_deg));
  CHECK(side_n(1.0, 60.0) == Approx(most_n).epsilon(0.03));
  CHECK(side_n(1.0, 30.0) > 0.93 * most_n);
  CHECK(lift_force(p, {}).sway_n == Approx(0.0).margin(0.0));
  // What of the flow no longer follows the hull.
  const double without_n = side_n(1.0, 30.0);
  p.lift_drag_n_s2_per_m2 = 100.0;
  CHECK(side_n(1.0, 30.0) == Approx(without_n + 25.0));
}

TEST_CASE("hull: lift acts at the stern, whichever end that is", "[hal_sim][vessel]") {
  const VesselParameters p = shipped_vessel();
  const HullForce ahead = lift_force(p, {1.0, 0.1, 0.0});
  const HullForce astern = lift_force(p, {-1.0, 0.1, 0.0});
  CHECK(ahead.sway_n < 0.0);
  CHECK(ahead.yaw_n_m > 0.0);  // towards where it slides
  CHECK(astern.sway_n == Approx(ahead.sway_n));
  CHECK(astern.yaw_n_m == Approx(-ahead.yaw_n_m));
  // In a turn on the spot of midships the stern swings, and is held.
  CHECK(lift_force(p, {1.0, 0.0, 0.1}).yaw_n_m < 0.0);
}

TEST_CASE("hull: propellers come within 1/e of their speed in their lag, and pull less astern",
          "[hal_sim][vessel]") {
  Vessel vessel{otter(), {}, {}};
  vessel.advance(0.1, PropellerSpeeds{80.0, -80.0});
  CHECK(vessel.state().propellers.left_rad_s == Approx(80.0 * (1.0 - std::exp(-1.0))));
  CHECK(vessel.state().propellers.right_rad_s == Approx(-80.0 * (1.0 - std::exp(-1.0))));
  vessel.advance(5.0, PropellerSpeeds{1e9, -1e9});
  CHECK(vessel.state().propellers.left_rad_s == Approx(103.93));
  CHECK(vessel.state().propellers.right_rad_s == Approx(-101.737));
  CHECK(propeller_thrust_n(otter(), 60.0) == Approx(0.01108 * 3600.0).epsilon(1e-4));
  CHECK(propeller_thrust_n(otter(), -60.0) == Approx(-0.006445 * 3600.0).epsilon(1e-4));
}

TEST_CASE("hull: what drifts in a current comes to go with it", "[hal_sim][vessel]") {
  VesselParameters p = shipped_vessel();
  const WaterConditions water{0.2, -0.1, false};
  VesselState at_rest;
  at_rest.surge_m_s = 0.1;
  at_rest.sway_m_s = -0.2;
  Vessel vessel = Vessel::under_way(p, water, at_rest);
  CHECK(vessel.ground_velocity_V_m_s().norm() == Approx(0.0).margin(1e-12));
  vessel.advance(60.0, kNeutralThrust);
  const VesselState before = vessel.state();
  vessel.advance(1.0, kNeutralThrust);
  const Eigen::Vector2d way_m = vessel.state().pose.p_WV.xy_m - before.pose.p_WV.xy_m;
  CHECK(way_m.x() == Approx(0.2).margin(0.002));
  CHECK(way_m.y() == Approx(-0.1).margin(0.002));
}

TEST_CASE("hull: wires that are swapped or reversed do what they say", "[hal_sim][vessel]") {
  const auto after = [](const VesselParameters& p, ThrustCommand thrust) {
    Vessel vessel{p, {}, {}};
    vessel.advance(1.0, thrust);
    return vessel.state();
  };
  VesselParameters p = shipped_vessel();
  const ThrustCommand turning{200, 128};
  const double right_rad_s = after(p, turning).yaw_rate_rad_s;
  CHECK(right_rad_s > 0.05);
  p.wires_swapped = true;
  CHECK(after(p, turning).yaw_rate_rad_s == Approx(-right_rad_s));
  p.right_reversed = true;  // the propeller that the left wire reaches
  CHECK(after(p, turning).yaw_rate_rad_s > 0.05);
  CHECK(after(p, turning).surge_m_s < 0.0);
  p.left_reversed = true;
  CHECK(after(p, {200, 200}).surge_m_s < -0.1);
}

// Whether a small disturbance grows under steady thrust ahead.
[[nodiscard]] bool grows(const VesselParameters& p, double surge_m_s, bool lift) {
  VesselState state;
  state.surge_m_s = surge_m_s;
  state.yaw_rate_rad_s = 1e-4;
  const double drag_n = (p.surge_drag_n_s_per_m + p.surge_drag_n_s2_per_m2 * surge_m_s) * surge_m_s;
  const double share = std::sqrt(drag_n / 2.0 / p.thrust_ahead_n);
  const double rad_s = share * p.propeller_ahead_rad_s;
  state.propellers = {rad_s, rad_s};
  Vessel vessel = Vessel::under_way(p, {0.0, 0.0, lift}, state);
  vessel.advance(60.0, PropellerSpeeds{rad_s, rad_s});
  const double before_rad_s = std::abs(vessel.state().yaw_rate_rad_s);
  vessel.advance(60.0, PropellerSpeeds{rad_s, rad_s});
  return std::abs(vessel.state().yaw_rate_rad_s) > before_rad_s;
}

TEST_CASE("hull: the speed from which a straight course is not held is found where it is sailed",
          "[hal_sim][vessel]") {
  VesselParameters p = shipped_vessel();
  CHECK_FALSE(unstable_from_m_s(p, false).has_value());
  CHECK_FALSE(unstable_from_m_s(p, true).has_value());
  p.yaw_drag_n_m_s = 25.0;
  p.yaw_drag_n_m_s2 = 0.0;
  const auto from_m_s = unstable_from_m_s(p, false);
  REQUIRE(from_m_s.has_value());
  CHECK(*from_m_s > 0.5);
  CHECK(*from_m_s < 1.1);
  CHECK_FALSE(grows(p, 0.95 * *from_m_s, false));
  CHECK(grows(p, 1.05 * *from_m_s, false));
  p.lift_ahead_m = 0.5;  // at the bow it turns the hull further out
  const auto with_lift_m_s = unstable_from_m_s(p, true);
  REQUIRE(with_lift_m_s.has_value());
  CHECK_FALSE(grows(p, 0.9 * *with_lift_m_s, true));
  CHECK(grows(p, 1.1 * *with_lift_m_s, true));
}

}  // namespace
}  // namespace lodesman
