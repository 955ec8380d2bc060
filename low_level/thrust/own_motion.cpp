// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/own_motion.h"

#include <cmath>

namespace lodesman {

double ReckoningModel::drag_n(double surge_m_s) const noexcept {
  return (hull_.surge_drag_n_s_per_m + hull_.surge_drag_n_s2_per_m2 * std::abs(surge_m_s)) *
         surge_m_s;
}

double ReckoningModel::surge_m_s2(double surge_m_s, double thrust_n) const noexcept {
  return (thrust_n - drag_n(surge_m_s)) / hull_.mass_kg;
}

double ReckoningModel::yaw_rad_s2(double yaw_rate_rad_s, double turning_n_m) const noexcept {
  const double drag_n_m =
      (hull_.yaw_drag_n_m_s + hull_.yaw_drag_n_m_s2 * std::abs(yaw_rate_rad_s)) * yaw_rate_rad_s;
  return (turning_n_m - drag_n_m) / hull_.yaw_inertia_kg_m2;
}

ReckonedMotion ReckoningModel::advanced(const ReckonedMotion& from, const SurgeAndHead& thrust,
                                        double dt_s) const noexcept {
  const double full_n = drag_n(hull_.speeds.speed_m_s(thrust.surge_ref));
  const double ahead_n = full_n < 0.0 ? hull_.astern_share * full_n : full_n;
  const double turning_n_m = hull_.turning_n_m_per_head_ref * thrust.head_ref;
  const double half_s = dt_s / 2.0;
  const double surge_m_s = from.surge_m_s + half_s * surge_m_s2(from.surge_m_s, ahead_n);
  const double yaw_rate_rad_s =
      from.yaw_rate_rad_s + half_s * yaw_rad_s2(from.yaw_rate_rad_s, turning_n_m);
  const double heading_rad = from.heading_rad + half_s * from.yaw_rate_rad_s;
  ReckonedMotion to;
  to.x_m = from.x_m + dt_s * surge_m_s * std::sin(heading_rad);
  to.y_m = from.y_m + dt_s * surge_m_s * std::cos(heading_rad);
  to.heading_rad = from.heading_rad + dt_s * yaw_rate_rad_s;
  to.surge_m_s = from.surge_m_s + dt_s * surge_m_s2(surge_m_s, ahead_n);
  to.yaw_rate_rad_s = from.yaw_rate_rad_s + dt_s * yaw_rad_s2(yaw_rate_rad_s, turning_n_m);
  return to;
}

}  // namespace lodesman
