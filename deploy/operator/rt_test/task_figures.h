// SPDX-License-Identifier: Apache-2.0
// What the tasks did between two looks at a running boat: their health, their threads and what was
// published, and the analysis that follows from these. Pure but for look_at_boat(); one thread.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/rt_test/allocation_counter.h"
#include "deploy/operator/rt_test/response_times.h"
#include "deploy/operator/rt_test/thread_facts.h"
#include "mid_level/runtime/health.h"
#include "mid_level/runtime/task_table.h"

namespace lodesman::cli {

// One look.
struct BoatLook {
  Time at{};
  std::array<std::optional<TaskHealth>, kTaskCount> health{};
  std::map<std::string, ThreadFacts> threads;         // of both programs, by task
  std::map<std::string, std::uint64_t> publications;  // by channel, since the segment was made
  std::map<pid_t, std::uint64_t> allocations;         // by thread; see AllocationCounter::counts()
  bool counts_allocations = false;                    // of both programs
};
[[nodiscard]] BoatLook look_at_boat(const Blackboard& board, pid_t low, pid_t high,
                                    const AllocationCounter& allocations, Time now);

// Of one task, between two looks. What was worst is exact where it was worse than all before the
// first look, else no more than the bucket it was counted in.
struct TaskFigures {
  TaskId task = TaskId::kWorld;
  std::uint64_t fifo_priority = 0;
  std::uint64_t steps = 0;
  std::uint64_t wakes = 0;
  std::uint64_t overruns = 0;
  std::uint64_t over_budget = 0;
  std::uint64_t past_deadline = 0;
  LateCounts late{};       // steps of the period
  LateCounts wake_late{};  // steps that were rung for
  LateCounts took{};       // all steps
  Duration worst_late{};
  Duration worst_wake_late{};
  Duration worst_took{};
  std::optional<ThreadFacts> thread{};         // nothing where its thread was not found twice
  std::optional<std::uint64_t> allocations{};  // nothing where they were not counted
};

// Empty where the task did not step at both looks, or was begun anew between them.
[[nodiscard]] std::optional<TaskFigures> figures_between(const BoatLook& first,
                                                         const BoatLook& last, TaskId task);

// The tasks of the figures as response_times.h takes them: each as long as its longest step,
// released by its period and by what wakes it, as often as that was published between the two
// looks, up to the writer's deadline late. Where a simulated device rings, as often as the world
// steps. A changed state of the mission, and orders, which come a few times an hour, are left out.
[[nodiscard]] std::vector<AnalysedTask> as_analysed(std::span<const TaskFigures> figures,
                                                    const BoatLook& first, const BoatLook& last);

}  // namespace lodesman::cli
