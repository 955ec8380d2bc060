// SPDX-License-Identifier: Apache-2.0
// A task: a piece of work done once a period. The runner owns time and threads; step() is called
// by one thread at a time and neither sleeps, blocks, asks for the time nor starts a thread.
#pragma once

#include <cstddef>

#include "mid_level/base/time.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

class Task {
 public:
  Task() = default;
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;
  virtual ~Task() = default;

  virtual void step(Time now) noexcept = 0;
  // Called once when the task has been stepped for the last time, by the thread that stepped it, so
  // that it can leave its device safe.
  virtual void enter_safe_state(Time /*now*/) noexcept {}
};

// When a task runs: one row of the project's task table.
struct TaskSpec {
  TaskId id = TaskId::kWorld;
  Duration period{};
  Duration phase{};       // offset of its first due time
  int fifo_priority = 0;  // SCHED_FIFO priority where allowed; 0: best effort
};

struct TaskEntry {
  TaskSpec spec;
  Task* task = nullptr;
};

}  // namespace lodesman
