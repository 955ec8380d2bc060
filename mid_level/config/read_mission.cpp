// SPDX-License-Identifier: Apache-2.0
#include "mid_level/config/read_mission.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

// What a mission may ask for (ours): far beyond any sensible one, and small enough that no sum or
// square of it loses its meaning.
constexpr Range kCoordinate_m = Range::between(-1e5, 1e5);
constexpr Range kDegrees = Range::between(-180.0, 180.0);
constexpr Range kGoalRadius_m = Range::above(0.0, 100.0);
constexpr Range kSpeed_m_s = Range::above(0.0, 10.0);
constexpr Range kLinkLostAfter_s = Range::between(1.5, 3600.0);
constexpr Range kBlockedPatience_s = Range::between(0.0, 86400.0);
constexpr double kPole_deg = 85.0;  // nearer to it east has no meaning

using Pair = std::array<double, 2>;

[[nodiscard]] Goal goal_of(const Pair& pair) noexcept { return {pair[0], pair[1]}; }

// Far from the origin the plane is not the earth any more.
[[nodiscard]] Goal goal_of_geodetic(const TomlTable& table, const char* key, const Pair& pair,
                                    const LocalFrame* frame) {
  if (std::abs(pair[0]) > kPole_deg) {
    table.refuse(key, "latitude must be at least -85 and at most 85");
  }
  if (frame == nullptr) {
    return {};
  }
  if (!frame->is_fixed()) {
    table.refuse(key, "the origin of the boat's world is not fixed yet: no good fix has come");
  }
  const WorldPoint at = frame->to_world({pair[0], pair[1]});
  if (!(at.xy_m.cwiseAbs().maxCoeff() <= kCoordinate_m.max)) {
    table.refuse(key, "is farther than 100 km from the origin of the boat's world");
  }
  return {at.xy_m.x(), at.xy_m.y()};
}

// One of two keys, or neither where it may be left out.
[[nodiscard]] const char* one_of(const TomlTable& table, const char* metres, const char* degrees,
                                 bool required) {
  if (table.has(metres) && table.has(degrees)) {
    table.refuse(degrees, std::string{"give either "} + metres + " or " + degrees);
  }
  return table.has(degrees) ? degrees : required || table.has(metres) ? metres : nullptr;
}

void add_goal(Goal goal, MissionDefinition& mission) noexcept {
  mission.goals[mission.goal_count++] = goal;
}

void read_goals(const TomlTable& table, const LocalFrame* frame, MissionDefinition& mission) {
  constexpr const char* kWaypoints_m = "waypoints_m";
  constexpr const char* kWaypoints_deg = "waypoints_deg";
  if (one_of(table, kWaypoints_m, kWaypoints_deg, false) == kWaypoints_m) {
    for (const Pair& pair : table.pairs(kWaypoints_m, kCoordinate_m, 0, kMaxGoals - 1)) {
      add_goal(goal_of(pair), mission);
    }
  } else if (table.has(kWaypoints_deg)) {
    for (const Pair& pair : table.pairs(kWaypoints_deg, kDegrees, 0, kMaxGoals - 1)) {
      add_goal(goal_of_geodetic(table, kWaypoints_deg, pair, frame), mission);
    }
  }
  constexpr const char* kGoal_deg = "goal_deg";
  if (one_of(table, "goal_m", kGoal_deg, true) == kGoal_deg) {
    add_goal(goal_of_geodetic(table, kGoal_deg, table.pair(kGoal_deg, kDegrees), frame), mission);
  } else {
    add_goal(goal_of(table.pair("goal_m", kCoordinate_m)), mission);
  }
}

[[nodiscard]] MissionArea area_of(const TomlTable& table, const char* key, AreaKind kind,
                                  const std::vector<Pair>& corners) {
  MissionArea area;
  area.kind = kind;
  double twice_m2 = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Pair& next = corners[(i + 1) % corners.size()];
    twice_m2 += corners[i][0] * next[1] - corners[i][1] * next[0];
    area.corners[area.corner_count++] = {corners[i][0], corners[i][1]};
  }
  if (!(std::abs(twice_m2) > 1e-6)) {
    table.refuse(key, "encloses nothing");
  }
  return area;
}

void read_areas(const TomlTable& table, MissionDefinition& mission) {
  constexpr std::size_t kLeast = 3;
  if (table.has("fence_m")) {
    mission.areas[mission.area_count++] =
        area_of(table, "fence_m", AreaKind::kFence,
                table.pairs("fence_m", kCoordinate_m, kLeast, MissionArea::kMaxCorners));
  }
  if (table.has("keep_out_m")) {
    for (const auto& corners : table.polygons("keep_out_m", kCoordinate_m, kLeast,
                                              MissionArea::kMaxCorners, kMaxAreas - 1)) {
      mission.areas[mission.area_count++] =
          area_of(table, "keep_out_m", AreaKind::kKeepOut, corners);
    }
  }
}

[[nodiscard]] LinkLost read_link_lost(const TomlTable& table) {
  return static_cast<LinkLost>(table.choice("link_lost", {"go_on", "hold", "return", "abort"}));
}

[[nodiscard]] OnRestart read_on_restart(const TomlTable& table) {
  return static_cast<OnRestart>(table.choice("on_restart", {"hold", "resume"}));
}

[[nodiscard]] Legs read_legs(const TomlTable& table) {
  return static_cast<Legs>(table.choice("legs", {"free", "line"}));
}

[[nodiscard]] Blocked read_blocked(const TomlTable& table) {
  return static_cast<Blocked>(table.choice("blocked", {"hold", "skip"}));
}

// What is asked for and not done yet is refused, rather than taken and not done.
void require_done(const TomlTable& table, const char* key, std::string_view done) {
  if (table.has(key) && table.text(key, 64) != done) {
    table.refuse(key, "only \"" + std::string{done} + "\" is done yet");
  }
}

void refuse_undone(const TomlTable& table, const char* key) {
  if (table.has(key)) {
    table.refuse(key, "is not done yet: leave it out");
  }
}

}  // namespace

MissionDefaults read_mission_defaults(const TomlTable& table) {
  return {table.number("goal_radius_m", kGoalRadius_m),
          table.number("speed_m_s", kSpeed_m_s),
          read_link_lost(table),
          table.duration("link_lost_after_s", kLinkLostAfter_s),
          read_on_restart(table),
          read_blocked(table),
          table.duration("blocked_patience_s", kBlockedPatience_s)};
}

MissionDefinition read_mission(const TomlTable& table, const MissionDefaults& defaults,
                               const LocalFrame* frame) {
  MissionDefinition mission;
  read_goals(table, frame, mission);
  mission.goal_radius_m = table.number_or("goal_radius_m", kGoalRadius_m, defaults.goal_radius_m);
  mission.speed_m_s = table.number_or("speed_m_s", kSpeed_m_s, defaults.speed_m_s);
  mission.link_lost = table.has("link_lost") ? read_link_lost(table) : defaults.link_lost;
  mission.link_lost_after = table.has("link_lost_after_s")
                                ? table.duration("link_lost_after_s", kLinkLostAfter_s)
                                : defaults.link_lost_after;
  mission.on_restart = table.has("on_restart") ? read_on_restart(table) : defaults.on_restart;
  mission.legs = table.has("legs") ? read_legs(table) : Legs::kFree;
  mission.blocked = table.has("blocked") ? read_blocked(table) : defaults.blocked;
  mission.blocked_patience = table.has("blocked_patience_s")
                                 ? table.duration("blocked_patience_s", kBlockedPatience_s)
                                 : defaults.blocked_patience;
  read_areas(table, mission);
  refuse_undone(table, "battery_low");
  require_done(table, "colregs", "off");
  return mission;
}

MissionDefinition read_mission_text(std::string_view text, const std::string& name,
                                    const MissionDefaults& defaults, const LocalFrame* frame) {
  const TomlDocument document = TomlDocument::from_text(text, name);
  // The same keys alone, or in a table as a scenario has them.
  const TomlTable root = document.root();
  const MissionDefinition mission =
      read_mission(root.has("mission") ? root.table("mission") : root, defaults, frame);
  document.require_all_keys_read();
  return mission;
}

}  // namespace lodesman
