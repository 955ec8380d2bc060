// SPDX-License-Identifier: Apache-2.0
// Looks on at a run over the blackboard and keeps its record: the same for two processes in real
// time and for lock-step, in memory that a long run does not fill. One thread; it writes nothing
// that the boat reads.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "deploy/operator/report/kept_run.h"
#include "deploy/operator/report/percentiles.h"
#include "deploy/operator/report/run_record.h"
#include "deploy/operator/report/side_flips.h"
#include "hal_sim/scenario/scenario.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman::cli {

// What a display wants to know now.
struct RunProgress {
  MissionState state = MissionState::kIdle;
  double scenario_time_s = 0.0;
  double to_go_m = 0.0;  // along the waypoints that are left, to the goal
  WorldTruth truth;
  std::optional<PlanRecord> last_plan;  // without its path
  std::optional<Notice> notice;         // the last one
};

// What is known of a run before anything has happened.
[[nodiscard]] RunRecord blank_record(const Scenario& scenario, double waypoint_radius_m);

class RunWatcher {
 public:
  RunWatcher(const Blackboard& board, const Scenario& scenario, double waypoint_radius_m)
      : RunWatcher{board, board, scenario, waypoint_radius_m} {}
  // `truth`: the blackboard on which the world tells it, where that is not the boat's.
  RunWatcher(const Blackboard& board, const Blackboard& truth, const Scenario& scenario,
             double waypoint_radius_m);

  // Takes in everything published since the last call; to be called at least once a second. A call
  // that comes later costs samples, which are counted, but never the nearest distance.
  void poll();

  // Of the truth that it was given; by the estimate nothing counts as a collision.
  void count_from(CountedFrom source) noexcept { record_.result.counted_from = source; }

  // Times count from then, instead of from the boat's first start.
  void count_times_from(Time begins) noexcept { begins_ = begins; }

  [[nodiscard]] bool mission_ended() const noexcept { return ended_; }  // reached or aborted
  [[nodiscard]] Time mission_started() const noexcept { return status_.first_started; }  // 0 before
  [[nodiscard]] RunProgress progress() const;
  // Called for each plan, with the answer of PathFinder that it was made from (or nullptr).
  std::function<void(const Plan&, const SonarPath*, const PlanRecord&)> on_plan;
  // Called for each row of the trajectory, ten a second.
  std::function<void(const TrajectoryRow&)> on_row;

  // The record as it stands. Names, mode, hash and factor are the caller's to fill in.
  [[nodiscard]] RunRecord finish();

 private:
  void take_mission();
  void note_progress(const Stamped<MissionStatus>& mission);
  void note(Time stamp, const std::string& text);
  void take_truth();
  void take_commands();
  void take_plans();
  void take_rung(const PlanRecord& plan, Time stamp);
  void count_rung_until(double time_s);
  void take_guard();
  void take_health();
  void add_truth(const Stamped<WorldTruth>& truth);
  void take_the_least(const WorldTruth& truth);
  void add_row(const WorldTruth& truth);
  [[nodiscard]] const SonarPath* answer_to(const Plan& plan);
  [[nodiscard]] PlanRecord describe(const Stamped<Plan>& plan, const SonarPath* path) const;
  [[nodiscard]] double scenario_time_of(Time stamp) const noexcept {
    return status_.first_started == Time{} ? 0.0 : to_seconds(stamp - status_.first_started);
  }
  void end_at_truth() noexcept;
  [[nodiscard]] bool is_holding() const;

  const Scenario scenario_;
  RunRecord record_;

  Reader<MissionStatus> mission_;
  Reader<WorldTruth> truth_;
  Reader<WorldOrigin> origin_;
  Reader<PositionFix> fix_;
  Reader<VehicleState> state_;
  Reader<HelmCommand> helm_;
  Reader<ThrustApplied> thrust_;
  Reader<GuardStatus> guard_;
  Reader<Plan> plan_;
  Reader<SonarPath> path_;
  std::vector<Reader<TaskHealth>> health_;

  std::optional<Time> begins_;
  MissionStatus status_;
  std::optional<Notice> notice_;
  NoWayCause told_cause_ = NoWayCause::kNone;
  VehicleState estimate_;
  HelmCommand command_;
  ThrustApplied applied_;
  std::optional<PlanRecord> last_plan_;
  std::optional<std::string> rung_;               // of the last plan before the mission's end
  double rung_counted_s_ = 0.0;                   // its time is counted up to here
  std::deque<Stamped<WorldTruth>> recent_truth_;  // the last second
  std::optional<WorldTruth> last_truth_;
  std::optional<double> heading_10hz_rad_;
  double next_row_s_ = 0.0;
  bool ended_ = false;
  std::uint64_t answered_plan_ = 0;  // newest plan whose first command was timed
  bool was_stale_ = false;
  std::uint64_t trips_ = 0;  // of the guard, as far as they are noted
  KeptRows rows_;
  KeptPlans plans_;
  SideFlipCounter side_flips_;
  CrossTrackMeter cross_track_;
  PercentileSample plan_times_us_;
  PercentileSample ping_to_command_us_;
};

}  // namespace lodesman::cli
