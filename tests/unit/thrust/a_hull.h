// SPDX-License-Identifier: Apache-2.0
// The hull of the shipped configuration, as far as the guard knows it. Any thread.
#pragma once

#include <array>

#include "low_level/thrust/guard.h"

namespace lodesman::testing {

[[nodiscard]] inline HullResponse a_hull() {
  static constexpr std::array<SpeedPoint, 8> kSpeeds{{{8, 0.109},
                                                      {16, 0.222},
                                                      {31, 0.416},
                                                      {45, 0.585},
                                                      {57, 0.735},
                                                      {74, 0.919},
                                                      {91, 1.116},
                                                      {100, 1.207}}};
  HullResponse hull;
  hull.mass_kg = 95.0;
  hull.surge_drag_n_s_per_m = 41.3;
  hull.surge_drag_n_s2_per_m2 = 6.5;
  hull.yaw_inertia_kg_m2 = 44.0;
  hull.yaw_drag_n_m_s = 60.0;
  hull.yaw_drag_n_m_s2 = 10.0;
  hull.turning_n_m_per_head_ref = 0.27;
  hull.speeds = SpeedTable{kSpeeds};
  return hull;
}

[[nodiscard]] inline GuardOptions a_guard() {
  using std::chrono::milliseconds;
  GuardOptions options;
  options.is_on = true;
  options.margin_m = 0.2;
  options.release_m = 0.3;
  options.reaction = milliseconds{100};
  options.silence_neutral = milliseconds{300};
  options.brake_max = milliseconds{10'000};
  options.frame_age_max = milliseconds{2000};
  options.hull_half_length_m = 1.02;
  options.hull_half_beam_m = 0.6;
  options.hull = a_hull();
  return options;
}

}  // namespace lodesman::testing
