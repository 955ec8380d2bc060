// SPDX-License-Identifier: Apache-2.0
// From the operator's word to the propellers: mission, plan, helm, thrust. Plain data for
// the blackboard; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"
#include "mid_level/messages/path.h"

namespace lodesman {

enum class OperatorOrder : std::uint8_t { kNone, kStart, kAbort, kHold, kResume };
[[nodiscard]] constexpr auto enumerators(OperatorOrder) noexcept {
  return enumerators_to<OperatorOrder::kResume>("none", "start", "abort", "hold", "resume");
}

// Written by the command socket (or by the program that starts a simulation); read by the
// planner task, where the mission lives.
struct OperatorCommand {
  OperatorOrder order = OperatorOrder::kNone;
  std::uint64_t aborts = 0;   // [-] ordered on this blackboard so far, this one included
  std::uint64_t mission = 0;  // [-] start: MissionDefinition::id; 0: the one at hand

  static constexpr auto fields() noexcept {
    return field_list(field("order", &OperatorCommand::order),
                      field("aborts", &OperatorCommand::aborts),
                      field("mission", &OperatorCommand::mission));
  }
};

enum class MissionState : std::uint8_t { kIdle, kUnderWay, kReached, kAborted, kHolding };
[[nodiscard]] constexpr auto enumerators(MissionState) noexcept {
  return enumerators_to<MissionState::kHolding>("idle", "under_way", "reached", "aborted",
                                                "holding");
}

// What became of an order other than abort.
enum class OrderAnswer : std::uint8_t {
  kNone,         // there was no order yet
  kObeyed,       // the mission is as it was ordered to be
  kNotUnderWay,  // refused: nothing to hold from
  kNotHolding,   // refused: nothing to resume
  kAborted,      // refused: an abort stood beside it
  kTooOld,       // refused: it was not taken in time
  kNoMission,    // refused: there is none to start
};
[[nodiscard]] constexpr auto enumerators(OrderAnswer) noexcept {
  return enumerators_to<OrderAnswer::kNoMission>("none", "obeyed", "not_under_way", "not_holding",
                                                 "aborted", "too_old", "no_mission");
}

// Who brought the mission into its state.
enum class MissionCause : std::uint8_t {
  kOrder,     // an operator's word, or the voyage itself
  kAbsence,   // its process was frozen
  kLinkLost,  // the commander's heartbeat was lost
  kRestart,   // its process was started anew: what the mission says of that was done
  kDisarmed,  // the thrusters were disarmed, and by nobody's word
  kBlocked,   // a waypoint could not be reached, and was waited for long enough
};
[[nodiscard]] constexpr auto enumerators(MissionCause) noexcept {
  return enumerators_to<MissionCause::kBlocked>("order", "absence", "link_lost", "restart",
                                                "disarmed", "blocked");
}

// Why no way is made over ground though it is wanted.
enum class NoWayCause : std::uint8_t {
  kNone,        // way is made, or none is wanted
  kUnknown,     // it thrusts and stays where it is: stuck, stalled, or the water holds it
  kThrusters,   // the thruster box takes no commands, or says nothing
  kNoHeading,   // the heading is lost
  kNoPosition,  // the position is lost
  kNoPlan,      // there is nothing to follow
  kCurrent,     // it is carried elsewhere: the current is stronger than the boat
  kDisarmed,    // nobody lets the thrusters turn: disarmed, or stopped by emergency
  kNoSonar,     // the sonar is silent: it stays where it is
};
[[nodiscard]] constexpr auto enumerators(NoWayCause) noexcept {
  return enumerators_to<NoWayCause::kNoSonar>("none", "unknown", "thrusters", "no_heading",
                                              "no_position", "no_plan", "current", "disarmed",
                                              "no_sonar");
}

// Written by the planner task at every step; read by the controller, the world (its scenario's
// time starts with the mission) and displays.
struct MissionStatus {
  MissionState state = MissionState::kIdle;
  MissionCause cause = MissionCause::kOrder;
  std::uint64_t mission = 0;     // [-] MissionDefinition::id; 0: none yet
  double speed_m_s = 0.0;        // [m/s] of that mission, through the water
  std::int32_t surge_ref = 0;    // [-] [0, 100] that holds it, by the boat's own calibration
  Time first_started{};          // [ns] of the first start; a scenario's time begins there
  Time started{};                // [ns] of the last start; 0 before one
  Time ended{};                  // [ns] when it was reached or aborted
  std::uint32_t goal_index = 0;  // [-] of the goal made for: mission waypoints first, goal last
  double goal_x_m = 0.0;         // [m] [world] that goal; while holding the place held
  double goal_y_m = 0.0;         // [m] [world]
  Time blocked_since{};          // [ns] it cannot be reached, and is waited for; 0: it is made for
  std::uint32_t skipped = 0;     // [-] waypoints left out since the start, as they were blocked
  double home_x_m = 0.0;         // [m] [world] where it set out from
  double home_y_m = 0.0;         // [m] [world]
  bool keeps_line = false;       // to the next waypoint, from the last or from where it set out
  double line_begin_x_m = 0.0;   // [m] [world] of that line; it ends at the goal
  double line_begin_y_m = 0.0;   // [m] [world]
  double cross_track_m = 0.0;    // [m] off that line, to starboard positive
  std::uint64_t aborts = 0;      // [-] obeyed so far: OperatorCommand::aborts of the last one
  std::uint64_t order = 0;       // [-] sequence of the last order answered, aborts apart
  OrderAnswer answer = OrderAnswer::kNone;  // to that order
  NoWayCause no_way = NoWayCause::kNone;    // other than none: no way has been made ...
  Time no_way_since{};                      // [ns] ... since then

  static constexpr auto fields() noexcept {
    using M = MissionStatus;
    return field_list(
        field("state", &M::state), field("cause", &M::cause), field("mission", &M::mission),
        field("speed_m_s", &M::speed_m_s).within(0.0, 100.0),
        field("surge_ref", &M::surge_ref).within(0, 100), field("first_started", &M::first_started),
        field("started", &M::started), field("ended", &M::ended),
        field("goal_index", &M::goal_index), field("goal_x_m", &M::goal_x_m),
        field("goal_y_m", &M::goal_y_m), field("blocked_since", &M::blocked_since),
        field("skipped", &M::skipped), field("home_x_m", &M::home_x_m),
        field("home_y_m", &M::home_y_m), field("keeps_line", &M::keeps_line),
        field("line_begin_x_m", &M::line_begin_x_m), field("line_begin_y_m", &M::line_begin_y_m),
        field("cross_track_m", &M::cross_track_m), field("aborts", &M::aborts),
        field("order", &M::order), field("answer", &M::answer), field("no_way", &M::no_way),
        field("no_way_since", &M::no_way_since));
  }
};

inline constexpr std::size_t kMaxWaypoints = 256;

struct Waypoint {
  double x_m = 0.0;  // [m] [world]
  double y_m = 0.0;  // [m] [world]

  static constexpr auto fields() noexcept {
    return field_list(field("x_m", &Waypoint::x_m), field("y_m", &Waypoint::y_m));
  }
};

enum class WaypointSource : std::uint8_t {
  kNone,      // no waypoints: there never was a path, or the last one is too old to follow
  kCurrent,   // of the path just found
  kPrevious,  // no path found: the previous waypoints stand (step 12.4.1)
};
[[nodiscard]] constexpr auto enumerators(WaypointSource) noexcept {
  return enumerators_to<WaypointSource::kPrevious>("none", "current", "previous");
}

// What the plan does about it when the straight way to the goal is not to be had; the highest one
// that works is taken.
enum class PlanRung : std::uint8_t {
  kOnRoute,    // along the path to the goal
  kAside,      // on another course for a while, because of something that moves or is close
  kSlow,       // along the path, slower
  kStop,       // stopped or astern, until it is clear
  kEscape,     // out of a zone that the vehicle is in
  kNearGoal,   // the goal lies in a zone: to the nearest free point, and wait there
  kBestPoint,  // nothing leads to the goal: to the nearest point that can be reached, and wait
  kHold,       // at the place to wait at, kept against wind and current
  kPrevious,   // no answer or no frame: along the previous waypoints
  kNothing,    // nothing to follow
};
[[nodiscard]] constexpr auto enumerators(PlanRung) noexcept {
  return enumerators_to<PlanRung::kNothing>("on_route", "aside", "slow", "stop", "escape",
                                            "near_goal", "best_point", "hold", "previous",
                                            "nothing");
}

// How the controller follows a plan.
enum class SteerBy : std::uint8_t {
  kWaypoints,  // for the waypoint ahead (the paper's eq. 8)
  kLine,       // by line of sight along the line through the waypoints
  kCourse,     // on a course
};
[[nodiscard]] constexpr auto enumerators(SteerBy) noexcept {
  return enumerators_to<SteerBy::kCourse>("waypoints", "line", "course");
}

// One pass through Fig. 1. Written by the planner task once an answer of PathFinder (or a request
// that got none); read by the controller and displays.
struct Plan {
  std::uint64_t id = 0;           // [-] PathRequest::id
  std::uint64_t frame = 0;        // [-] SonarObstacles::frame
  Time captured{};                // [ns] of the frame; the pose below is the vehicle's at that time
  double pose_x_m = 0.0;          // [m] [world]
  double pose_y_m = 0.0;          // [m] [world]
  double pose_heading_rad = 0.0;  // [rad] [-pi, pi]
  double goal_x_m = 0.0;          // [m] [world]
  double goal_y_m = 0.0;          // [m] [world]
  PathReason reason = PathReason::kNoPath;
  // [ns] kNoFrame, kNoPosition, kNoHeading: when the last of what is missing was measured; 0: never
  Time lost_since{};
  WaypointSource source = WaypointSource::kNone;
  PlanRung rung = PlanRung::kOnRoute;
  SteerBy steer_by = SteerBy::kWaypoints;
  double course_rad = 0.0;   // [rad] [-pi, pi] steered, or faced while holding
  double speed_share = 1.0;  // [-] [-100, 100] of the mission's SurgeRef; more than 1: to get away
  bool stay_at_end = false;  // the last waypoint is a place to wait at
  bool narrow = false;       // zones had to give what they may
  // Of the way ahead, where that is too little for the mission's speed; else infinity.
  double seen_ahead_m = std::numeric_limits<double>::infinity();  // [m]
  bool changed = false;              // another side or another manoeuvre than in the plan before
  std::uint32_t cause = 0;           // [-] Track::id that the rung is about; 0: none
  double clearance_m = 0.0;          // [m] least one foreseen, of the hull; infinity: no obstacle
  double clearance_after_s = 0.0;    // [s] when
  std::uint64_t path_id = 0;         // [-] the plan whose path the waypoints belong to
  Time path_captured{};              // [ns] capture time of that plan's frame: how old the path is
  std::uint32_t waypoint_count = 0;  // [-] [0, kMaxWaypoints]
  std::array<Waypoint, kMaxWaypoints> waypoints{};

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(Plan, waypoints) +
           std::min<std::size_t>(waypoint_count, kMaxWaypoints) * sizeof(Waypoint);
  }

  static constexpr auto fields() noexcept {
    using P = Plan;
    return field_list(
        field("id", &P::id), field("frame", &P::frame), field("captured", &P::captured),
        field("pose_x_m", &P::pose_x_m), field("pose_y_m", &P::pose_y_m),
        field("pose_heading_rad", &P::pose_heading_rad).within(-kHalfTurn_rad, kHalfTurn_rad),
        field("goal_x_m", &P::goal_x_m), field("goal_y_m", &P::goal_y_m),
        field("reason", &P::reason), field("lost_since", &P::lost_since),
        field("source", &P::source), field("rung", &P::rung), field("steer_by", &P::steer_by),
        field("course_rad", &P::course_rad).within(-kHalfTurn_rad, kHalfTurn_rad),
        field("speed_share", &P::speed_share).within(-100.0, 100.0),
        field("stay_at_end", &P::stay_at_end), field("narrow", &P::narrow),
        field("seen_ahead_m", &P::seen_ahead_m).or_infinite(), field("changed", &P::changed),
        field("cause", &P::cause), field("clearance_m", &P::clearance_m).or_infinite(),
        field("clearance_after_s", &P::clearance_after_s), field("path_id", &P::path_id),
        field("path_captured", &P::path_captured), field("waypoint_count", &P::waypoint_count),
        field("waypoints", &P::waypoints, &P::waypoint_count));
  }
};

enum class HelmReason : std::uint8_t {
  kTracking,       // steering for a waypoint
  kNotUnderWay,    // idle, reached or aborted: neutral
  kNoWaypoints,    // under way without a plan to follow: neutral
  kStaleState,     // the estimate is too old: neutral
  kStaleAttitude,  // the heading is too old: neutral
  kStaleMission,   // the mission has fallen silent: neutral
  kNotSane,        // what came out of it is no command: neutral
};
[[nodiscard]] constexpr auto enumerators(HelmReason) noexcept {
  return enumerators_to<HelmReason::kNotSane>("tracking", "not_under_way", "no_waypoints",
                                              "stale_state", "stale_attitude", "stale_mission",
                                              "not_sane");
}

// Written by the controller task at 20 Hz; read by the thruster task.
struct HelmCommand {
  HelmReason reason = HelmReason::kNotUnderWay;
  std::int32_t surge_ref = 0;        // [-] [-100, 100] eq. 7; 0 unless tracking
  std::int32_t head_ref = 0;         // [-] [-100, 100] eq. 9; positive turns right
  std::uint64_t plan_id = 0;         // [-] the plan steered by
  Time plan_captured{};              // [ns] capture time of that plan's sonar frame
  std::uint32_t waypoint_index = 0;  // [-] within that plan
  double waypoint_x_m = 0.0;         // [m] [world]
  double waypoint_y_m = 0.0;         // [m] [world]

  static constexpr auto fields() noexcept {
    using C = HelmCommand;
    return field_list(
        field("reason", &C::reason), field("surge_ref", &C::surge_ref).within(-100, 100),
        field("head_ref", &C::head_ref).within(-100, 100), field("plan_id", &C::plan_id),
        field("plan_captured", &C::plan_captured), field("waypoint_index", &C::waypoint_index),
        field("waypoint_x_m", &C::waypoint_x_m), field("waypoint_y_m", &C::waypoint_y_m));
  }
};

// The paper's thrust commands, eqs 13-14. 0-126 astern, 127 and 128 stop, 129-255 ahead.
struct ThrustCommand {
  std::uint8_t left = 128;   // [-] [0, 255]
  std::uint8_t right = 128;  // [-] [0, 255]

  friend bool operator==(const ThrustCommand&, const ThrustCommand&) = default;
};
inline constexpr ThrustCommand kNeutralThrust{};

enum class ThrustReason : std::uint8_t {
  kCommanded,     // the thrusters run as the helm says
  kNoCommand,     // the helm has not spoken yet: neutral
  kStaleCommand,  // the helm has fallen silent: neutral
  kDeviceFailed,  // the thruster box does not take commands
  kNoThrusters,   // the configuration has none
  kDisarmed,      // nobody has armed the thrusters: neutral
  kStopped,       // the emergency stop: neutral
  kManual,        // the thrusters run as the stick says
  kStickSilent,   // the stick has fallen silent: neutral
  kGuarded,       // the guard brakes, or keeps neutral, whatever is asked for
};
[[nodiscard]] constexpr auto enumerators(ThrustReason) noexcept {
  return enumerators_to<ThrustReason::kGuarded>("commanded", "no_command", "stale_command",
                                                "device_failed", "no_thrusters", "disarmed",
                                                "stopped", "manual", "stick_silent", "guarded");
}

// Written by the thruster task at 20 Hz, after the box took the command; where it took none, all is
// neutral; read by the estimator
// and displays.
struct ThrustApplied {
  ThrustReason reason = ThrustReason::kNoCommand;
  std::uint8_t left = 128;             // [-] [0, 255] 127 and 128 stop
  std::uint8_t right = 128;            // [-] [0, 255]
  std::int32_t surge_ref = 0;          // [-] [-100, 100] as applied; 0 when neutral
  std::int32_t head_ref = 0;           // [-] [-100, 100]
  std::uint64_t command_sequence = 0;  // [-] of the HelmCommand applied
  Time command_stamp{};                // [ns] when that command was published
  std::uint64_t plan_id = 0;           // [-] of that command
  Time plan_captured{};                // [ns] of that command

  static constexpr auto fields() noexcept {
    using T = ThrustApplied;
    return field_list(
        field("reason", &T::reason), field("left", &T::left), field("right", &T::right),
        field("surge_ref", &T::surge_ref).within(-100, 100),
        field("head_ref", &T::head_ref).within(-100, 100),
        field("command_sequence", &T::command_sequence), field("command_stamp", &T::command_stamp),
        field("plan_id", &T::plan_id), field("plan_captured", &T::plan_captured));
  }
};

}  // namespace lodesman
