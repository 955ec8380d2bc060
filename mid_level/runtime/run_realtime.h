// SPDX-License-Identifier: Apache-2.0
// Runs tasks in real time: one thread a task, absolute deadlines, SCHED_FIFO and locked memory
// where the machine allows it. Made and stopped by a main file.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mid_level/runtime/task.h"

namespace lodesman {

// Locks this process's memory and finds out whether SCHED_FIFO is allowed. Empty when all is as it
// should be; otherwise one line that says what is missing. To be called once, before the runner.
[[nodiscard]] std::string set_up_realtime();

class RealtimeRunner {
 public:
  // Starts the threads; the first deadlines are phase after now. A task that overruns skips the
  // periods it missed, keeps its phase, and has them counted in its health.
  RealtimeRunner(std::span<const TaskEntry> entries, Blackboard& board, Role role);
  RealtimeRunner(const RealtimeRunner&) = delete;
  RealtimeRunner& operator=(const RealtimeRunner&) = delete;
  // Stops the threads, then lets every task leave its device safe, in the order given.
  ~RealtimeRunner();

 private:
  struct Worker;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace lodesman
