// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/controller.h"

#include <cmath>

#include "high_level/guidance/steering.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

}  // namespace

ControllerTask::ControllerTask(Blackboard& board, Role role, const ControllerOptions& options)
    : options_{options},
      tracker_{options.waypoint_radius_m},
      attitude_{board.attitude},
      vehicle_state_{board.vehicle_state},
      mission_status_{board.mission_status},
      plan_{board.plan},
      tunables_{board.tunables},
      commands_{writer_of(board, board.helm_command, role)} {}

void ControllerTask::step(Time now) noexcept {
  begun_ = begun_.value_or(now);
  take_tunables();
  commands_.publish(decide(now), now);
}

void ControllerTask::take_tunables() noexcept {
  if (const auto* tunables = tunables_.latest(); tunables != nullptr) {
    options_.steering.heading_gain_per_deg = tunables->value.heading_gain_per_deg;
  }
}

void ControllerTask::enter_safe_state(Time now) noexcept { commands_.publish(HelmCommand{}, now); }

HelmCommand ControllerTask::decide(Time now) noexcept {
  HelmCommand helm;
  const auto* mission = mission_status_.fresh(now, max_age::kMissionStatus);
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  const auto* attitude = attitude_.fresh(now, max_age::kAttitude);
  const auto* plan = plan_.latest();
  if (mission == nullptr) {
    helm.reason = HelmReason::kStaleMission;
    return helm;
  }
  cruise_ = {mission->value.surge_ref, mission->value.speed_m_s};
  const bool holds = mission->value.state == MissionState::kHolding && plan != nullptr &&
                     plan->value.steer_by != SteerBy::kWaypoints;
  if (mission->value.state != MissionState::kUnderWay && !holds) {
    helm.reason = HelmReason::kNotUnderWay;
    return helm;
  }
  // A plan from before this start is not this mission's, and one from before this program, which
  // may be seconds old, is not to be steered by: the planner's next one is on its way.
  const bool planned = plan != nullptr && plan->stamp >= std::max(mission->value.started, *begun_);
  if (planned) {
    helm.plan_id = plan->value.id;
    helm.plan_captured = plan->value.captured;
  }
  if (attitude == nullptr || state == nullptr) {
    helm.reason = attitude == nullptr ? HelmReason::kStaleAttitude : HelmReason::kStaleState;
    return helm;
  }
  if (!planned || plan->value.waypoint_count == 0) {
    helm.reason = HelmReason::kNoWaypoints;
    return helm;
  }
  const WorldPoint position{{state->value.x_m, state->value.y_m}};
  const Heading heading = Heading::clockwise_from_y_rad(attitude->value.heading_rad);
  helm.reason = HelmReason::kTracking;
  if (plan->value.steer_by == SteerBy::kWaypoints) {
    steer_for_waypoint(plan->value, position, heading, helm);
  } else {
    steer_by_pilot(plan->value, state->value, attitude->value, helm);
  }
  return helm;
}

void ControllerTask::steer_for_waypoint(const Plan& plan, const WorldPoint& position,
                                        Heading heading, HelmCommand& helm) noexcept {
  const std::span<const Waypoint> waypoints{plan.waypoints.data(), plan.waypoint_count};
  helm.waypoint_index = tracker_.update(waypoints, plan.path_id, position);
  const Waypoint& ahead = waypoints[helm.waypoint_index];
  helm.waypoint_x_m = ahead.x_m;
  helm.waypoint_y_m = ahead.y_m;
  const Heading reference =
      Heading::of_displacement(ahead.x_m - position.xy_m.x(), ahead.y_m - position.xy_m.y());
  set(helm_of(1.0, heading, reference, cruise_.surge_ref, options_.steering.heading_gain_per_deg),
      helm);
}

void ControllerTask::steer_by_pilot(const Plan& plan, const VehicleState& state,
                                    const Attitude& attitude, HelmCommand& helm) noexcept {
  const WorldPoint position{{state.x_m, state.y_m}};
  const double look_ahead_m = options_.look_ahead_m + options_.look_ahead_s * cruise_.speed_m_s;
  const SteeringPoint ahead =
      point_to_steer_for({plan.waypoints.data(), plan.waypoint_count}, position, look_ahead_m);
  helm.waypoint_index = ahead.waypoint;
  helm.waypoint_x_m = ahead.point.xy_m.x();
  helm.waypoint_y_m = ahead.point.xy_m.y();
  const Steering steering = steering_of(plan, ahead, state, attitude);
  set(helm_of(steering, attitude.heading_rad, attitude.yaw_rate_rad_s, cruise_, options_.steering),
      helm);
}

Steering ControllerTask::steering_of(const Plan& plan, const SteeringPoint& ahead,
                                     const VehicleState& state,
                                     const Attitude& attitude) const noexcept {
  const Vec current{state.current_x_m_s, state.current_y_m_s};
  const Heading heading = Heading::clockwise_from_y_rad(attitude.heading_rad);
  const Vec course{std::sin(plan.course_rad), std::cos(plan.course_rad)};
  const Vec way = ahead.point.xy_m - Vec{state.x_m, state.y_m};
  if (plan.steer_by != SteerBy::kCourse && plan.stay_at_end && ahead.is_end) {
    return keep_place(way, Heading::clockwise_from_y_rad(plan.course_rad), plan.speed_share,
                      cruise_, current, heading);
  }
  const bool by_course = plan.steer_by == SteerBy::kCourse || way.norm() <= kAim_m;
  return steer_along(by_course ? course : way, plan.speed_share, cruise_, current, heading);
}

void ControllerTask::set(const Helm& wanted, HelmCommand& helm) noexcept {
  helm.surge_ref = wanted.surge_ref;
  helm.head_ref = wanted.head_ref;
  if (!wanted.valid) {
    helm.reason = HelmReason::kNotSane;
  }
}

}  // namespace lodesman
