// SPDX-License-Identifier: Apache-2.0
// Runs the same tasks in one thread on a simulated clock: the next due task, by due time and then
// by task, as fast as the machine allows and always in the same order. A task that is rung for is
// due a nominal time after the publication, and not within its least gap. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mid_level/base/clock.h"
#include "mid_level/runtime/health.h"
#include "mid_level/runtime/step_witness.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

struct LockstepOptions {
  // Each due time and each wake is late by a random share of this, so that the interleavings of
  // threads can be explored, and replayed by their seed. How late one is follows from the seed, its
  // task and its number, whatever else happens in between.
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
    HealthKeeper health;
    StepWitness witness;
    Bell<>* bell;
    std::uint32_t seen;           // of the bell
    Time nominal{};               // on the grid, without jitter
    Time due{};                   // on the grid
    std::optional<Time> woken{};  // when it is due because it was rung for
    std::optional<Time> began{};  // its last step
    std::uint64_t periods = 0;    // how many times it was due
    std::uint64_t wakes = 0;      // how often it was rung for

    [[nodiscard]] Time next() const noexcept { return woken ? std::min(*woken, due) : due; }
  };
  [[nodiscard]] Entry& next() noexcept;
  void put_on_grid(Entry& entry) noexcept;
  // What was published at `now` by the task with that row wakes whoever it rang for.
  void answer_rings(const TaskSpec& publisher, Time now) noexcept;
  [[nodiscard]] Duration jitter(const Entry& entry, std::uint64_t stream,
                                std::uint64_t count) const noexcept;

  std::vector<Entry> entries_;  // by TaskId
  SimClock& clock_;
  LockstepOptions options_;
};

}  // namespace lodesman
