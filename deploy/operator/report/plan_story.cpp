// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/plan_story.h"

#include <cmath>

#include "deploy/operator/report/numbers.h"

namespace lodesman::cli {
namespace {

[[nodiscard]] std::string speed_of(const PlanRecord& plan) {
  if (plan.speed_share <= 0.0) {
    return plan.speed_share < 0.0 ? "astern" : "stopped";
  }
  if (plan.speed_share > 1.0) {
    return "at " + fixed(plan.speed_share, 1) + " times its speed, to get away";
  }
  return plan.speed_share < 1.0 ? "at " + fixed(100.0 * plan.speed_share, 0) + " % speed"
                                : "at full speed";
}

[[nodiscard]] std::string action_of(const PlanRecord& plan) {
  const std::string speed = speed_of(plan);
  if (plan.rung == "on_route") {
    return "on the path to the goal, " + speed;
  }
  if (plan.rung == "aside") {
    return "steers " + fixed(plan.course_deg.value_or(0.0), 0) + " deg, " + speed;
  }
  if (plan.rung == "slow") {
    return "along the path, " + speed;
  }
  if (plan.rung == "stop") {
    return speed + " until it is clear";
  }
  if (plan.rung == "escape") {
    return "out of the zone it is in, " + speed;
  }
  if (plan.rung == "near_goal") {
    return "the goal lies in a zone: to the nearest free point, " + speed;
  }
  if (plan.rung == "best_point") {
    return "no way to the goal: to the nearest point that can be reached, " + speed;
  }
  if (plan.rung == "hold") {
    return plan.reason == PathReason::kFound
               ? std::string{"keeps its place"}
               : std::string{"keeps its place and waits ("} + to_string(plan.reason) + ")";
  }
  return plan.rung == "previous"
             ? std::string{"along the previous waypoints ("} + to_string(plan.reason) + ")"
             : std::string{"nothing to follow ("} + to_string(plan.reason) + ")";
}

// What there is nothing to follow without, and since when it is gone.
[[nodiscard]] std::string loss_of(const PlanRecord& plan) {
  const std::string what = plan.reason == PathReason::kNoPosition  ? "the position"
                           : plan.reason == PathReason::kNoHeading ? "the heading"
                                                                   : "the sonar's view";
  return what + " is lost, last known " + fixed(*plan.lost_for_s, 1) +
         " s ago: " + (plan.rung == "nothing" ? "nothing to follow" : action_of(plan));
}

}  // namespace

std::string describe(const PlanRecord& plan) {
  if (plan.lost_for_s) {
    return fixed(plan.t_s, 1) + " s: " + loss_of(plan);
  }
  std::string text = fixed(plan.t_s, 1) + " s: " + action_of(plan);
  if (plan.cause != 0 && plan.clearance_m) {
    const bool manoeuvre = plan.rung == "aside" || plan.rung == "slow" || plan.rung == "stop";
    text += (manoeuvre ? "; on the path obstacle " : "; obstacle ") + std::to_string(plan.cause) +
            ", " + fixed(*plan.clearance_m, 2) + " m clear in " + fixed(plan.clearance_after_s, 0) +
            " s";
  }
  if (plan.seen_ahead_m) {
    text += "; of the way ahead " + fixed(*plan.seen_ahead_m, 1) + " m are seen";
  }
  return text + " (plan " + fixed(plan.t_s - plan.captured_s, 2) + " s old)";
}

std::string describe(NoWayCause cause, double for_s) {
  const auto because = [cause] {
    switch (cause) {
      case NoWayCause::kThrusters: return "the thruster box takes no commands";
      case NoWayCause::kDisarmed: return "the thrusters are disarmed";
      case NoWayCause::kNoHeading: return "the heading is lost";
      case NoWayCause::kNoPosition: return "the position is lost";
      case NoWayCause::kNoPlan: return "there is nothing to follow";
      case NoWayCause::kNoSonar: return "the sonar is silent";
      case NoWayCause::kCurrent:
        return "it is carried elsewhere, so the current is stronger than the boat";
      case NoWayCause::kNone:
      case NoWayCause::kUnknown: break;
    }
    return "it thrusts and does not get on, and nothing says why";
  };
  return "no way made for " + fixed(for_s, 0) + " s: " + because();
}

std::string mission_news(const MissionStatus& before, const MissionStatus& now) {
  if (now.skipped > before.skipped) {
    return "makes for the next waypoint: no way to the last, which was waited for as long as the "
           "mission says";
  }
  if (now.cause == before.cause) {
    return {};
  }
  switch (now.cause) {
    case MissionCause::kDisarmed:
      return "aborted: the thrusters were disarmed, for the thruster box or the low level was gone "
             "too long";
    case MissionCause::kBlocked:
      return "held: no way to the waypoint, which was waited for as long as the mission says";
    default: return {};
  }
}

std::string PlanStory::news(const PlanRecord& plan) {
  // Along the path nothing is done about an obstacle: the nearest one may change without news.
  const std::uint32_t cause = plan.rung == "on_route" ? 0 : plan.cause;
  if ((plan.rung == rung_ && cause == cause_) || plan.t_s - told_s_ < kSilence_s) {
    return {};
  }
  rung_ = plan.rung;
  cause_ = cause;
  told_s_ = plan.t_s;
  return describe(plan);
}

}  // namespace lodesman::cli
