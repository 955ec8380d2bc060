// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/high_level.h"

#include "mid_level/runtime/task_table.h"

namespace lodesman {

HighLevel::HighLevel(Blackboard& board, Role role, const HighLevelOptions& options)
    : estimator_{board, role, options.estimator},
      planner_{board, role, options.planner},
      controller_{board, role, options.controller} {}

std::vector<TaskEntry> HighLevel::tasks() {
  return {scheduled(TaskId::kEstimator, estimator_), scheduled(TaskId::kPlanner, planner_),
          scheduled(TaskId::kController, controller_)};
}

}  // namespace lodesman
