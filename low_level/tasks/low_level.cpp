// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/low_level.h"

#include <utility>

#include "mid_level/runtime/task_table.h"

namespace lodesman {

LowLevel::LowLevel(Blackboard& board, Role role, LowLevelDevices devices, LowLevelOptions options)
    : devices_{std::move(devices)},
      ahrs_{board, role, *devices_.heading, options.heading_turn_rad},
      position_{board, role, devices_.position.get(), options.position},
      delta_t_{board, role, *devices_.sonar, std::move(options.delta_t)},
      path_finder_{board, role},
      thruster_{board, role, devices_.thrusters.get(), options.thruster} {}

std::vector<TaskEntry> LowLevel::tasks() {
  return {scheduled(TaskId::kAhrs, ahrs_), scheduled(TaskId::kPosition, position_),
          scheduled(TaskId::kDeltaT, delta_t_), scheduled(TaskId::kPathFinder, path_finder_),
          scheduled(TaskId::kThruster, thruster_)};
}

}  // namespace lodesman
