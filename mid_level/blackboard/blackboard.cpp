// SPDX-License-Identifier: Apache-2.0
#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

const char* to_string(TaskId task) noexcept {
  switch (task) {
    case TaskId::kWorld: return "world";
    case TaskId::kAhrs: return "ahrs";
    case TaskId::kPosition: return "position";
    case TaskId::kEstimator: return "estimator";
    case TaskId::kDeltaT: return "delta_t";
    case TaskId::kPathFinder: return "path_finder";
    case TaskId::kPlanner: return "planner";
    case TaskId::kController: return "controller";
    case TaskId::kThruster: return "thruster";
  }
  return "unknown";
}

}  // namespace lodesman
