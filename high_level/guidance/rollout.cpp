// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/rollout.h"

#include <cmath>
#include <limits>

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kAtRouteEnd_m = 0.4;  // from the route's end
constexpr double kStopped_m_s = 0.05;  // through the water

}  // namespace

Rollout::Rollout(const VehicleResponse& response, const Route& route, const OwnMotion& own,
                 const Manoeuvre& manoeuvre, double speed_share_max, bool stay_at_end) noexcept
    : response_{&response},
      route_{&route},
      manoeuvre_{manoeuvre},
      speed_share_max_{manoeuvre.for_s > 0.0 ? speed_share_max : manoeuvre.speed_share},
      stay_at_end_{stay_at_end},
      current_m_s_{own.current_m_s},
      motion_{{own.p_W}, own.heading_rad, {own.surge_m_s, own.sway_m_s, own.yaw_rate_rad_s}},
      place_{nearest_place(route, own.p_W, {}, std::numeric_limits<double>::infinity())} {
  const Vec aim = point_ahead(route, place_, response.look_ahead_m) - own.p_W;
  const double route_rad = aim.norm() > kAim_m ? std::atan2(aim.x(), aim.y()) : own.heading_rad;
  const double course_rad = route_rad + manoeuvre.offset_rad;
  course_ = {std::sin(course_rad), std::cos(course_rad)};
}

void Rollout::sail(double part_s) noexcept {
  const Vec& p = motion_.position.xy_m;
  place_ = nearest_place(*route_, p, place_, 6.0 * response_->look_ahead_m);
  if (phase_ == Phase::kStopping && std::abs(motion_.velocity[0]) < kStopped_m_s) {
    phase_ = Phase::kStopped;
    stopped_at_ = p;
  }
  const bool at_end = place_.leg + 2 >= route_->count && (route_->end() - p).norm() < kAtRouteEnd_m;
  arrived_ = arrived_ || (at_end && !stay_at_end_);
  if (arrived_) {
    return;
  }
  const Helm helm = helm_of(steering(), motion_.heading_rad, motion_.velocity[2], response_->cruise,
                            response_->steering);
  const ThrustForces forces = response_->model.forces(helm.surge_ref, helm.head_ref);
  motion_ = response_->model.carried_on(motion_, forces, current_m_s_, part_s);
  after_s_ += part_s;
}

// As the controller does it with a plan of that manoeuvre, and later with one of the route.
Steering Rollout::steering() const noexcept {
  const Heading heading = Heading::clockwise_from_y_rad(motion_.heading_rad);
  const Cruise& cruise = response_->cruise;
  if (phase_ != Phase::kSailing) {
    return steering_to_a_stop();
  }
  if (is_aside()) {
    return steer_along(course_, manoeuvre_.speed_share, cruise, current_m_s_, heading);
  }
  const Vec ahead = point_ahead(*route_, place_, response_->look_ahead_m);
  const Vec way = ahead - motion_.position.xy_m;
  if (stay_at_end_ && ahead == route_->end()) {
    return keep_place(way, heading, speed_share_max_, cruise, current_m_s_, heading);
  }
  return steer_along(way.norm() > kAim_m ? way : course_, speed_share_max_, cruise, current_m_s_,
                     heading);
}

Steering Rollout::steering_to_a_stop() const noexcept {
  const Heading heading = Heading::clockwise_from_y_rad(motion_.heading_rad);
  if (phase_ == Phase::kStopping) {
    return {std::copysign(response_->most_share, -motion_.velocity[0]), heading};
  }
  return keep_place(stopped_at_ - motion_.position.xy_m, heading, 1.0, response_->cruise,
                    current_m_s_, heading);
}

}  // namespace lodesman
