// SPDX-License-Identifier: Apache-2.0
// Counts a task's steps and missed periods, and publishes them once a second. One thread.
#pragma once

#include <algorithm>

#include "mid_level/runtime/task.h"

namespace lodesman {

class HealthKeeper {
 public:
  HealthKeeper(Blackboard& board, TaskId task, Role role)
      : writer_{board.task_health[static_cast<std::size_t>(task)], role, to_string(task)} {}

  void stepped(Time now, Duration took, std::uint64_t missed_periods) noexcept {
    const auto took_ns = static_cast<std::uint64_t>(std::max<std::int64_t>(took.count(), 0));
    ++health_.steps;
    health_.overruns += missed_periods;
    health_.last_step_ns = took_ns;
    health_.worst_step_ns = std::max(health_.worst_step_ns, took_ns);
    if (now >= due_) {
      writer_.publish(health_, now);
      due_ = now + std::chrono::seconds{1};
    }
  }

 private:
  Writer<TaskHealth> writer_;
  TaskHealth health_;
  Time due_{};
};

}  // namespace lodesman
