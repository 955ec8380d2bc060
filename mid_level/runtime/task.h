// SPDX-License-Identifier: Apache-2.0
// A task: a piece of work done once a period, and as soon as something is published that it waits
// for. A step that finds nothing new changes nothing: a task may be woken for nothing. The runner
// owns time and threads; step() is called by one thread at a time and neither sleeps, blocks, asks
// for the time nor starts a thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

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
  // How many of its inputs were passed over so far because they were not sane: a device's samples
  // and what stood on the blackboard.
  [[nodiscard]] virtual std::uint64_t refused() const noexcept { return 0; }
  // All of its readers, but for those of its own channels, where a step can be made again from what
  // they saw (ADR 0038); else nothing. Always the same, in the same order: causes before effects,
  // for they are looked at from the last to the first, so that who sees one sees its cause.
  [[nodiscard]] virtual std::span<ChannelLook<>* const> inputs() noexcept { return {}; }

  // Whoever steps it counts.
  [[nodiscard]] std::uint64_t steps() const noexcept { return steps_; }
  void count_step() noexcept { ++steps_; }

 private:
  std::uint64_t steps_ = 0;
};

// When a task runs: one row of the project's task table.
struct TaskSpec {
  TaskId id = TaskId::kWorld;
  Duration period{};
  Duration phase{};       // offset of its first due time
  int fifo_priority = 0;  // SCHED_FIFO priority where allowed; 0: best effort
  // What is counted as too long: a step, and from when it was due or rung for to its end. Zero: no
  // limit.
  Duration budget{};
  Duration deadline{};
  // Woken, it begins at the earliest so long after its last beginning, so that rings without end
  // starve nobody. Above zero.
  Duration least_gap = std::chrono::milliseconds{1};
  // In lock-step, what it publishes wakes others so long after. A constant above zero, set once
  // from measurements (ADR 0010).
  Duration nominal = std::chrono::microseconds{50};
};

// What several readers passed over.
template <class... Readers>
[[nodiscard]] std::uint64_t refused_by(const Readers&... readers) noexcept {
  return (readers.refused() + ...);
}

struct TaskEntry {
  TaskSpec spec;
  Task* task = nullptr;
};

}  // namespace lodesman
