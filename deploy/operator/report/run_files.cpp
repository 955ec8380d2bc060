// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/run_files.h"

#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>

#include "deploy/operator/report/numbers.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

using Json = nlohmann::ordered_json;

// Micrometres, microseconds: as fine as anything here is meant, and no 0.30000000000000004.
constexpr int kResultDecimals = 6;
constexpr int kPlanDecimals = 3;
constexpr int kDegreeDecimals = 9;  // 0.1 mm

// More than result.json can take: its reasons for plans are a handful.
constexpr std::size_t kResultRoom_bytes = 8192;

Json number(double value, int decimals) {
  return std::isfinite(value) ? Json(rounded(value, decimals)) : Json(nullptr);
}

Json number(const std::optional<double>& value, int decimals) {
  return value ? number(*value, decimals) : Json(nullptr);
}

Json point(const std::array<double, 2>& xy, int decimals) {
  return Json::array({number(xy[0], decimals), number(xy[1], decimals)});
}

Json points(const std::vector<std::array<double, 2>>& line, int decimals) {
  Json array = Json::array();
  for (const auto& xy : line) {
    array.push_back(point(xy, decimals));
  }
  return array;
}

Json percentile_json(const Percentiles& p) {
  return {{"p50", number(p.p50, kResultDecimals)},
          {"p99", number(p.p99, kResultDecimals)},
          {"max", number(p.max, kResultDecimals)}};
}

// Text of others (a scenario's name) may not be UTF-8; a document that cannot be parsed would be
// the worse answer.
std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json plan_json(const PlanRecord& plan) {
  Json json;
  json["id"] = plan.id;
  json["t_s"] = number(plan.t_s, kPlanDecimals);
  json["captured_s"] = number(plan.captured_s, kPlanDecimals);
  json["start_m"] = point(plan.start_m, kPlanDecimals);
  json["start_heading_deg"] = number(plan.start_heading_deg, kPlanDecimals);
  json["goal_m"] = point(plan.goal_m, kPlanDecimals);
  json["found"] = plan.reason == PathReason::kFound;
  json["reason"] = to_string(plan.reason);
  json["cost_10_14"] = plan.cost_10_14 ? Json(*plan.cost_10_14) : Json(nullptr);
  json["path_m"] = points(plan.path_m, kPlanDecimals);
  json["waypoint_source"] = plan.waypoint_source;
  json["rung"] = plan.rung;
  json["changed"] = plan.changed;
  json["speed_share"] = number(plan.speed_share, kPlanDecimals);
  json["course_deg"] = plan.course_deg ? number(*plan.course_deg, kPlanDecimals) : Json(nullptr);
  json["obstacle"] = plan.cause != 0 ? Json(plan.cause) : Json(nullptr);
  json["clearance_m"] = plan.clearance_m ? number(*plan.clearance_m, kPlanDecimals) : Json(nullptr);
  json["clearance_after_s"] = number(plan.clearance_after_s, kPlanDecimals);
  json["seen_ahead_m"] =
      plan.seen_ahead_m ? number(*plan.seen_ahead_m, kPlanDecimals) : Json(nullptr);
  json["plan_age_s"] = number(plan.t_s - plan.captured_s, kPlanDecimals);
  json["waypoints_m"] = points(plan.waypoints_m, kPlanDecimals);
  json["expansions"] = plan.expansions;
  json["plan_time_us"] = number(plan.plan_time_us, kPlanDecimals);
  return json;
}

void append_fields(std::string& line, int decimals, std::initializer_list<double> values) {
  for (const double value : values) {
    line += fixed(value, decimals);
    line += ',';
  }
}

void append_fields(std::string& line, std::initializer_list<long long> values) {
  for (const long long value : values) {
    line += std::to_string(value);
    line += ',';
  }
}

std::string csv_line(const TrajectoryRow& row) {
  std::string line;
  append_fields(line, 3, {row.t_s});
  append_fields(line, 4, {row.x_m, row.y_m});
  append_fields(line, 3, {row.heading_deg});
  append_fields(line, 4, {row.estimate_x_m, row.estimate_y_m, row.surge_m_s});
  append_fields(line, {row.surge_ref, row.head_ref, row.thrust_left, row.thrust_right});
  append_fields(line, 4, {row.id_m});
  line += std::to_string(row.plan_id) + (row.path_found ? ",1," : ",0,");
  append_fields(line, 4, {row.waypoint_x_m, row.waypoint_y_m});
  line.back() = '\n';  // in the place of the last comma
  return line;
}

}  // namespace

std::string result_json(const RunResult& result) {
  const auto metric = [](const auto& value) { return number(value, kResultDecimals); };
  Json json;
  json["scenario"] = result.scenario;
  json["profile"] = result.profile;
  json["mode"] = result.mode;
  json["seed"] = result.seed;
  json["outcome"] = result.outcome;
  json["reached"] = result.reached;
  json["collided"] = result.collided;
  json["time_s"] = metric(result.time_s);
  json["final_m"] = point(result.final_m, kResultDecimals);
  json["goal_error_m"] = metric(result.goal_error_m);
  json["estimate_error_m"] = metric(result.estimate_error_m);
  json["path_length_m"] = metric(result.path_length_m);
  json["mean_speed_m_s"] = metric(result.mean_speed_m_s);
  json["min_inoffensive_distance_m"] = metric(result.min_inoffensive_distance_m);
  json["time_of_min_inoffensive_distance_s"] = metric(result.time_of_min_inoffensive_distance_s);
  json["min_hull_clearance_m"] = metric(result.min_hull_clearance_m);
  json["plans"] = result.plans;
  json["plans_found"] = result.plans_found;
  json["plans_not_found"] = result.plans_not_found;
  json["plan_reasons"] = result.plan_reasons;
  json["rungs"] = Json::object();
  for (const auto& [rung, seconds] : result.rung_s) {
    json["rungs"][rung] = metric(seconds);
  }
  json["side_flips"] = result.side_flips;
  json["heading_travel_deg"] = metric(result.heading_travel_deg);
  json["plan_time_us"] = percentile_json(result.plan_time_us);
  json["ping_to_command_us"] = percentile_json(result.ping_to_command_us);
  json["overruns"] = result.overruns;
  json["stale_events"] = result.stale_events;
  json["notices"] = Json::array();
  for (const Notice& notice : result.notices) {
    json["notices"].push_back({{"t_s", number(notice.t_s, kPlanDecimals)}, {"text", notice.text}});
  }
  json["guard_trips"] = Json::array();
  for (const GuardTrip& trip : result.guard_trips) {
    json["guard_trips"].push_back({{"t_s", number(trip.t_s, kPlanDecimals)},
                                   {"reason", trip.reason},
                                   {"distance_m", number(trip.distance_m, kPlanDecimals)},
                                   {"speed_m_s", number(trip.speed_m_s, kPlanDecimals)}});
  }
  json["real_time_factor"] = metric(result.real_time_factor);
  json["recording_hash"] = result.recording_hash ? Json(*result.recording_hash) : Json(nullptr);
  json["origin_deg"] =
      result.origin_deg ? point(*result.origin_deg, kDegreeDecimals) : Json(nullptr);
  json["version"] = result.version;
  json["counted_from"] = to_string(result.counted_from);
  if (result.cross_track) {
    json["cross_track"] = {{"rms_m", metric(result.cross_track->rms_m)},
                           {"worst_m", metric(result.cross_track->worst_m)},
                           {"settled_rms_m", metric(result.cross_track->settled_rms_m)},
                           {"settled_worst_m", metric(result.cross_track->settled_worst_m)}};
  }
  if (result.outcome == "fault") {
    json["fault"] = result.fault;
  }
  return dumped(json, 2);
}

RunFiles::RunFiles(const std::filesystem::path& directory)
    : trajectory_{directory / "trajectory.csv"},
      plans_{directory / "plans.jsonl"},
      result_{directory / "result.json", kResultRoom_bytes} {
  trajectory_.add(
      "t_s,x_m,y_m,heading_deg,estimate_x_m,estimate_y_m,surge_m_s,surge_ref,head_ref,"
      "thrust_left,thrust_right,id_m,plan_id,path_found,waypoint_x_m,waypoint_y_m\n");
}

void RunFiles::add(const TrajectoryRow& row) { trajectory_.add(csv_line(row)); }

void RunFiles::add(const PlanRecord& plan) { plans_.add(dumped(plan_json(plan), -1)); }

void RunFiles::finish(const RunResult& result) {
  try {
    result_.write(result_json(result));
  } catch (const StartupError& error) {
    result_fault_ = error.what();
  }
  trajectory_.flush();
  plans_.flush();
}

const std::string& RunFiles::fault() const noexcept {
  return !result_fault_.empty()         ? result_fault_
         : !trajectory_.fault().empty() ? trajectory_.fault()
                                        : plans_.fault();
}

}  // namespace lodesman::cli
