// SPDX-License-Identifier: Apache-2.0
// Runs the same tasks in one thread on a simulated clock: the next due task, by due time and then
// by task, as fast as the machine allows and always in the same order. One thread.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "mid_level/base/clock.h"
#include "mid_level/runtime/health.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

struct LockstepOptions {
  // Each due time is late by a random share of this, so that the interleavings of threads can be
  // explored, and replayed by their seed.
  Duration max_jitter{};
  std::uint64_t seed = 0;
};

class LockstepRunner {
 public:
  LockstepRunner(std::span<const TaskEntry> entries, SimClock& clock, Blackboard& board,
                 const LockstepOptions& options);

  // Moves the clock to when the next task is due, and runs it.
  void step() noexcept;

 private:
  struct Entry {
    TaskEntry task;
    Time nominal;  // without jitter
    Time due;
    HealthKeeper health;
  };
  [[nodiscard]] std::size_t next() const noexcept;  // index of the entry due next
  [[nodiscard]] Time with_jitter(Time nominal) noexcept;

  std::vector<Entry> entries_;  // by TaskId
  SimClock& clock_;
  Duration max_jitter_;
  std::mt19937_64 random_;
};

}  // namespace lodesman
