// SPDX-License-Identifier: Apache-2.0
// Counts a task's steps, how late they began, those of its period apart from those it was woken
// for, how long they took and which periods were missed, and publishes that once a second. One
// thread.
#pragma once

#include <algorithm>
#include <bit>

#include "mid_level/runtime/task.h"

namespace lodesman {

// A task tells its health at its first step after this has passed.
inline constexpr Duration kHealthPeriod = std::chrono::seconds{1};

// Which of TaskHealth::late counts a step that began so late; of TaskHealth::took, one that took so
// long.
[[nodiscard]] constexpr std::size_t late_bucket(Duration late) noexcept {
  const auto us = static_cast<std::uint64_t>(std::max<std::int64_t>(late.count(), 0)) / 1000;
  return std::min<std::size_t>(static_cast<std::size_t>(std::bit_width(us)),
                               TaskHealth::kLateBuckets - 1);
}

using LateCounts = std::array<std::uint64_t, TaskHealth::kLateBuckets>;

// How late, at most, that share (from 0 to 1) of the counted steps began, or how long they took: a
// power of two of microseconds, or the worst where that is less. Zero where there was no step.
[[nodiscard]] constexpr Duration late_at_most(const LateCounts& late, std::uint64_t worst_ns,
                                              double share) noexcept {
  const Duration worst{static_cast<std::int64_t>(worst_ns)};
  double steps = 0.0;
  for (const std::uint64_t count : late) {
    steps += static_cast<double>(count);
  }
  double seen = 0.0;
  for (std::size_t i = 0; i + 1 < TaskHealth::kLateBuckets; ++i) {
    seen += static_cast<double>(late[i]);
    if (seen >= share * steps) {
      return std::min(Duration{std::chrono::microseconds{std::int64_t{1} << i}}, worst);
    }
  }
  return worst;
}

// Of the steps of its period.
[[nodiscard]] constexpr Duration late_at_most(const TaskHealth& health, double share) noexcept {
  return late_at_most(health.late, health.worst_late_ns, share);
}
// Of those that it was woken for.
[[nodiscard]] constexpr Duration wake_late_at_most(const TaskHealth& health,
                                                   double share) noexcept {
  return late_at_most(health.wake_late, health.worst_wake_late_ns, share);
}
// How long that share of all its steps took.
[[nodiscard]] constexpr Duration took_at_most(const TaskHealth& health, double share) noexcept {
  return late_at_most(health.took, health.worst_step_ns, share);
}

enum class StepCause : std::uint8_t { kPeriod, kRing };

struct StepTimes {
  Time began{};
  Duration late{};  // from when it was due, or rung for
  Duration took{};
  std::uint64_t missed_periods = 0;
  std::uint64_t refused = 0;  // Task::refused() after it
  StepCause cause = StepCause::kPeriod;
};

class HealthKeeper {
 public:
  HealthKeeper(Blackboard& board, const TaskSpec& spec, Role role)
      : writer_{board.task_health[static_cast<std::size_t>(spec.id)], role, to_string(spec.id)},
        budget_{spec.budget},
        deadline_{spec.deadline} {}

  void holds_fifo_priority(int priority) noexcept {
    health_.fifo_priority = static_cast<std::uint64_t>(priority);
  }

  void stepped(const StepTimes& step) noexcept {
    ++health_.steps;
    health_.overruns += step.missed_periods;
    health_.refused = step.refused;
    health_.last_step_ns = nanoseconds(step.took);
    health_.worst_step_ns = std::max(health_.worst_step_ns, health_.last_step_ns);
    ++health_.took[late_bucket(step.took)];
    count_late(step);
    health_.over_budget += budget_ > Duration::zero() && step.took > budget_ ? 1U : 0U;
    health_.past_deadline +=
        deadline_ > Duration::zero() && step.late + step.took > deadline_ ? 1U : 0U;
    if (step.began >= due_) {
      writer_.publish(health_, step.began);
      due_ = step.began + kHealthPeriod;
    }
  }

 private:
  void count_late(const StepTimes& step) noexcept {
    const std::uint64_t late_ns = nanoseconds(step.late);
    if (step.cause == StepCause::kRing) {
      ++health_.wakes;
      health_.worst_wake_late_ns = std::max(health_.worst_wake_late_ns, late_ns);
      ++health_.wake_late[late_bucket(step.late)];
    } else {
      health_.worst_late_ns = std::max(health_.worst_late_ns, late_ns);
      ++health_.late[late_bucket(step.late)];
    }
  }
  [[nodiscard]] static std::uint64_t nanoseconds(Duration duration) noexcept {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(duration.count(), 0));
  }

  Writer<TaskHealth> writer_;
  Duration budget_;
  Duration deadline_;
  TaskHealth health_;
  Time due_{};
};

}  // namespace lodesman
