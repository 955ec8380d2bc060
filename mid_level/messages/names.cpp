// SPDX-License-Identifier: Apache-2.0
#include "mid_level/messages/command.h"
#include "mid_level/messages/path.h"

namespace lodesman {

const char* to_string(PathReason reason) noexcept {
  switch (reason) {
    case PathReason::kFound: return "found";
    case PathReason::kNoPath: return "no_path";
    case PathReason::kStartBlocked: return "start_blocked";
    case PathReason::kGoalBlocked: return "goal_blocked";
    case PathReason::kGoalOutOfView: return "goal_out_of_view";
    case PathReason::kLimit: return "limit";
    case PathReason::kNoFrame: return "no_frame";
  }
  return "unknown";
}

const char* to_string(MissionState state) noexcept {
  switch (state) {
    case MissionState::kIdle: return "idle";
    case MissionState::kUnderWay: return "under_way";
    case MissionState::kReached: return "reached";
    case MissionState::kAborted: return "aborted";
    case MissionState::kHolding: return "holding";
  }
  return "unknown";
}

const char* to_string(OrderAnswer answer) noexcept {
  switch (answer) {
    case OrderAnswer::kNone: return "none";
    case OrderAnswer::kObeyed: return "obeyed";
    case OrderAnswer::kNotUnderWay: return "not_under_way";
    case OrderAnswer::kNotHolding: return "not_holding";
    case OrderAnswer::kAborted: return "aborted";
    case OrderAnswer::kTooOld: return "too_old";
  }
  return "unknown";
}

const char* to_string(WaypointSource source) noexcept {
  switch (source) {
    case WaypointSource::kNone: return "none";
    case WaypointSource::kCurrent: return "current";
    case WaypointSource::kPrevious: return "previous";
  }
  return "unknown";
}

const char* to_string(PlanRung rung) noexcept {
  switch (rung) {
    case PlanRung::kOnRoute: return "on_route";
    case PlanRung::kAside: return "aside";
    case PlanRung::kSlow: return "slow";
    case PlanRung::kStop: return "stop";
    case PlanRung::kEscape: return "escape";
    case PlanRung::kNearGoal: return "near_goal";
    case PlanRung::kBestPoint: return "best_point";
    case PlanRung::kHold: return "hold";
    case PlanRung::kPrevious: return "previous";
    case PlanRung::kNothing: return "nothing";
  }
  return "unknown";
}

const char* to_string(HelmReason reason) noexcept {
  switch (reason) {
    case HelmReason::kTracking: return "tracking";
    case HelmReason::kNotUnderWay: return "not_under_way";
    case HelmReason::kNoWaypoints: return "no_waypoints";
    case HelmReason::kStaleState: return "stale_state";
    case HelmReason::kStaleAttitude: return "stale_attitude";
    case HelmReason::kStaleMission: return "stale_mission";
  }
  return "unknown";
}

const char* to_string(ThrustReason reason) noexcept {
  switch (reason) {
    case ThrustReason::kCommanded: return "commanded";
    case ThrustReason::kNoCommand: return "no_command";
    case ThrustReason::kStaleCommand: return "stale_command";
    case ThrustReason::kDeviceFailed: return "device_failed";
  }
  return "unknown";
}

}  // namespace lodesman
