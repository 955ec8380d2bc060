// SPDX-License-Identifier: Apache-2.0
// The paper's boat as the shipped configuration has it, and a filter for it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "high_level/estimate/pose_filter.h"
#include "mid_level/base/random_stream.h"

namespace lodesman::testing {

[[nodiscard]] inline SpeedTable paper_speeds() {
  constexpr std::array<SpeedPoint, 5> kPoints{
      {{8, 0.109}, {16, 0.222}, {31, 0.416}, {57, 0.735}, {91, 1.116}}};
  return SpeedTable{kPoints};
}

[[nodiscard]] inline VehicleModelParameters paper_hull() {
  VehicleModelParameters hull;
  hull.mass_kg = 95.0;
  hull.added_mass_sway_kg = 110.0;
  hull.yaw_inertia_kg_m2 = 44.0;
  hull.surge_drag_n_s_per_m = 41.3;
  hull.surge_drag_n_s2_per_m2 = 6.5;
  hull.sway_drag_n_s_per_m = 300.0;
  hull.sway_drag_n_s2_per_m2 = 5.0;
  hull.yaw_drag_n_m_s = 60.0;
  hull.yaw_drag_n_m_s2 = 10.0;
  hull.turning_n_m_per_head_ref = 0.27;
  return hull;
}

[[nodiscard]] inline PoseFilterOptions filter_options() {
  using std::chrono::milliseconds;
  using std::chrono::seconds;
  PoseFilterOptions options;
  options.vehicle = paper_hull();
  options.speeds = paper_speeds();
  options.surge_noise_m_s_per_sqrt_s = 0.03;
  options.sway_noise_m_s_per_sqrt_s = 0.05;
  options.yaw_noise_rad_s_per_sqrt_s = 0.1;
  options.current_noise_m_s_per_sqrt_s = 0.005;
  options.current_sigma_m_s = 0.3;
  options.heading_sigma_rad = 0.01;
  options.yaw_rate_sigma_rad_s = 0.01;
  options.gate = {4.3, 0.5, 0.02, 5.0, seconds{3}, 0.5, milliseconds{1500}, seconds{15}, 2.0};
  return options;
}

// A boat that sails as the filter's own model says, with the noise that it reckons with, or none;
// its AHRS at 50 Hz.
class SailedBoat {
 public:
  static constexpr double kStep_s = 0.02;

  SailedBoat(const PoseFilterOptions& options, std::uint64_t seed, double noise_share)
      : options_{options},
        model_{options.vehicle, options.speeds},
        share_{noise_share},
        luck_{"sailed boat", seed} {
    current_m_s.x() = scattered(options.current_sigma_m_s);
    current_m_s.y() = scattered(options.current_sigma_m_s);
  }

  void step(int surge_ref, int head_ref) {
    motion = model_.advanced(motion, model_.forces(surge_ref, head_ref), current_m_s, kStep_s);
    const double root_s = std::sqrt(kStep_s);
    motion.velocity[0] += scattered(options_.surge_noise_m_s_per_sqrt_s * root_s);
    motion.velocity[1] += scattered(options_.sway_noise_m_s_per_sqrt_s * root_s);
    motion.velocity[2] += scattered(options_.yaw_noise_rad_s_per_sqrt_s * root_s);
    current_m_s.x() += scattered(options_.current_noise_m_s_per_sqrt_s * root_s);
    current_m_s.y() += scattered(options_.current_noise_m_s_per_sqrt_s * root_s);
    now += from_seconds(kStep_s);
  }
  [[nodiscard]] Attitude attitude() {
    return {now, wrap_to_pi(motion.heading_rad + scattered(options_.heading_sigma_rad)),
            motion.velocity[2] + scattered(options_.yaw_rate_sigma_rad_s)};
  }
  [[nodiscard]] WorldPoint fix(double sigma_m) {
    const double x_m = sigma_m * luck_.gaussian();
    return {motion.position.xy_m + Eigen::Vector2d{x_m, sigma_m * luck_.gaussian()}};
  }
  // What the filter estimates.
  [[nodiscard]] PoseFilter::Vector state() const {
    PoseFilter::Vector state;
    state << motion.position.xy_m, wrap_to_pi(motion.heading_rad), motion.velocity, current_m_s;
    return state;
  }

  VehicleMotion motion;
  Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();
  Time now{std::chrono::seconds{100}};

 private:
  [[nodiscard]] double scattered(double sigma) { return share_ * sigma * luck_.gaussian(); }

  PoseFilterOptions options_;
  VehicleModel model_;
  double share_;
  RandomStream luck_;
};

}  // namespace lodesman::testing
