// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/steering.h"

#include <algorithm>
#include <cmath>

#include "high_level/control/heading_control.h"
#include "high_level/guidance/current.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kStay_m = 0.4;       // a place to wait at is held within this ...
constexpr double kReturn_s = 5.0;     // ... and gone back to in about this time
constexpr double kAstern_rad = 1.75;  // what lies abaft of this is gone back to astern
constexpr double kStillWater_m_s = 0.02;
constexpr double kFacing_rad = 0.2;     // turned no better than this towards what it waits for
constexpr double kSharpTurn_rad = 0.8;  // it slows down to turn by more
constexpr double kSharpTurnShare = 0.3;

}  // namespace

Steering steer_along(const Vec& way, double speed_share, const Cruise& cruise,
                     const Vec& current_m_s, Heading heading) noexcept {
  const double speed_m_s = std::abs(speed_share) * cruise.speed_m_s;
  const Vec through = velocity_for_course(way.normalized(), speed_m_s, current_m_s);
  const Vec& steered = speed_m_s > 0.0 ? through : way;
  const Heading reference = Heading::of_displacement(steered.x(), steered.y());
  const bool sharp = std::abs(heading.turn_to_rad(reference)) > kSharpTurn_rad;
  return {speed_share > 0.0 && sharp ? kSharpTurnShare * speed_share : speed_share, reference};
}

Steering keep_place(const Vec& way, Heading faced, double speed_share_max, const Cruise& cruise,
                    const Vec& current_m_s, Heading heading) noexcept {
  const double off_m = way.norm() - kStay_m;
  Vec through = -current_m_s;
  if (off_m > 0.0) {
    through += std::min(off_m / kReturn_s, cruise.speed_m_s) * way.normalized();
  }
  const double speed_m_s = through.norm();
  if (speed_m_s < kStillWater_m_s) {
    // There, and nothing moves it: no surge.
    return {0.0, faced, std::abs(heading.turn_to_rad(faced)) > kFacing_rad};
  }
  Heading reference = Heading::of_displacement(through.x(), through.y());
  const bool astern = std::abs(heading.turn_to_rad(reference)) > kAstern_rad;
  if (astern) {
    reference = Heading::of_displacement(-through.x(), -through.y());
  }
  const double along = std::max(0.0, std::cos(heading.turn_to_rad(reference)));
  const double share = along * std::min(speed_m_s / cruise.speed_m_s, std::abs(speed_share_max));
  return {astern ? -share : share, reference};
}

Helm helm_of(double speed_share, Heading heading, Heading reference, int surge_ref,
             double heading_gain_per_deg) noexcept {
  const double wanted = speed_share * surge_ref;
  if (!std::isfinite(wanted) || !std::isfinite(heading.turn_to_rad(reference))) {
    return {0, 0, false};
  }
  return {static_cast<int>(std::lround(std::clamp(wanted, -100.0, 100.0))),
          head_ref(heading, reference, heading_gain_per_deg)};
}

Helm helm_of(const Steering& steering, double heading_rad, double yaw_rate_rad_s,
             const Cruise& cruise, const SteeringOptions& options) noexcept {
  if (!steering.turns) {
    return {};
  }
  const Heading swung =
      Heading::clockwise_from_y_rad(heading_rad + options.heading_lead_s * yaw_rate_rad_s);
  return helm_of(steering.speed_share, swung, steering.reference, cruise.surge_ref,
                 options.heading_gain_per_deg);
}

}  // namespace lodesman
