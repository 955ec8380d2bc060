// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/low_level.h"

#include <utility>

#include "mid_level/runtime/task_table.h"

namespace lodesman {

LowLevel::LowLevel(Blackboard& board, Role role, LowLevelDevices devices, LowLevelOptions options)
    : devices_{std::move(devices)},
      ahrs_{board, role, *devices_.heading},
      position_{devices_.position != nullptr
                    ? std::make_unique<PositionTask>(board, role, *devices_.position)
                    : nullptr},
      delta_t_{board, role, *devices_.sonar, std::move(options.delta_t)},
      path_finder_{board, role, options.sonar_range_m},
      thruster_{board, role, *devices_.thrusters} {}

std::vector<TaskEntry> LowLevel::tasks() {
  std::vector<TaskEntry> entries{
      scheduled(TaskId::kAhrs, ahrs_), scheduled(TaskId::kDeltaT, delta_t_),
      scheduled(TaskId::kPathFinder, path_finder_), scheduled(TaskId::kThruster, thruster_)};
  if (position_ != nullptr) {
    entries.push_back(scheduled(TaskId::kPosition, *position_));
  }
  return entries;
}

}  // namespace lodesman
