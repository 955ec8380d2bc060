// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/dead_reckoning.h"

#include <cmath>

namespace lodesman {

void DeadReckoning::advance(Time now, int surge_ref, Heading heading) noexcept {
  if (!running_) {
    running_ = true;
    advanced_to_ = now;
  }
  for (int i = 0; i < kMaxSteps && now - advanced_to_ >= options_.step; ++i) {
    position_.xy_m += travelled_m(options_.step, surge_ref, heading);
    advanced_to_ += options_.step;
  }
  if (now - advanced_to_ >= options_.step) {
    advanced_to_ = now;
  }
}

WorldPoint DeadReckoning::position_at(Time now, int surge_ref, Heading heading) const noexcept {
  return running_ ? WorldPoint{position_.xy_m + travelled_m(now - advanced_to_, surge_ref, heading)}
                  : position_;
}

Eigen::Vector2d DeadReckoning::travelled_m(Duration time, int surge_ref,
                                           Heading heading) const noexcept {
  const double distance_m = speed_m_s(surge_ref) * to_seconds(time);
  return distance_m * Eigen::Vector2d{std::sin(heading.rad()), std::cos(heading.rad())};
}

void DeadReckoning::correct(const WorldPoint& fix, double share) noexcept {
  position_.xy_m += share * (fix.xy_m - position_.xy_m);
}

}  // namespace lodesman
