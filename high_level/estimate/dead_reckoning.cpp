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
    const double travelled_m = speed_m_s(surge_ref) * to_seconds(options_.step);
    position_.xy_m +=
        travelled_m * Eigen::Vector2d{std::sin(heading.rad()), std::cos(heading.rad())};
    advanced_to_ += options_.step;
  }
  if (now - advanced_to_ >= options_.step) {
    advanced_to_ = now;
  }
}

void DeadReckoning::correct(const WorldPoint& fix, double share) noexcept {
  position_.xy_m += share * (fix.xy_m - position_.xy_m);
}

}  // namespace lodesman
