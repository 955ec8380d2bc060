// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/watcher.h"

#include <algorithm>
#include <cmath>

#include "deploy/operator/report/numbers.h"
#include "deploy/operator/report/plan_story.h"
#include "deploy/operator/run/way_left.h"
#include "mid_level/base/frames.h"
#include "mid_level/geometry/sonar_view.h"

namespace lodesman::cli {
namespace {

constexpr double kRowPeriod_s = 0.1;
constexpr std::size_t kMaxNotices = 1000;

[[nodiscard]] bool is_stale(HelmReason reason) noexcept {
  return reason == HelmReason::kStaleState || reason == HelmReason::kStaleAttitude ||
         reason == HelmReason::kStaleMission;
}

[[nodiscard]] std::array<double, 2> metres(const WorldPoint& p) noexcept {
  return {p.xy_m.x(), p.xy_m.y()};
}

}  // namespace

RunRecord blank_record(const Scenario& scenario, double waypoint_radius_m) {
  RunRecord record;
  record.start_m = metres(scenario.mission.start.p_WV);
  record.goal_m = metres(scenario.mission.goal());
  record.goal_radius_m = scenario.mission.definition.goal_radius_m;
  record.vehicle_radius_m = scenario.vehicle_radius_m;
  record.waypoint_radius_m = waypoint_radius_m;
  record.obstacles = scenario.obstacles;
  record.result.final_m = record.start_m;
  record.result.goal_error_m =
      (scenario.mission.goal().xy_m - scenario.mission.start.p_WV.xy_m).norm();
  return record;
}

RunWatcher::RunWatcher(const Blackboard& board, const Blackboard& truth, const Scenario& scenario,
                       double waypoint_radius_m)
    : scenario_{scenario},
      record_{blank_record(scenario, waypoint_radius_m)},
      mission_{board.mission_status},
      truth_{truth.world_truth},
      origin_{board.world_origin},
      fix_{board.position_fix},
      state_{board.vehicle_state},
      helm_{board.helm_command},
      thrust_{board.thrust_applied},
      guard_{board.guard_status},
      plan_{board.plan},
      path_{board.sonar_path},
      side_flips_{scenario.obstacles} {
  for (const auto& channel : board.task_health) {
    health_.emplace_back(channel);
  }
}

void RunWatcher::poll() {
  take_mission();
  take_commands();
  take_guard();
  take_plans();
  take_truth();
  take_health();
}

void RunWatcher::take_mission() {
  while (const auto* mission = mission_.next()) {
    note_progress(*mission);
    if (const std::string news = mission_news(status_, mission->value); !news.empty()) {
      note(mission->stamp, news);
    }
    status_ = mission->value;
    status_.first_started = begins_.value_or(status_.first_started);
  }
}

// Said once when it begins, again when more is known of the cause, and when it is over.
void RunWatcher::note_progress(const Stamped<MissionStatus>& mission) {
  const NoWayCause cause = mission.value.no_way;
  const bool over = cause == NoWayCause::kNone;
  const double for_s = to_seconds(mission.stamp - mission.value.no_way_since);
  const bool known_better = cause == NoWayCause::kUnknown && told_cause_ != NoWayCause::kNone;
  if (cause == told_cause_ || known_better || ended_) {
    return;
  }
  told_cause_ = cause;
  if (!over || mission.value.state == MissionState::kUnderWay) {
    note(mission.stamp, over ? "makes way again" : cli::describe(cause, for_s));
  }
}

void RunWatcher::note(Time stamp, const std::string& text) {
  notice_ = Notice{scenario_time_of(stamp), text};
  if (record_.result.notices.size() < kMaxNotices) {
    record_.result.notices.push_back(*notice_);
  }
}

void RunWatcher::take_commands() {
  while (const auto* state = state_.next()) {
    if (!ended_ && (status_.ended == Time{} || state->stamp <= status_.ended)) {
      estimate_ = state->value;
    }
  }
  while (const auto* helm = helm_.next()) {
    command_ = helm->value;
    const bool stale = status_.state == MissionState::kUnderWay && is_stale(command_.reason);
    record_.result.stale_events += stale && !was_stale_ ? 1 : 0;
    was_stale_ = stale;
  }
  while (const auto* thrust = thrust_.next()) {
    const bool newly_stale = thrust->value.reason == ThrustReason::kStaleCommand &&
                             applied_.reason != ThrustReason::kStaleCommand &&
                             applied_.reason != ThrustReason::kGuarded;
    record_.result.stale_events += newly_stale ? 1 : 0;
    applied_ = thrust->value;
    if (applied_.reason == ThrustReason::kCommanded && applied_.plan_id > answered_plan_) {
      answered_plan_ = applied_.plan_id;
      // What was seen before the start has waited for it.
      if (applied_.plan_captured >= status_.first_started && status_.first_started != Time{}) {
        ping_to_command_us_.add(to_seconds(thrust->stamp - applied_.plan_captured) * 1e6);
      }
    }
  }
}

void RunWatcher::take_plans() {
  while (const auto* plan = plan_.next()) {
    const SonarPath* path = answer_to(plan->value);
    PlanRecord record = describe(*plan, path);
    if (on_plan) {
      on_plan(plan->value, path, record);
    }
    ++record_.result.plans;
    ++(record.reason == PathReason::kFound ? record_.result.plans_found
                                           : record_.result.plans_not_found);
    ++record_.result.plan_reasons[to_string(record.reason)];
    take_rung(record, plan->stamp);
    plan_times_us_.add(record.plan_time_us);
    const bool never_flipped = !side_flips_.flips().first_s;
    side_flips_.add(record);
    last_plan_ = record;
    last_plan_->path_m.clear();
    plans_.add(std::move(record), never_flipped && side_flips_.flips().first_s);
  }
  record_.result.plans_missed = plan_.missed();
}

// A rung lasts until the next plan, or until the mission ends.
void RunWatcher::take_rung(const PlanRecord& plan, Time stamp) {
  if (status_.ended == Time{} || stamp <= status_.ended) {
    count_rung_until(plan.t_s);
    rung_ = plan.rung;
  }
}

void RunWatcher::count_rung_until(double time_s) {
  if (rung_ && time_s > rung_counted_s_) {
    record_.result.rung_s[*rung_] += time_s - rung_counted_s_;
  }
  rung_counted_s_ = time_s;
}

void RunWatcher::take_truth() {
  while (const auto* truth = truth_.next()) {
    add_truth(*truth);
  }
  record_.result.truths_missed = truth_.missed();
  if (status_.ended != Time{} && !ended_ && status_.first_started != Time{}) {
    end_at_truth();
  }
}

void RunWatcher::add_truth(const Stamped<WorldTruth>& truth) {
  const WorldTruth& now = truth.value;
  recent_truth_.push_back(truth);
  if (recent_truth_.size() > 50) {
    recent_truth_.pop_front();
  }
  if (status_.first_started == Time{} || truth.stamp < status_.first_started || ended_) {
    return;
  }
  RunResult& result = record_.result;
  if (last_truth_) {
    result.path_length_m += std::hypot(now.x_m - last_truth_->x_m, now.y_m - last_truth_->y_m);
  }
  last_truth_ = now;
  result.time_s = now.scenario_time_s;
  take_the_least(now);
  if (now.scenario_time_s >= next_row_s_ - 1e-6) {
    add_row(now);
    next_row_s_ += kRowPeriod_s;
  }
}

// The world has kept it, so it is right whatever was overwritten before it was read.
void RunWatcher::take_the_least(const WorldTruth& truth) {
  RunResult& result = record_.result;
  const auto nearest_at_s = result.time_of_min_inoffensive_distance_s;
  result.min_hull_clearance_m = if_finite(truth.least_hull_clearance_m);
  result.min_inoffensive_distance_m = if_finite(truth.least_inoffensive_distance_m);
  result.time_of_min_inoffensive_distance_s = std::nullopt;
  if (result.min_inoffensive_distance_m) {
    result.time_of_min_inoffensive_distance_s = truth.least_inoffensive_distance_at_s;
  }
  if (result.time_of_min_inoffensive_distance_s != nearest_at_s) {
    plans_.mark_closest();
  }
}

void RunWatcher::add_row(const WorldTruth& truth) {
  if (heading_10hz_rad_) {
    record_.result.heading_travel_deg +=
        to_deg(std::abs(wrap_to_pi(truth.heading_rad - *heading_10hz_rad_)));
  }
  heading_10hz_rad_ = truth.heading_rad;
  cross_track_.add(status_, truth);
  TrajectoryRow row;
  row.t_s = truth.scenario_time_s;
  row.x_m = truth.x_m;
  row.y_m = truth.y_m;
  row.heading_deg = compass_deg(truth.heading_rad);
  row.estimate_x_m = estimate_.x_m;
  row.estimate_y_m = estimate_.y_m;
  row.surge_m_s = truth.surge_m_s;
  row.surge_ref = command_.surge_ref;
  row.head_ref = command_.head_ref;
  row.thrust_left = applied_.left;
  row.thrust_right = applied_.right;
  row.id_m = truth.inoffensive_distance_m;
  row.plan_id = command_.plan_id;
  row.path_found = last_plan_ && last_plan_->reason == PathReason::kFound;
  row.waypoint_x_m = command_.waypoint_x_m;
  row.waypoint_y_m = command_.waypoint_y_m;
  rows_.add(row);
  if (on_row) {
    on_row(row);
  }
}

// The truth at the instant that the mission ended, which was published a little earlier.
void RunWatcher::end_at_truth() noexcept {
  ended_ = true;
  for (const auto& truth : recent_truth_) {
    if (truth.stamp <= status_.ended) {
      last_truth_ = truth.value;
    }
  }
  record_.result.time_s = to_seconds(status_.ended - status_.first_started);
}

// Trips of a low level that was started anew count from 1 again.
void RunWatcher::take_guard() {
  while (const auto* guard = guard_.next()) {
    const GuardStatus& now = guard->value;
    const bool is_new = now.trips != trips_ && now.trips > 0;
    trips_ = now.trips;
    if (is_new && record_.result.guard_trips.size() < kMaxNotices) {
      record_.result.guard_trips.push_back({scenario_time_of(now.tripped), to_string(now.reason),
                                            now.distance_m, now.trip_speed_m_s});
    }
  }
}

void RunWatcher::take_health() {
  std::uint64_t overruns = 0;
  for (auto& reader : health_) {
    const auto* health = reader.latest();
    overruns += health != nullptr ? health->value.overruns : 0;
  }
  record_.result.overruns = overruns;
}

const SonarPath* RunWatcher::answer_to(const Plan& plan) {
  const auto* newest = path_.latest();
  while (newest != nullptr && newest->value.request > plan.id) {
    newest = path_.at(newest->sequence - 1);
  }
  return newest != nullptr && newest->value.request == plan.id ? &newest->value : nullptr;
}

PlanRecord RunWatcher::describe(const Stamped<Plan>& published, const SonarPath* path) const {
  const Plan& plan = published.value;
  PlanRecord record;
  record.id = plan.id;
  record.t_s = scenario_time_of(published.stamp);
  record.captured_s = scenario_time_of(plan.captured);
  record.start_m = {plan.pose_x_m, plan.pose_y_m};
  record.start_heading_deg = compass_deg(plan.pose_heading_rad);
  record.goal_m = {plan.goal_x_m, plan.goal_y_m};
  record.reason = plan.reason;
  if (plan.lost_since != Time{}) {
    record.lost_for_s = to_seconds(published.stamp - plan.lost_since);
  }
  record.waypoint_source = to_string(plan.source);
  record.rung = to_string(plan.rung);
  record.speed_share = plan.speed_share;
  record.changed = plan.changed;
  record.cause = plan.cause;
  record.clearance_after_s = plan.clearance_after_s;
  record.seen_ahead_m = if_finite(plan.seen_ahead_m);
  if (plan.steer_by != SteerBy::kWaypoints) {
    record.clearance_m = if_finite(plan.clearance_m);
  }
  if (plan.steer_by == SteerBy::kCourse) {
    record.course_deg = compass_deg(plan.course_rad);
  }
  for (std::uint32_t i = 0; i < plan.waypoint_count; ++i) {
    record.waypoints_m.push_back({plan.waypoints[i].x_m, plan.waypoints[i].y_m});
  }
  if (path == nullptr) {
    return record;
  }
  record.expansions = path->expansions;
  record.plan_time_us = path->plan_time_ns / 1e3;
  if (plan.steer_by != SteerBy::kWaypoints) {
    record.path_m = record.waypoints_m;  // in the world the line itself is followed
    return record;
  }
  if (path->reason == PathReason::kFound) {
    record.cost_10_14 = path->cost_10_14;
  }
  const VehiclePose pose{{{plan.pose_x_m, plan.pose_y_m}},
                         Heading::clockwise_from_y_rad(plan.pose_heading_rad)};
  const SonarView view{scenario_.sonar.range_m};
  for (std::uint32_t i = 0; i < path->pixel_count; ++i) {
    const WorldPoint p = pose.to_world(view.to_vehicle(path->pixels[i]));
    record.path_m.push_back({p.xy_m.x(), p.xy_m.y()});
  }
  return record;
}

RunProgress RunWatcher::progress() const {
  RunProgress progress;
  progress.state = status_.state;
  if (last_truth_) {
    progress.truth = *last_truth_;
    progress.scenario_time_s = last_truth_->scenario_time_s;
    progress.to_go_m =
        way_left_m(scenario_.mission, status_.goal_index, {{last_truth_->x_m, last_truth_->y_m}});
  }
  progress.last_plan = last_plan_;
  progress.notice = notice_;
  return progress;
}

// By order, or because there is nothing better to do than to wait.
bool RunWatcher::is_holding() const {
  return status_.state == MissionState::kHolding ||
         (last_plan_ && (last_plan_->rung == to_string(PlanRung::kHold) ||
                         last_plan_->rung == to_string(PlanRung::kStop)));
}

RunRecord RunWatcher::finish() {
  RunResult& result = record_.result;
  result.reached = status_.state == MissionState::kReached;
  result.collided = result.counted_from == CountedFrom::kTruth &&
                    (result.min_inoffensive_distance_m.value_or(1.0) < 0.0 ||
                     result.min_hull_clearance_m.value_or(1.0) < 0.0);
  result.outcome = result.collided                           ? "collision"
                   : result.reached                          ? "goal"
                   : status_.state == MissionState::kAborted ? "aborted"
                   : is_holding()                            ? "held"
                                                             : "time_limit";
  if (last_truth_) {
    const WorldTruth& truth = *last_truth_;
    result.final_m = {truth.x_m, truth.y_m};
    result.goal_error_m = std::hypot(truth.x_m - record_.goal_m[0], truth.y_m - record_.goal_m[1]);
    result.estimate_error_m = std::hypot(truth.x_m - estimate_.x_m, truth.y_m - estimate_.y_m);
  }
  if (const auto* fix = fix_.latest();
      fix != nullptr && fix->value.utc_ns != 0 && status_.first_started != Time{}) {
    record_.started_utc_ns =
        fix->value.utc_ns - (fix->value.measured - status_.first_started).count();
  }
  if (const auto* origin = origin_.latest(); origin != nullptr) {
    result.origin_deg = {origin->value.latitude_deg, origin->value.longitude_deg};
  }
  result.mean_speed_m_s = result.time_s > 0.0 ? result.path_length_m / result.time_s : 0.0;
  result.side_flips = side_flips_.flips().count;
  result.first_side_flip_s = side_flips_.flips().first_s;
  result.cross_track = cross_track_.seen();
  result.plan_time_us = plan_times_us_.percentiles();
  result.ping_to_command_us = ping_to_command_us_.percentiles();
  count_rung_until(result.time_s);
  record_.trajectory = rows_.rows();
  record_.plans = plans_.plans();
  return record_;
}

}  // namespace lodesman::cli
