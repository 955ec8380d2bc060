// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/run_lockstep.h"

#include <algorithm>

#include "mid_level/base/check.h"
#include "mid_level/base/stopwatch.h"

namespace lodesman {

LockstepRunner::LockstepRunner(std::span<const TaskEntry> entries, SimClock& clock,
                               Blackboard& board, const LockstepOptions& options)
    : clock_{clock}, max_jitter_{options.max_jitter}, random_{options.seed} {
  LODESMAN_CHECK(!entries.empty());
  std::vector<TaskEntry> ordered{entries.begin(), entries.end()};
  std::sort(ordered.begin(), ordered.end(),
            [](const TaskEntry& x, const TaskEntry& y) { return x.spec.id < y.spec.id; });
  for (const auto& entry : ordered) {
    const Time first = clock.now() + entry.spec.phase;
    entries_.push_back(
        {entry, first, with_jitter(first), HealthKeeper{board, entry.spec.id, Role::kLow}});
  }
}

std::size_t LockstepRunner::next() const noexcept {
  const auto first = std::min_element(entries_.begin(), entries_.end(),
                                      [](const Entry& a, const Entry& b) { return a.due < b.due; });
  return static_cast<std::size_t>(first - entries_.begin());
}

void LockstepRunner::step() noexcept {
  Entry& entry = entries_[next()];
  clock_.advance_to(std::max(entry.due, clock_.now()));
  const Stopwatch stopwatch;
  entry.task.task->step(clock_.now());
  entry.health.stepped({clock_.now(), {}, stopwatch.elapsed(), 0, entry.task.task->refused()});
  entry.nominal += entry.task.spec.period;
  entry.due = with_jitter(entry.nominal);
}

Time LockstepRunner::with_jitter(Time nominal) noexcept {
  if (max_jitter_ == Duration::zero()) {
    return nominal;
  }
  const auto late = random_() % static_cast<std::uint64_t>(max_jitter_.count() + 1);
  return nominal + Duration{static_cast<std::int64_t>(late)};
}

}  // namespace lodesman
