// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/story.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "deploy/operator/console/json_values.h"
#include "deploy/operator/console/schemas.h"
#include "mid_level/base/heading.h"

namespace lodesman::console {
namespace {

[[nodiscard]] std::string rounded(double value, const char* format) {
  std::array<char, 32> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), format, value));
  return text.data();
}

// As fine as the distance is short, so that the sentence does not change all the time.
[[nodiscard]] std::string distance(double metres) {
  constexpr double kNear_m = 10.0;
  const double step = metres < kNear_m ? 1.0 : 5.0;
  return rounded(step * std::round(metres / step), "%.0f m");
}

[[nodiscard]] std::string obstacle(const Plan& plan) {
  return plan.cause != 0 ? "obstacle " + std::to_string(plan.cause) : "something close";
}

[[nodiscard]] std::string waypoint(const BoardPicture& picture, const MissionStatus& mission) {
  std::string text = "its goal";
  const bool known =
      picture.definition != nullptr && picture.definition->value.id == mission.mission;
  if (known && mission.goal_index + 1 < picture.definition->value.goal_count) {
    text = "waypoint " + std::to_string(mission.goal_index + 1) + " of " +
           std::to_string(picture.definition->value.goal_count);
  }
  if (picture.state != nullptr) {
    text += ", " +
            distance(std::hypot(mission.goal_x_m - picture.state->value.x_m,
                                mission.goal_y_m - picture.state->value.y_m)) +
            " away";
  }
  return text;
}

[[nodiscard]] const char* why_no_path(PathReason reason) noexcept {
  switch (reason) {
    case PathReason::kFound: return "";
    case PathReason::kNoPath: return "no path leads there";
    case PathReason::kStartBlocked: return "the boat lies in a protection zone";
    case PathReason::kGoalBlocked: return "the goal lies in a protection zone";
    case PathReason::kGoalOutOfView: return "the goal lies outside of the sonar's view";
    case PathReason::kLimit: return "the search met its bound";
    case PathReason::kNoFrame: return "there is no fresh sonar frame";
    case PathReason::kNoPosition: return "the position is lost";
    case PathReason::kNoHeading: return "the heading is lost";
  }
  return "";
}

[[nodiscard]] std::string because(PathReason reason) {
  return reason == PathReason::kFound ? "" : std::string{", because "} + why_no_path(reason);
}

[[nodiscard]] std::string by_plan(const BoardPicture& picture, const MissionStatus& mission) {
  const std::string where = waypoint(picture, mission);
  if (picture.plan == nullptr) {
    return "Is under way to " + where + ", and has no plan yet.";
  }
  const Plan& plan = picture.plan->value;
  switch (plan.rung) {
    case PlanRung::kOnRoute:
      return "Sails to " + where + "." +
             (std::isfinite(plan.seen_ahead_m) ? " It goes slower, as little of the way is seen."
                                               : "");
    case PlanRung::kAside:
      return "Steers " + rounded(compass_deg(plan.course_rad), "%03.0f") +
             " for a while to keep clear of " + obstacle(plan) + "; then on to " + where + ".";
    case PlanRung::kSlow:
      return "Sails to " + where + ", slower, to keep clear of " + obstacle(plan) + ".";
    case PlanRung::kStop:
      return "Waits until " + obstacle(plan) + " is clear; then on to " + where + ".";
    case PlanRung::kEscape: return "Gets out of the zone of " + obstacle(plan) + " that it is in.";
    case PlanRung::kNearGoal:
      return "Makes for the free place nearest to its goal, which lies in the zone of " +
             obstacle(plan) + ", and waits there.";
    case PlanRung::kBestPoint:
      return "Makes for the nearest place to its goal that can be reached" + because(plan.reason) +
             ".";
    case PlanRung::kHold:
      return "Waits where it is for the way to " + where + because(plan.reason) + ".";
    case PlanRung::kPrevious: return "Follows the plan before" + because(plan.reason) + ".";
    case PlanRung::kNothing: return "Has nothing to follow" + because(plan.reason) + ".";
  }
  return "";
}

[[nodiscard]] const char* cause_of(MissionCause cause) noexcept {
  switch (cause) {
    case MissionCause::kOrder: return "by order";
    case MissionCause::kAbsence: return "because its program was frozen";
    case MissionCause::kLinkLost: return "because whoever commanded is not heard any more";
    case MissionCause::kRestart: return "because its program was started anew";
    case MissionCause::kDisarmed: return "because the thrusters were disarmed";
    case MissionCause::kBlocked: return "because a waypoint could not be reached";
  }
  return "";
}

[[nodiscard]] std::string by_mission(const BoardPicture& picture) {
  if (picture.mission == nullptr) {
    return "Nothing is known of a mission yet.";
  }
  const MissionStatus& mission = picture.mission->value;
  switch (mission.state) {
    case MissionState::kIdle: return "Has no orders.";
    case MissionState::kUnderWay: return by_plan(picture, mission);
    case MissionState::kReached: return "Has reached its goal.";
    case MissionState::kAborted:
      return std::string{"The mission is aborted "} + cause_of(mission.cause) +
             ": thrust is neutral until a new start.";
    case MissionState::kHolding:
      return std::string{"Stays where it is "} + cause_of(mission.cause) + ".";
  }
  return "";
}

// What goes before all that is planned.
[[nodiscard]] std::string by_thrust(const BoardPicture& picture) {
  if (is_fresh(picture.guard, picture.now, max_age::kGuardStatus) &&
      (picture.guard->value.state == GuardState::kBraking ||
       picture.guard->value.state == GuardState::kHolding)) {
    return "The guard keeps it from going on: " +
           std::string{picture.guard->value.reason == GuardReason::kSilence
                           ? "nobody steered."
                           : "something lies close ahead."} +
           " ";
  }
  if (picture.thrust_status == nullptr) {
    return "";
  }
  switch (picture.thrust_status->value.state) {
    case ThrustState::kManual: return "Is driven by hand. ";
    case ThrustState::kStopped: return "Is stopped by emergency. ";
    case ThrustState::kDisarmed: return "The thrusters are disarmed. ";
    case ThrustState::kArmed: break;
  }
  return "";
}

// Dead, or frozen with what it said last still on the board.
template <class T>
[[nodiscard]] bool is_silent(bool alive, const Stamped<T>* said, Time now, Duration max_age) {
  return !alive || (said != nullptr && !is_fresh(said, now, max_age));
}

}  // namespace

std::string what_it_does(const BoardPicture& picture, const std::string& absence) {
  if (!absence.empty()) {
    return "There is no boat.";
  }
  const bool low_silent =
      is_silent(picture.low_alive, picture.thrust, picture.now, max_age::kThrustApplied);
  const bool high_silent =
      is_silent(picture.high_alive, picture.mission, picture.now, max_age::kMissionStatus);
  if (low_silent && high_silent) {
    return "Neither of the boat's programs is heard. What was said last: " + by_mission(picture);
  }
  if (low_silent) {
    return "Nothing drives its thrusters, as lodesman-low is not heard. What was said last: " +
           by_mission(picture);
  }
  if (high_silent) {
    return "Nobody steers, as lodesman-high is not heard. What was said last: " +
           by_mission(picture);
  }
  return by_thrust(picture) + by_mission(picture);
}

Json story_json(const BoardPicture& picture, const std::string& absence) {
  Json alarms = Json::array();
  for (const Alarm& alarm : alarms_of(picture, absence)) {
    alarms.push_back({{"severity", to_string(alarm.severity)}, {"text", alarm.text}});
  }
  return {{"now", what_it_does(picture, absence)}, {"alarms", alarms}};
}

viewer::Shape story_shape() {
  const Json alarm =
      object_schema("lodesman.Alarm", {{"severity", text_schema("info, warning or critical")},
                                       {"text", text_schema("what is not as it should be")}});
  return named_shape("lodesman.Story", {{"now", text_schema("what the boat does and why")},
                                        {"alarms", list_schema("the gravest first", alarm)}});
}

}  // namespace lodesman::console
