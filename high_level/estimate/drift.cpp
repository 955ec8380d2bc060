// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/drift.h"

#include <algorithm>
#include <cmath>

namespace lodesman {

Eigen::Vector2d DriftEstimate::follow(Time now, const WorldPoint& position,
                                      const Eigen::Vector2d& through_water_m_s,
                                      double yaw_rate_rad_s) noexcept {
  constexpr double kGap_s = 1.0;       // after a longer silence it begins anew from where it is
  constexpr double kTurns_m_s2 = 0.1;  // across; turning so hard, half as much is learnt
  constexpr double kJump_m = 1.0;      // farther between two calls is a position mended, not water
  const double since_s = to_seconds(now - last_);
  const Eigen::Vector2d moved_m = position.xy_m - last_position_.xy_m;
  if (running_ && since_s > 0.0 && since_s < kGap_s && moved_m.norm() < kJump_m) {
    const Eigen::Vector2d over_ground_m_s = moved_m / since_s;
    const double turns = through_water_m_s.norm() * yaw_rate_rad_s / kTurns_m_s2;
    const double share = -std::expm1(-since_s / (to_seconds(time_) * (1.0 + turns * turns)));
    drift_m_s_ += share * (over_ground_m_s - through_water_m_s - drift_m_s_);
  }
  running_ = true;
  last_ = now;
  last_position_ = position;
  const double sure = 1.0 - kDoubt_m_s * kDoubt_m_s / std::max(drift_m_s_.squaredNorm(), 1e-12);
  return std::max(0.0, sure) * drift_m_s_;
}

}  // namespace lodesman
