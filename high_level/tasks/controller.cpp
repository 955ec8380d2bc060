// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/controller.h"

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
constexpr double kAim_m = 0.2;          // nearer than this a point gives no direction
constexpr double kSharpTurn_rad = 0.8;  // it slows down to turn by more
constexpr double kSharpTurnShare = 0.3;

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
    options_.heading_gain_per_deg = tunables->value.heading_gain_per_deg;
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
  surge_ref_ = mission->value.surge_ref;
  speed_m_s_ = mission->value.speed_m_s;
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
  set_helm(1.0, heading, reference, helm);
}

void ControllerTask::steer_by_pilot(const Plan& plan, const VehicleState& state,
                                    const Attitude& attitude, HelmCommand& helm) noexcept {
  const WorldPoint position{{state.x_m, state.y_m}};
  const Vec current{state.current_x_m_s, state.current_y_m_s};
  const double look_ahead_m = options_.look_ahead_m + options_.look_ahead_s * speed_m_s_;
  const SteeringPoint ahead =
      point_to_steer_for({plan.waypoints.data(), plan.waypoint_count}, position, look_ahead_m);
  helm.waypoint_index = ahead.waypoint;
  helm.waypoint_x_m = ahead.point.xy_m.x();
  helm.waypoint_y_m = ahead.point.xy_m.y();
  const Vec course{std::sin(plan.course_rad), std::cos(plan.course_rad)};
  if (plan.steer_by == SteerBy::kCourse) {
    steer_along(course, plan.speed_share, current, attitude, helm);
    return;
  }
  const Vec way = ahead.point.xy_m - position.xy_m;
  if (plan.stay_at_end && ahead.is_end) {
    keep_place(way, plan, current, attitude, helm);
  } else {
    steer_along(way.norm() > kAim_m ? way : course, plan.speed_share, current, attitude, helm);
  }
}

void ControllerTask::steer_along(const Vec& way, double speed_share, const Vec& current,
                                 const Attitude& attitude, HelmCommand& helm) noexcept {
  const double speed_m_s = std::abs(speed_share) * speed_m_s_;
  const Vec through = velocity_for_course(way.normalized(), speed_m_s, current);
  const Vec& steered = speed_m_s > 0.0 ? through : way;
  const Heading reference = Heading::of_displacement(steered.x(), steered.y());
  const Heading heading = Heading::clockwise_from_y_rad(attitude.heading_rad);
  const bool sharp = std::abs(heading.turn_to_rad(reference)) > kSharpTurn_rad;
  turn_to(speed_share > 0.0 && sharp ? kSharpTurnShare * speed_share : speed_share, reference,
          attitude, helm);
}

// Back to a place the faster the farther it is, on top of what the current asks for; bow or stern
// first, whichever is nearer.
void ControllerTask::keep_place(const Vec& way, const Plan& plan, const Vec& current,
                                const Attitude& attitude, HelmCommand& helm) noexcept {
  const double off_m = way.norm() - kStay_m;
  Vec through = -current;
  if (off_m > 0.0) {
    through += std::min(off_m / kReturn_s, speed_m_s_) * way.normalized();
  }
  const double speed_m_s = through.norm();
  const Heading heading = Heading::clockwise_from_y_rad(attitude.heading_rad);
  if (speed_m_s < kStillWater_m_s) {
    const Heading faced = Heading::clockwise_from_y_rad(plan.course_rad);
    if (std::abs(heading.turn_to_rad(faced)) > kFacing_rad) {
      turn_to(0.0, faced, attitude, helm);
    }
    return;  // there, and nothing moves it: no surge
  }
  Heading reference = Heading::of_displacement(through.x(), through.y());
  const bool astern = std::abs(heading.turn_to_rad(reference)) > kAstern_rad;
  if (astern) {
    reference = Heading::of_displacement(-through.x(), -through.y());
  }
  const double along = std::max(0.0, std::cos(heading.turn_to_rad(reference)));
  const double share = along * std::min(speed_m_s / speed_m_s_, std::abs(plan.speed_share));
  turn_to(astern ? -share : share, reference, attitude, helm);
}

void ControllerTask::turn_to(double speed_share, Heading reference, const Attitude& attitude,
                             HelmCommand& helm) const noexcept {
  const Heading swung = Heading::clockwise_from_y_rad(
      attitude.heading_rad + options_.heading_lead_s * attitude.yaw_rate_rad_s);
  set_helm(speed_share, swung, reference, helm);
}

// What is no number is no command: it would be some whole number in the end.
void ControllerTask::set_helm(double speed_share, Heading heading, Heading reference,
                              HelmCommand& helm) const noexcept {
  const double surge_ref = speed_share * surge_ref_;
  if (!std::isfinite(surge_ref) || !std::isfinite(heading.turn_to_rad(reference))) {
    helm.reason = HelmReason::kNotSane;
    helm.surge_ref = 0;
    helm.head_ref = 0;
    return;
  }
  helm.surge_ref = static_cast<std::int32_t>(std::lround(std::clamp(surge_ref, -100.0, 100.0)));
  helm.head_ref = head_ref(heading, reference, options_.heading_gain_per_deg);
}

}  // namespace lodesman
