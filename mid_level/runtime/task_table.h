// SPDX-License-Identifier: Apache-2.0
// When every task of both processes runs: one table. Real-time priorities rise with what a late
// step would cost; the planner's own period is a setting, this is how often it looks.
#pragma once

#include <array>
#include <chrono>

#include "mid_level/runtime/task.h"

namespace lodesman {

// In the order of TaskId, which is also the order of tasks that are due together in lock-step.
inline constexpr std::array<TaskSpec, kTaskCount> kTaskTable = [] {
  using std::chrono::milliseconds;
  return std::array<TaskSpec, kTaskCount>{{
      // task, period, phase, SCHED_FIFO priority
      {TaskId::kWorld, milliseconds{20}, milliseconds{0}, 40},
      {TaskId::kAhrs, milliseconds{20}, milliseconds{0}, 60},
      {TaskId::kPosition, milliseconds{100}, milliseconds{0}, 30},
      {TaskId::kEstimator, milliseconds{50}, milliseconds{2}, 50},
      {TaskId::kDeltaT, milliseconds{20}, milliseconds{4}, 30},
      {TaskId::kPathFinder, milliseconds{20}, milliseconds{6}, 20},
      {TaskId::kPlanner, milliseconds{50}, milliseconds{8}, 20},
      {TaskId::kController, milliseconds{50}, milliseconds{10}, 50},
      {TaskId::kThruster, milliseconds{50}, milliseconds{12}, 70},
  }};
}();

[[nodiscard]] constexpr TaskEntry scheduled(TaskId id, Task& task) noexcept {
  return {kTaskTable[static_cast<std::size_t>(id)], &task};
}

}  // namespace lodesman
