// SPDX-License-Identifier: Apache-2.0
// Runs tasks in real time: one thread a task, which waits for its bell or for its next time on the
// grid, whichever is first; absolute deadlines, SCHED_FIFO where it is granted.
// Made and stopped by a main file.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "mid_level/runtime/task.h"

namespace lodesman {

// The first time after `after` at which a task is due. The grid begins at the steady clock's own
// zero, so that phases hold between programs too, whenever each was started.
[[nodiscard]] constexpr Time next_due(const TaskSpec& spec, Time after) noexcept {
  const Duration since = after.time_since_epoch() - spec.phase;
  const auto periods = since < Duration::zero() ? 0 : since / spec.period + 1;
  return Time{spec.phase + periods * spec.period};
}

// How long a runner that is stopped waits for tasks to end their last step.
inline constexpr Duration kLastStepPatience = std::chrono::seconds{1};

// Called by the runner's destructor for the tasks that have not ended by then: those hang, all
// others are safe. It ends the process; should it return, the destructor waits without limit.
using OnHang = std::function<void(std::span<const TaskId>)>;

class RealtimeRunner {
 public:
  // Starts the threads. A task that overruns skips the periods it missed, keeps its phase, and has
  // them counted in its health. A ring moves no phase, and none comes to a step within the task's
  // least gap.
  RealtimeRunner(std::span<const TaskEntry> entries, Blackboard& board, Role role, OnHang on_hang);
  RealtimeRunner(const RealtimeRunner&) = delete;
  RealtimeRunner& operator=(const RealtimeRunner&) = delete;
  // Wakes the threads, that of the highest priority first; each ends its step, makes its own task
  // safe and ends. So no task waits for another one to become safe.
  ~RealtimeRunner();

 private:
  struct Worker;
  [[nodiscard]] std::vector<TaskId> wait_for_end() const;

  std::vector<std::unique_ptr<Worker>> workers_;  // of the highest priority first
  OnHang on_hang_;
};

}  // namespace lodesman
