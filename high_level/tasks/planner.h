// SPDX-License-Identifier: Apache-2.0
// The planner task: the mission and the paper's Fig. 1, step by step, and a watch over progress.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "high_level/guidance/replanner.h"
#include "high_level/mission/mission.h"
#include "high_level/mission/progress_watch.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

struct PlannerOptions {
  ReplannerOptions replanner;
  MissionOptions mission;
  ProgressWatchOptions progress;
};

class PlannerTask final : public Task {
 public:
  // Not stepped for longer than kLongestAbsence, because its process was frozen, it does not sail
  // on: it holds until it is told to resume (ADR 0017). On a blackboard that an earlier program
  // left, it goes on with the mission as that says (ADR 0033).
  PlannerTask(Blackboard& board, Role role, PlannerOptions options);
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override {
    return refused_by(definitions_, orders_, link_, tunables_, vehicle_state_, obstacles_, tracks_,
                      coverage_, sonar_path_, attitude_, position_fix_, plan_, helm_,
                      thrust_applied_, thrust_status_);
  }
  [[nodiscard]] std::span<ChannelLook<>* const> inputs() noexcept override { return inputs_; }

 private:
  // What is found of the program that was here before: looked at when made, taken up with the
  // first step.
  void look_for_legacy(Blackboard& board);
  void take_up(Time now) noexcept;
  void hold_after_absence(Time now, bool estimate_is_fresh) noexcept;
  void take_orders(Time now) noexcept;
  void take_tunables() noexcept;
  void watch_link(Time now) noexcept;
  void watch_thrusters(Time now) noexcept;
  [[nodiscard]] GoalOutlook goal_outlook() noexcept;
  void sail_as_the_mission_says(Time now) noexcept;
  // Whose line is kept to.
  [[nodiscard]] std::optional<Leg> leg() const noexcept;
  // What is known of the water: the tracks, and the mission's areas as walls.
  [[nodiscard]] const Tracks& with_areas(const Tracks& tracks, const VehicleState& own,
                                         Time now) noexcept;
  // What was seen of it; null: all of it is known.
  [[nodiscard]] const Coverage* seen_water() noexcept {
    const auto* newest = coverage_.latest();
    return newest != nullptr ? &newest->value : nullptr;
  }
  void replan(Time now) noexcept;
  void replan_in_view(Time now) noexcept;
  void replan_in_world(Time now) noexcept;
  void publish(const Plan* plan, Time now) noexcept;
  void tell(const MissionStatus& status, Time now) noexcept;
  [[nodiscard]] Missing missing(Time now) noexcept;
  void watch_progress(Time now) noexcept;
  [[nodiscard]] ProgressSample progress_sample(Time now) noexcept;
  [[nodiscard]] bool wants_way(const Plan& plan, const ProgressSample& sample,
                               double to_waypoint_m) const noexcept;

  PlannerOptions options_;
  Mission mission_;
  Replanner replanner_;
  PoseHistory poses_;
  ProgressWatch progress_;
  NoWayCause no_way_ = NoWayCause::kNone;
  WorldPoint position_;  // the last known
  Time stepped_{};
  std::uint64_t frame_sequence_ = 0;  // of the newest frame that there was at the last step
  bool frame_is_new_ = false;         // at this step
  Time started_{};                    // of the mission that the replanner was told of
  MissionState told_state_ = MissionState::kIdle;
  bool was_absent_ = false;  // under way, and its place is not known again yet
  MissionCause absent_by_ = MissionCause::kAbsence;
  Legacy legacy_;
  Time legacy_said_{};  // 0: there is none to take up
  std::unique_ptr<MissionDefinition> legacy_mission_;
  std::unique_ptr<PathRequest> legacy_request_;
  std::uint64_t tuned_ = 0;     // Tunables::version taken on
  std::int32_t surge_ref_ = 0;  // that the replanner was told of
  std::unique_ptr<Tracks> water_ = std::make_unique<Tracks>();
  Reader<MissionDefinition> definitions_;
  Reader<OperatorCommand> orders_;
  Reader<CommandLink> link_;
  Reader<Tunables> tunables_;
  Reader<VehicleState> vehicle_state_;
  Reader<SonarObstacles> obstacles_;
  Reader<Tracks> tracks_;
  Reader<Coverage> coverage_;
  Reader<SonarPath> sonar_path_;
  Reader<Attitude> attitude_;
  Reader<PositionFix> position_fix_;
  // What was made of plans, for the watch over progress.
  Reader<Plan> plan_;
  Reader<HelmCommand> helm_;
  Reader<ThrustApplied> thrust_applied_;
  Reader<ThrustStatus> thrust_status_;
  std::array<ChannelLook<>*, 14> inputs_{
      &definitions_,  &orders_,        &link_,           &tunables_,     &attitude_,
      &position_fix_, &vehicle_state_, &obstacles_,      &tracks_,       &coverage_,
      &sonar_path_,   &helm_,          &thrust_applied_, &thrust_status_};
  Writer<PathRequest> requests_;
  Writer<Plan> plans_;
  Writer<MissionStatus> statuses_;
};

}  // namespace lodesman
