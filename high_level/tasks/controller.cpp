// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/controller.h"

#include <cmath>

#include "high_level/control/heading_control.h"

namespace lodesman {
namespace {

constexpr double kStay_m = 0.4;         // a place to wait at is held within this
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
      commands_{board.helm_command, role, "helm_command"} {}

void ControllerTask::step(Time now) noexcept { commands_.publish(decide(now), now); }

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
  if (mission->value.state != MissionState::kUnderWay) {
    helm.reason = HelmReason::kNotUnderWay;
    return helm;
  }
  // A plan from before this start is not this mission's.
  const bool planned = plan != nullptr && plan->stamp >= mission->value.started;
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
    steer_by_pilot(plan->value, position, heading, helm);
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
  helm.surge_ref = options_.surge_ref;
  helm.head_ref = head_ref(heading, reference, options_.heading_gain_per_deg);
}

void ControllerTask::steer_by_pilot(const Plan& plan, const WorldPoint& position, Heading heading,
                                    HelmCommand& helm) noexcept {
  const SteeringPoint ahead = point_to_steer_for({plan.waypoints.data(), plan.waypoint_count},
                                                 position, options_.look_ahead_m);
  helm.waypoint_index = ahead.waypoint;
  helm.waypoint_x_m = ahead.point.xy_m.x();
  helm.waypoint_y_m = ahead.point.xy_m.y();
  Heading reference = Heading::clockwise_from_y_rad(plan.course_rad);
  double share = plan.speed_share;
  if (plan.steer_by == SteerBy::kLine) {
    const Eigen::Vector2d way = ahead.point.xy_m - position.xy_m;
    const double left_m = way.norm();
    if (plan.stay_at_end && ahead.is_end && left_m < kStay_m) {
      return;  // there: neutral
    }
    if (left_m > kAim_m) {
      reference = Heading::of_displacement(way.x(), way.y());
    }
  }
  if (share > 0.0 && std::abs(heading.turn_to_rad(reference)) > kSharpTurn_rad) {
    share *= kSharpTurnShare;
  }
  helm.surge_ref = static_cast<std::int32_t>(std::lround(share * options_.surge_ref));
  helm.head_ref = head_ref(heading, reference, options_.heading_gain_per_deg);
}

}  // namespace lodesman
