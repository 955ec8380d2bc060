// SPDX-License-Identifier: Apache-2.0
// What a run leaves behind, as plain data: the run directory's files and pictures are made from
// it, and from nothing else. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/report/cross_track.h"
#include "mid_level/geometry/moving_obstacle.h"
#include "mid_level/messages/path.h"

namespace lodesman::cli {

// One line of trajectory.csv, 10 Hz; x, y and heading are the truth. Times are scenario times.
struct TrajectoryRow {
  double t_s = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_deg = 0.0;  // [0, 360)
  double estimate_x_m = 0.0;
  double estimate_y_m = 0.0;
  double surge_m_s = 0.0;
  int surge_ref = 0;
  int head_ref = 0;
  int thrust_left = 128;
  int thrust_right = 128;
  double id_m = std::numeric_limits<double>::infinity();  // infinity: no obstacle exists
  std::uint64_t plan_id = 0;
  bool path_found = false;
  double waypoint_x_m = 0.0;
  double waypoint_y_m = 0.0;
};

// One line of plans.jsonl.
struct PlanRecord {
  std::uint64_t id = 0;
  double t_s = 0.0;                 // when the plan was published
  double captured_s = 0.0;          // capture time of the sonar frame it was made in
  std::array<double, 2> start_m{};  // [world] the vehicle's estimated position at that capture
  double start_heading_deg = 0.0;
  std::array<double, 2> goal_m{};  // [world]
  PathReason reason = PathReason::kNoPath;
  std::optional<double> lost_for_s;  // nothing known without a frame, a position or a heading
  std::string waypoint_source;       // "none", "current", "previous"
  // What the plan does and why; see PlanRung.
  std::string rung;
  double speed_share = 1.0;
  bool changed = false;  // another side or another manoeuvre than before
  std::uint32_t cause = 0;
  std::optional<double> clearance_m;  // least one foreseen
  double clearance_after_s = 0.0;
  std::optional<double> seen_ahead_m;  // of the way, where that is too little for its speed
  std::optional<double> course_deg;    // where it is steered by
  std::optional<int> cost_10_14;       // empty where no path was found
  std::uint32_t expansions = 0;
  double plan_time_us = 0.0;                       // measured
  std::vector<std::array<double, 2>> path_m;       // [world] every pixel, start first
  std::vector<std::array<double, 2>> waypoints_m;  // [world] those followed from here on
};

// Something that an operator should know: that no way is made, and why.
struct Notice {
  double t_s = 0.0;
  std::string text;
};

// What the guard of the low level stopped the boat for.
struct GuardTrip {
  double t_s = 0.0;
  std::string reason;
  double distance_m = 0.0;
  double speed_m_s = 0.0;
};

struct Percentiles {
  double p50 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

// Whose word a run's track and distances are.
enum class CountedFrom : std::uint8_t {
  kTruth,     // the simulated world's
  kEstimate,  // the boat's own, of itself and of what it tracks: it collides with nothing
};
[[nodiscard]] constexpr auto enumerators(CountedFrom) noexcept {
  return enumerators_to<CountedFrom::kEstimate>("truth", "estimate");
}

// result.json, in the order of the contract. An optional that is empty is written as null.
struct RunResult {
  std::string scenario;
  std::string profile;
  std::string mode;  // "realtime", "lockstep", "hil"
  std::int64_t seed = 0;
  std::string outcome;  // "goal", "time_limit", "aborted", "held", "collision", "fault"
  bool reached = false;
  bool collided = false;
  double time_s = 0.0;
  std::array<double, 2> final_m{};
  double goal_error_m = 0.0;
  double estimate_error_m = 0.0;
  double path_length_m = 0.0;
  double mean_speed_m_s = 0.0;
  std::optional<double> min_inoffensive_distance_m;
  std::optional<double> time_of_min_inoffensive_distance_s;
  std::optional<double> min_hull_clearance_m;
  std::uint64_t plans = 0;
  std::uint64_t plans_found = 0;
  std::uint64_t plans_not_found = 0;
  std::map<std::string, std::uint64_t> plan_reasons;
  std::map<std::string, double> rung_s;  // [s] under way by plans of each rung
  std::uint64_t side_flips = 0;
  std::optional<double> first_side_flip_s;  // not written
  double heading_travel_deg = 0.0;
  std::optional<CrossTrack> cross_track;  // not written where no line was kept
  Percentiles plan_time_us;
  Percentiles ping_to_command_us;
  std::uint64_t overruns = 0;
  std::uint64_t stale_events = 0;
  std::vector<Notice> notices;         // the first kMaxNotices
  std::vector<GuardTrip> guard_trips;  // the first kMaxNotices
  double real_time_factor = 0.0;
  std::optional<std::string> recording_hash;        // lock-step only
  std::optional<std::array<double, 2>> origin_deg;  // [deg] latitude, longitude of the world's
  std::string version;
  CountedFrom counted_from = CountedFrom::kTruth;
  // Published and overwritten while nobody looked: lengths and counts above lack them. Not written.
  std::uint64_t truths_missed = 0;
  std::uint64_t plans_missed = 0;
  std::string fault;  // one line when the outcome is "fault"; not written otherwise
};

struct RunRecord {
  RunResult result;
  std::int64_t started_utc_ns = 0;  // [ns] since 1970, by the receiver; 0: it told none
  // Of a long run some of them, see KeptRows and KeptPlans; the files have all.
  std::vector<TrajectoryRow> trajectory;
  std::vector<PlanRecord> plans;
  // What was sailed: for the pictures.
  std::array<double, 2> start_m{};
  std::array<double, 2> goal_m{};
  double goal_radius_m = 0.5;
  double vehicle_radius_m = 0.5;
  double waypoint_radius_m = 0.5;
  std::vector<MovingObstacle> obstacles;
};

}  // namespace lodesman::cli
