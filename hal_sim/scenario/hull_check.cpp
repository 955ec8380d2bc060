// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/hull_check.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace lodesman {
namespace {

constexpr double kWater_kg_m3 = 1025.0;
constexpr double kGravity_m_s2 = 9.81;

// What is outside these is taken for a mistaken unit: they are wide of any boat of this kind.
constexpr double kDraughtMin_m = 0.005;           // of a box as long and wide as the hull
constexpr double kDraughtPerBeamMax = 1.0;        // the same
constexpr double kGyrationPerLengthMin = 0.1;     // a boat of even weight: 0.25 to 0.33
constexpr double kGyrationPerLengthMax = 0.6;     //
constexpr double kAddedPerMassMax = 5.0;          //
constexpr double kFroudeMin = 0.02;               // at full thrust, by length
constexpr double kFroudeMax = 3.0;                //
constexpr double kPushMin_m_s2 = 0.005;           // of both thrusters
constexpr double kPushMax_m_s2 = 20.0;            //
constexpr double kSpinMax_rad_s = 3.0;            // at full thrust to both sides
constexpr double kSpinMin_rad_s = 0.02;           //
constexpr double kSurgeTimeMin_s = 0.05;          // mass over linear drag
constexpr double kTrimPerWeightMax = 0.1;         // 6 degrees of trim for all of the weight
constexpr double kPropellerSpeedMin_rad_s = 5.0;  // 48 revolutions a minute
constexpr double kPropellerSpeedMax_rad_s = 3000.0;

[[nodiscard]] std::string text(const char* pattern, double value) {
  std::array<char, 192> line{};
  std::snprintf(line.data(), line.size(), pattern, value);
  return line.data();
}

void require(bool holds, const TomlTable& vessel, const char* key, const std::string& reason) {
  if (!holds) {
    vessel.refuse(key, reason);
  }
}

void require_sound_size(const TomlTable& vessel, const VesselParameters& hull) {
  require(hull.hull_beam_m <= hull.hull_length_m, vessel, "hull_beam_m",
          "is more than hull_length_m");
  require(hull.hull_length_m <= 30.0, vessel, "hull_length_m",
          "of more than 30 m is no boat of this kind: is it in metres?");
  require(hull.thruster_offset_m <= hull.hull_beam_m, vessel, "thruster_offset_m",
          "is more than hull_beam_m; it is taken from the centre line");
  require(std::abs(hull.centre_of_gravity_ahead_m) < hull.hull_length_m / 2.0, vessel,
          "centre_of_gravity_ahead_m", "lies outside the hull; it is taken from midships");
  require(std::abs(hull.lift_ahead_m) <= hull.hull_length_m / 2.0 + 1e-9, vessel, "lift_ahead_m",
          "lies outside the hull; it is taken from midships");
  require(hull.cross_flow_length_m <= 1.2 * hull.hull_length_m, vessel, "cross_flow_length_m",
          "is more than hull_length_m");
  require(hull.cross_flow_draught_m <= hull.hull_length_m, vessel, "cross_flow_draught_m",
          "is more than hull_length_m: is it in metres?");
}

void require_sound_masses(const TomlTable& vessel, const VesselParameters& hull) {
  const double draught_m = hull.mass_kg / (kWater_kg_m3 * hull.hull_length_m * hull.hull_beam_m);
  require(draught_m >= kDraughtMin_m && draught_m <= kDraughtPerBeamMax * hull.hull_beam_m, vessel,
          "mass_kg",
          text("a hull of this length and beam would float at a mean draught of %.3g m: is it in "
               "kilograms?",
               draught_m));
  const double gyration = std::sqrt(hull.yaw_inertia_kg_m2 / hull.mass_kg) / hull.hull_length_m;
  require(gyration >= kGyrationPerLengthMin && gyration <= kGyrationPerLengthMax, vessel,
          "yaw_inertia_kg_m2",
          text("its radius of gyration would be %.3g of the length, where boats have 0.2 to 0.35",
               gyration));
  require(hull.surge_added_mass_kg <= hull.mass_kg, vessel, "surge_added_mass_kg",
          "is more than mass_kg: along the hull it is a small part of it");
  require(hull.sway_added_mass_kg <= kAddedPerMassMax * hull.mass_kg, vessel, "sway_added_mass_kg",
          "is more than 5 times mass_kg");
  require(hull.yaw_added_inertia_kg_m2 <= kAddedPerMassMax * hull.yaw_inertia_kg_m2, vessel,
          "yaw_added_inertia_kg_m2", "is more than 5 times yaw_inertia_kg_m2");
  require(std::abs(hull.drift_moment_kg) <= kAddedPerMassMax * hull.mass_kg, vessel,
          "drift_moment_kg", "is more than 5 times mass_kg");
  require(hull.heel_mass_kg < hull.mass_kg, vessel, "heel_mass_kg", "is more than mass_kg");
  const SwayYaw matrix = linearised(hull, 0.0, false);
  require(matrix.mass_kg * matrix.inertia_kg_m2 > matrix.coupling_kg_m * matrix.coupling_kg_m,
          vessel, "sway_yaw_added_mass_kg_m",
          "makes the mass matrix not positive definite: with this coupling of sway and yaw the "
          "hull would gain way by being pushed back");
}

void require_sound_thrust(const TomlTable& vessel, const VesselParameters& hull) {
  const double push_m_s2 = 2.0 * hull.thrust_ahead_n / hull.mass_kg;
  require(push_m_s2 >= kPushMin_m_s2 && push_m_s2 <= kPushMax_m_s2, vessel, "thrust_ahead_n",
          text("full thrust would push it with %.3g m/s^2: is it in newtons, of one thruster?",
               push_m_s2));
  require(hull.thrust_astern_n <= 1.5 * hull.thrust_ahead_n, vessel, "thrust_astern_n",
          "is much more than thrust_ahead_n: are they exchanged?");
  const auto is_speed = [](double rad_s) {
    return rad_s >= kPropellerSpeedMin_rad_s && rad_s <= kPropellerSpeedMax_rad_s;
  };
  require(is_speed(hull.propeller_ahead_rad_s), vessel, "propeller_ahead_rad_s",
          "is no propeller's full speed: is it in radians a second?");
  require(is_speed(hull.propeller_astern_rad_s), vessel, "propeller_astern_rad_s",
          "is no propeller's full speed: is it in radians a second?");
  require(std::abs(hull.trim_force_n) <= kTrimPerWeightMax * hull.mass_kg * kGravity_m_s2, vessel,
          "trim_force_n", "is more than a tenth of the weight");
}

void require_sound_drag(const TomlTable& vessel, const VesselParameters& hull) {
  const double top_m_s = settled_speed_m_s(hull, 2.0 * hull.thrust_ahead_n);
  const double froude = top_m_s / std::sqrt(kGravity_m_s2 * hull.hull_length_m);
  require(froude >= kFroudeMin && froude <= kFroudeMax, vessel, "surge_drag_n_s_per_m",
          text("full thrust would settle at %.3g m/s: are drag and thrust in newtons?", top_m_s));
  const double moment_n_m = (hull.thrust_ahead_n + hull.thrust_astern_n) * hull.thruster_offset_m;
  const double linear = hull.yaw_drag_n_m_s;
  const double spin_rad_s =
      2.0 * moment_n_m /
      (linear + std::sqrt(linear * linear + 4.0 * hull.yaw_drag_n_m_s2 * moment_n_m));
  require(spin_rad_s >= kSpinMin_rad_s && spin_rad_s <= kSpinMax_rad_s, vessel, "yaw_drag_n_m_s",
          text("full thrust to both sides would turn it at %.3g rad/s: is the drag a unit of "
               "rad/s, not of deg/s?",
               spin_rad_s));
  require(hull.mass_kg / hull.surge_drag_n_s_per_m >= kSurgeTimeMin_s, vessel,
          "surge_drag_n_s_per_m", "would stop the hull within 0.05 s");
  const bool any_lift = hull.lift_kg_per_m > 0.0 || hull.cross_flow_coefficient > 0.0 ||
                        hull.lift_drag_n_s2_per_m2 > 0.0 || hull.sway_drag_n_s_per_m > 0.0 ||
                        hull.sway_drag_n_s2_per_m2 > 0.0;
  require(any_lift, vessel, "sway_drag_n_s_per_m",
          "nothing holds the hull against sliding sideways where a scenario has lift");
}

void require_straight_course(const TomlTable& vessel, const VesselParameters& hull) {
  for (const bool lift : {false, true}) {
    if (const auto from_m_s = unstable_from_m_s(hull, lift)) {
      require(hull.straight_line_unstable, vessel, "yaw_drag_n_m_s",
              text("is too little for a straight course: from %.2f m/s on", *from_m_s) +
                  (lift ? " with lift" : "") +
                  " the hull turns out of it by itself (if it is known to, say "
                  "straight_line_unstable = true)");
      return;
    }
  }
  require(!hull.straight_line_unstable, vessel, "straight_line_unstable",
          "is true, and by these values the hull holds a straight course at every speed");
}

}  // namespace

bool SwayYaw::is_stable() const noexcept {
  const double damping = mass_kg * yaw_by_yaw_kg_m2_s + inertia_kg_m2 * sway_by_sway_kg_s -
                         coupling_kg_m * (sway_by_yaw_kg_m_s + yaw_by_sway_kg_m_s);
  const double stiffness =
      sway_by_sway_kg_s * yaw_by_yaw_kg_m2_s - sway_by_yaw_kg_m_s * yaw_by_sway_kg_m_s;
  return damping > 0.0 && stiffness > 0.0;
}

SwayYaw linearised(const VesselParameters& hull, double surge_m_s, bool lift) noexcept {
  const double u = surge_m_s;
  const double cg_m = hull.centre_of_gravity_ahead_m;
  const double by_lift = lift ? hull.lift_kg_per_m * u : 0.0;
  const double x_m = hull.lift_ahead_m;
  SwayYaw s;
  s.mass_kg = hull.mass_kg + hull.sway_added_mass_kg;
  s.coupling_kg_m = hull.mass_kg * cg_m + hull.sway_yaw_added_mass_kg_m;
  s.inertia_kg_m2 =
      hull.yaw_inertia_kg_m2 + hull.mass_kg * cg_m * cg_m + hull.yaw_added_inertia_kg_m2;
  s.sway_by_sway_kg_s =
      hull.sway_drag_n_s_per_m + (lift ? 0.0 : hull.track_hold_n_s_per_m) + by_lift;
  s.sway_by_yaw_kg_m_s =
      (hull.mass_kg + hull.surge_added_mass_kg + hull.heel_mass_kg) * u + by_lift * x_m;
  s.yaw_by_sway_kg_m_s =
      (hull.sway_added_mass_kg - hull.surge_added_mass_kg + hull.drift_moment_kg) * u +
      by_lift * x_m;
  s.yaw_by_yaw_kg_m2_s = hull.yaw_drag_n_m_s +
                         (hull.mass_kg * cg_m + hull.sway_yaw_added_mass_kg_m) * u +
                         by_lift * x_m * x_m;
  return s;
}

std::optional<double> unstable_from_m_s(const VesselParameters& hull, bool lift) noexcept {
  constexpr int kSteps = 200;
  const double top_m_s = steady_speed_m_s(hull, 100);
  for (int i = 1; i <= kSteps; ++i) {
    const double surge_m_s = top_m_s * i / kSteps;
    if (!linearised(hull, surge_m_s, lift).is_stable()) {
      return surge_m_s;
    }
  }
  return std::nullopt;
}

void require_sound_hull(const TomlTable& vessel, const VesselParameters& hull) {
  require_sound_size(vessel, hull);
  require_sound_masses(vessel, hull);
  require_sound_thrust(vessel, hull);
  require_sound_drag(vessel, hull);
  require_straight_course(vessel, hull);
}

}  // namespace lodesman
