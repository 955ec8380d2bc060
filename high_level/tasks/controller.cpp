// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/controller.h"

#include "high_level/control/heading_control.h"

namespace lodesman {

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
  const std::span<const Waypoint> waypoints{plan->value.waypoints.data(),
                                            plan->value.waypoint_count};
  helm.waypoint_index = tracker_.update(waypoints, plan->value.path_id, position);
  const Waypoint& ahead = waypoints[helm.waypoint_index];
  helm.waypoint_x_m = ahead.x_m;
  helm.waypoint_y_m = ahead.y_m;
  const Heading reference =
      Heading::of_displacement(ahead.x_m - position.xy_m.x(), ahead.y_m - position.xy_m.y());
  const Heading heading = Heading::clockwise_from_y_rad(attitude->value.heading_rad);
  helm.reason = HelmReason::kTracking;
  helm.surge_ref = options_.surge_ref;
  helm.head_ref = head_ref(heading, reference, options_.heading_gain_per_deg);
  return helm;
}

}  // namespace lodesman
