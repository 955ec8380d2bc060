// SPDX-License-Identifier: Apache-2.0
// How the water moves: what the way over ground has more than the way through the water, averaged
// over some time. One thread.
#pragma once

#include "mid_level/base/frames.h"
#include "mid_level/base/time.h"

namespace lodesman {

class DriftEstimate {
 public:
  // time: to come within 1/e of a new current, straight on.
  explicit DriftEstimate(Duration time) noexcept : time_{time} {}

  // The vehicle is at `position` now and has gone with that velocity through the water [world]
  // since the last call, and turns at yaw_rate_rad_s. [m/s] [world]; 0 until the second call. What
  // is no larger than kDoubt_m_s is none: speeds through the water are not known that well. A hull
  // that turns slips, which looks like a current: the harder it turns the less is learnt.
  Eigen::Vector2d follow(Time now, const WorldPoint& position,
                         const Eigen::Vector2d& through_water_m_s, double yaw_rate_rad_s) noexcept;

  // Begins with a drift that was learnt before.
  void resume(const Eigen::Vector2d& drift_m_s) noexcept { drift_m_s_ = drift_m_s; }

  static constexpr double kDoubt_m_s = 0.03;

 private:
  Duration time_;
  Eigen::Vector2d drift_m_s_ = Eigen::Vector2d::Zero();
  WorldPoint last_position_;
  Time last_{};
  bool running_ = false;
};

}  // namespace lodesman
