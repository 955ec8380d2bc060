// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/high_level.h"

#include "mid_level/runtime/task_table.h"

namespace lodesman {

HighLevelOptions read_high_level_options(const TomlTable& configuration) {
  HighLevelOptions options;
  const TomlTable planner = configuration.table("planner");
  auto& replanner = options.planner.replanner;
  replanner.replan_period = planner.duration("replan_period_s", Range::between(0.0, 60.0));
  replanner.answer_patience = planner.duration("answer_patience_s", Range::between(0.1, 10.0));
  replanner.waypoint_interval_m = planner.number("waypoint_interval_m", Range::between(0.1, 50.0));
  replanner.previous_path_max_age =
      planner.duration("previous_path_max_age_s", Range::between(0.0, 1e6));
  const TomlTable guidance = configuration.table("guidance");
  options.controller.waypoint_radius_m =
      guidance.number("waypoint_radius_m", Range::between(0.05, 20.0));
  options.planner.mission.waypoint_radius_m = options.controller.waypoint_radius_m;
  const TomlTable control = configuration.table("control");
  options.controller.heading_gain_per_deg =
      control.number("heading_gain_per_deg", Range::above(0.0, 100.0));
  const TomlTable estimator = configuration.table("estimator");
  auto& reckoning = options.estimator.dead_reckoning;
  reckoning.step = estimator.duration("dead_reckoning_step_s", Range::between(0.01, 1.0));
  reckoning.speed_per_surge_ref_m_s =
      estimator.number("speed_per_surge_ref_m_s", Range::above(0.0, 1.0));
  options.estimator.gps_correction = estimator.number("gps_correction", Range::above(0.0, 1.0));
  return options;
}

HighLevel::HighLevel(Blackboard& board, Role role, const HighLevelOptions& options)
    : estimator_{board, role, options.estimator},
      planner_{board, role, options.planner},
      controller_{board, role, options.controller} {}

std::vector<TaskEntry> HighLevel::tasks() {
  return {scheduled(TaskId::kEstimator, estimator_), scheduled(TaskId::kPlanner, planner_),
          scheduled(TaskId::kController, controller_)};
}

}  // namespace lodesman
