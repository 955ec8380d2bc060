// SPDX-License-Identifier: Apache-2.0
// When every task of both processes runs: one table. Real-time priorities rise with what a late
// step would cost; the planner's own period is a setting, this is how often it looks. Who is woken
// by what stands in mid_level/blackboard/wake_edges.h.
#pragma once

#include <array>
#include <chrono>

#include "mid_level/runtime/task.h"

namespace lodesman {

// In the order of TaskId, which is also the order of tasks that are due together in lock-step.
inline constexpr std::array<TaskSpec, kTaskCount> kTaskTable = [] {
  using ms = std::chrono::milliseconds;
  using us = std::chrono::microseconds;
  return std::array<TaskSpec, kTaskCount>{{
      // task, period, phase, SCHED_FIFO priority, budget, deadline, least gap, nominal time.
      // DeltaT and the planner are rung for twice a ping, for its estimate and for its path, and a
      // simulated AHRS just after it began by its period: a longer gap would be waited for each
      // time. Nominal: what lay between two begins on an idle machine.
      {TaskId::kWorld, ms{20}, ms{0}, 40, ms{2}, ms{10}, ms{1}, us{80}},
      {TaskId::kAhrs, ms{20}, ms{0}, 60, ms{1}, ms{5}, us{200}, us{60}},
      {TaskId::kPosition, ms{100}, ms{0}, 30, ms{1}, ms{20}, ms{1}, us{60}},
      {TaskId::kEstimator, ms{50}, ms{2}, 50, ms{1}, ms{5}, ms{1}, us{60}},
      {TaskId::kDeltaT, ms{20}, ms{4}, 30, ms{10}, ms{20}, us{200}, us{100}},
      {TaskId::kPathFinder, ms{20}, ms{6}, 20, ms{10}, ms{20}, ms{1}, us{150}},
      {TaskId::kPlanner, ms{50}, ms{8}, 20, ms{10}, ms{20}, us{200}, us{100}},
      {TaskId::kController, ms{50}, ms{10}, 50, ms{1}, ms{5}, ms{1}, us{60}},
      {TaskId::kThruster, ms{50}, ms{12}, 70, ms{2}, ms{5}, ms{1}, us{60}},
  }};
}();

// Whoever publishes and whoever is woken takes time: nothing happens twice at one instant.
static_assert([] {
  for (const TaskSpec& spec : kTaskTable) {
    if (spec.nominal <= Duration::zero() || spec.least_gap < spec.nominal ||
        spec.budget > spec.deadline || spec.deadline > spec.period) {
      return false;
    }
  }
  return true;
}());

[[nodiscard]] constexpr TaskEntry scheduled(TaskId id, Task& task) noexcept {
  return {kTaskTable[static_cast<std::size_t>(id)], &task};
}

}  // namespace lodesman
