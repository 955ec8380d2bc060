// SPDX-License-Identifier: Apache-2.0
// The high level put together: its tasks on a blackboard. Made before any task runs, by the main
// file of the process or by the lock-step simulation.
#pragma once

#include <vector>

#include "high_level/tasks/controller.h"
#include "high_level/tasks/estimator.h"
#include "high_level/tasks/planner.h"

namespace lodesman {

struct HighLevelOptions {
  EstimatorOptions estimator;
  PlannerOptions planner;
  ControllerOptions controller;
};

class HighLevel {
 public:
  HighLevel(Blackboard& board, Role role, const HighLevelOptions& options);
  [[nodiscard]] std::vector<TaskEntry> tasks();

 private:
  EstimatorTask estimator_;
  PlannerTask planner_;
  ControllerTask controller_;
};

}  // namespace lodesman
