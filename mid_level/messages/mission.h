// SPDX-License-Identifier: Apache-2.0
// What an operator orders: a mission, the link to whoever commands, and the settings that may be
// changed under way. Plain data for the blackboard; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

inline constexpr std::size_t kMaxGoals = 128;
inline constexpr std::size_t kMaxAreas = 16;

// What is done when the commander's heartbeat is lost under way.
enum class LinkLost : std::uint8_t { kGoOn, kHold, kReturn, kAbort };
[[nodiscard]] constexpr auto enumerators(LinkLost) noexcept {
  return enumerators_to<LinkLost::kAbort>("go_on", "hold", "return", "abort");
}

// What is done where the high level was gone under way and is back.
enum class OnRestart : std::uint8_t {
  kHold,    // it holds where it is, and waits to be told
  kResume,  // it sails on
};
[[nodiscard]] constexpr auto enumerators(OnRestart) noexcept {
  return enumerators_to<OnRestart::kResume>("hold", "resume");
}

// What is done at a waypoint that cannot be reached, once it was waited for.
enum class Blocked : std::uint8_t {
  kHold,  // it holds there, and waits to be told
  kSkip,  // it makes for the next one
};
[[nodiscard]] constexpr auto enumerators(Blocked) noexcept {
  return enumerators_to<Blocked::kSkip>("hold", "skip");
}

// What is kept to between the mission's waypoints.
enum class Legs : std::uint8_t {
  kFree,  // any way that is clear
  kLine,  // the line from one to the next
};
[[nodiscard]] constexpr auto enumerators(Legs) noexcept {
  return enumerators_to<Legs::kLine>("free", "line");
}

struct Goal {
  double x_m = 0.0;  // [m] [world]
  double y_m = 0.0;  // [m] [world]

  static constexpr auto fields() noexcept {
    return field_list(field("x_m", &Goal::x_m).within(-1e6, 1e6),
                      field("y_m", &Goal::y_m).within(-1e6, 1e6));
  }
};

enum class AreaKind : std::uint8_t {
  kFence,    // to be stayed inside of
  kKeepOut,  // to be stayed outside of
};
[[nodiscard]] constexpr auto enumerators(AreaKind) noexcept {
  return enumerators_to<AreaKind::kKeepOut>("fence", "keep_out");
}

// A polygon; one vertex fewer than a wall may have, so that it can be closed.
struct MissionArea {
  static constexpr std::size_t kMaxCorners = kMaxVertices - 1;

  AreaKind kind = AreaKind::kKeepOut;
  std::uint32_t corner_count = 0;  // [-] [3, kMaxCorners]
  std::array<Vertex, kMaxCorners> corners{};

  [[nodiscard]] bool fits() const noexcept { return corner_count >= 3; }

  static constexpr auto fields() noexcept {
    using A = MissionArea;
    return field_list(field("kind", &A::kind), field("corner_count", &A::corner_count),
                      field("corners", &A::corners, &A::corner_count));
  }
};

// A mission as a file or a message gives it. Written by the command socket before the order that
// names it; read by the planner.
struct MissionDefinition {
  std::uint64_t id = 0;          // [-] > 0, counts up; OperatorCommand::mission
  double speed_m_s = 0.0;        // [m/s] > 0 steady, through the water
  double goal_radius_m = 0.0;    // [m] > 0 the goal counts as reached within this
  std::uint32_t goal_count = 0;  // [-] [0, kMaxGoals] 0: no mission
  LinkLost link_lost = LinkLost::kGoOn;
  Duration link_lost_after{};  // [ns] > 0 without a heartbeat of the commander
  OnRestart on_restart = OnRestart::kHold;
  Legs legs = Legs::kFree;
  Blocked blocked = Blocked::kHold;
  Duration blocked_patience{};          // [ns] >= 0 that a waypoint is waited for
  std::array<Goal, kMaxGoals> goals{};  // waypoints in order, the goal last
  std::uint32_t area_count = 0;         // [-] [0, kMaxAreas]
  std::array<MissionArea, kMaxAreas> areas{};

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(MissionDefinition, areas) +
           std::min<std::size_t>(area_count, kMaxAreas) * sizeof(MissionArea);
  }

  static constexpr auto fields() noexcept {
    using M = MissionDefinition;
    return field_list(
        field("id", &M::id), field("speed_m_s", &M::speed_m_s).within(0.0, 100.0),
        field("goal_radius_m", &M::goal_radius_m).within(0.0, 1e3),
        field("goal_count", &M::goal_count), field("link_lost", &M::link_lost),
        field("link_lost_after", &M::link_lost_after), field("on_restart", &M::on_restart),
        field("legs", &M::legs), field("blocked", &M::blocked),
        field("blocked_patience", &M::blocked_patience), field("goals", &M::goals, &M::goal_count),
        field("area_count", &M::area_count), field("areas", &M::areas, &M::area_count));
  }
};

// Who commands. Written by the command socket at each heartbeat and whenever the command changes
// hands; read by the planner and displays.
struct CommandLink {
  std::uint64_t session = 0;  // [-] of the commander; 0: nobody commands
  Time opened{};              // [ns] when that session took command; 0: never
  Time heard{};               // [ns] its last heartbeat

  static constexpr auto fields() noexcept {
    using L = CommandLink;
    return field_list(field("session", &L::session), field("opened", &L::opened),
                      field("heard", &L::heard));
  }
};

// The settings that an operator may change under way. What guards the boat (ages, least margins,
// the thruster's own limits) is not among them. Written by the command socket, first of all as the
// configuration has them; read by the planner, the controller and displays.
struct Tunables {
  std::uint64_t version = 0;          // [-] counts up at each change; 0: none published yet
  double speed_limit_m_s = 0.0;       // [m/s] > 0 no mission is sailed faster
  double margin_m = 0.0;              // [m] zones.margin_m
  double side_gain_m = 0.0;           // [m] pilot.side_gain_m
  double manoeuvre_gain_s = 0.0;      // [s] pilot.manoeuvre_gain_s
  double heading_gain_per_deg = 0.0;  // [1/deg] > 0 control.heading_gain_per_deg

  static constexpr auto fields() noexcept {
    using T = Tunables;
    return field_list(field("version", &T::version),
                      field("speed_limit_m_s", &T::speed_limit_m_s).within(0.0, 100.0),
                      field("margin_m", &T::margin_m).within(0.0, 20.0),
                      field("side_gain_m", &T::side_gain_m).within(0.0, 100.0),
                      field("manoeuvre_gain_s", &T::manoeuvre_gain_s).within(0.0, 100.0),
                      field("heading_gain_per_deg", &T::heading_gain_per_deg).within(0.0, 100.0));
  }
};

}  // namespace lodesman
