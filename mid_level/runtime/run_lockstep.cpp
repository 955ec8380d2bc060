// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/run_lockstep.h"

#include <algorithm>

#include "mid_level/base/check.h"
#include "mid_level/base/stopwatch.h"

namespace lodesman {

namespace {

// Numbers that are due times, and numbers that are wakes, are different streams of a task.
constexpr std::uint64_t kPeriods = 0;
constexpr std::uint64_t kWakes = 1;

// splitmix64: every number a stream of its own.
[[nodiscard]] std::uint64_t mixed(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

}  // namespace

LockstepRunner::LockstepRunner(std::span<const TaskEntry> entries, SimClock& clock,
                               Blackboard& board, const LockstepOptions& options)
    : clock_{clock}, options_{options} {
  LODESMAN_CHECK(!entries.empty());
  std::vector<TaskEntry> ordered{entries.begin(), entries.end()};
  std::sort(ordered.begin(), ordered.end(),
            [](const TaskEntry& x, const TaskEntry& y) { return x.spec.id < y.spec.id; });
  for (const auto& task : ordered) {
    LODESMAN_CHECK(task.spec.nominal > Duration::zero());
    Bell<>& bell = board.bell_of(task.spec.id);
    entries_.push_back({task, HealthKeeper{board, task.spec, Role::kLow},
                        StepWitness{board, task, Role::kLow}, &bell, look_at(bell)});
    Entry& entry = entries_.back();
    entry.witness.begin(clock.now());
    entry.nominal = clock.now() + task.spec.phase;
    put_on_grid(entry);
  }
}

LockstepRunner::Entry& LockstepRunner::next() noexcept {
  return *std::min_element(entries_.begin(), entries_.end(),
                           [](const Entry& a, const Entry& b) { return a.next() < b.next(); });
}

// A step answers all that it was due for, by its period and by rings: once an instant.
void LockstepRunner::step() noexcept {
  Entry& entry = next();
  clock_.advance_to(std::max(entry.next(), clock_.now()));
  const Time now = clock_.now();
  const StepCause cause = entry.due <= now ? StepCause::kPeriod : StepCause::kRing;
  entry.seen = look_at(*entry.bell);
  entry.woken.reset();
  entry.began = now;
  const Stopwatch stopwatch;
  entry.witness.look();
  entry.task.task->step(now);
  entry.witness.stepped(now);
  entry.health.stepped({now, {}, stopwatch.elapsed(), 0, entry.task.task->refused(), cause});
  if (cause == StepCause::kPeriod) {
    entry.nominal += entry.task.spec.period;
    put_on_grid(entry);
  }
  answer_rings(entry.task.spec, now);
}

void LockstepRunner::put_on_grid(Entry& entry) noexcept {
  entry.due = entry.nominal + jitter(entry, kPeriods, entry.periods++);
}

void LockstepRunner::answer_rings(const TaskSpec& publisher, Time now) noexcept {
  for (Entry& entry : entries_) {
    const std::uint32_t rings = look_at(*entry.bell);
    if (rings == entry.seen) {
      continue;
    }
    entry.seen = rings;
    if (!entry.woken) {
      const Time heard = now + publisher.nominal + jitter(entry, kWakes, entry.wakes++);
      const Time earliest = entry.began ? *entry.began + entry.task.spec.least_gap : now;
      entry.woken = std::max(heard, earliest);
    }
  }
}

Duration LockstepRunner::jitter(const Entry& entry, std::uint64_t stream,
                                std::uint64_t count) const noexcept {
  if (options_.max_jitter == Duration::zero()) {
    return Duration::zero();
  }
  const auto task = static_cast<std::uint64_t>(entry.task.spec.id);
  const std::uint64_t number = mixed(mixed(mixed(options_.seed) ^ (2 * task + stream)) ^ count);
  return Duration{static_cast<std::int64_t>(
      number % static_cast<std::uint64_t>(options_.max_jitter.count() + 1))};
}

}  // namespace lodesman
