// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/response_times.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodesman::cli {
namespace {

constexpr Duration kHorizon = std::chrono::minutes{1};
constexpr Duration kInstant{1};
// In which the bound for several cores is counted, upwards; smaller ones only take longer.
constexpr Duration kQuantum = std::chrono::microseconds{1};

[[nodiscard]] std::int64_t divided_up(Duration part, Duration whole) noexcept {
  return (part.count() + whole.count() - 1) / whole.count();
}

// From the first of so many releases to the last, at the least.
[[nodiscard]] Duration least_span(const AnalysedTask& task, std::int64_t releases) noexcept {
  Duration low{};
  Duration high = kHorizon;
  while (high - low > kInstant) {
    const Duration middle = low + (high - low) / 2;
    (releases_within(task, middle) < releases ? low : high) = middle;
  }
  return releases_within(task, kInstant) >= releases ? Duration{} : low;
}

[[nodiscard]] bool interferes(const AnalysedTask& other, const AnalysedTask& task) noexcept {
  return &other != &task && other.priority >= task.priority;
}

// The end of the first `own` steps of a busy period that began with a release of everybody.
[[nodiscard]] std::optional<Duration> busy_until(std::span<const AnalysedTask> tasks,
                                                 const AnalysedTask& task, std::int64_t own,
                                                 Duration blocking) noexcept {
  Duration end = blocking + own * task.execution;
  for (Duration before{-1}; end != before && end <= kHorizon;) {
    before = end;
    end = blocking + own * task.execution;
    for (const AnalysedTask& other : tasks) {
      if (interferes(other, task)) {
        end += releases_within(other, std::max(before, kInstant)) * other.execution;
      }
    }
  }
  return end <= kHorizon ? std::optional{end} : std::nullopt;
}

[[nodiscard]] std::optional<Duration> on_one_core(std::span<const AnalysedTask> tasks,
                                                  const AnalysedTask& task, Duration blocking) {
  Duration worst{};
  for (std::int64_t own = 1;; ++own) {
    const auto end = busy_until(tasks, task, own, blocking);
    if (!end) {
      return std::nullopt;
    }
    worst = std::max(worst, *end - least_span(task, own));
    if (*end <= least_span(task, own + 1)) {
      return worst;
    }
  }
}

// What the others do while the task waits goes on on all cores. A step of another that was released
// before may still run: one whose deadline had not passed.
[[nodiscard]] std::optional<Duration> on_cores(std::span<const AnalysedTask> tasks,
                                               const AnalysedTask& task,
                                               const AnalysedMachine& machine) {
  // Released while it runs, it runs once more after that.
  const bool meets_itself = least_span(task, 2) < task.deadline;
  const Duration alone = machine.blocking + (meets_itself ? 2 : 1) * task.execution;
  Duration response = alone;
  for (Duration before{-1}; response != before && response <= kHorizon;) {
    before = response;
    Duration others{};
    for (const AnalysedTask& other : tasks) {
      if (interferes(other, task)) {
        const Duration work = releases_within(other, before + other.deadline) * other.execution;
        others += std::min(work, before - alone + kQuantum);
      }
    }
    response = alone + others / static_cast<std::int64_t>(machine.cores);
  }
  return response <= kHorizon ? std::optional{response} : std::nullopt;
}

}  // namespace

std::int64_t releases_within(const AnalysedTask& task, Duration window) noexcept {
  if (window <= Duration::zero()) {
    return 0;
  }
  std::int64_t count = 0;
  for (const ReleaseStream& stream : task.releases) {
    count += divided_up(window + stream.jitter, stream.spacing);
  }
  return task.least_gap > Duration::zero() ? std::min(count, divided_up(window, task.least_gap))
                                           : count;
}

std::optional<Duration> worst_response(std::span<const AnalysedTask> tasks, std::size_t which,
                                       const AnalysedMachine& machine) {
  return machine.cores <= 1 ? on_one_core(tasks, tasks[which], machine.blocking)
                            : on_cores(tasks, tasks[which], machine);
}

double utilisation(std::span<const AnalysedTask> tasks) noexcept {
  double sum = 0.0;
  for (const AnalysedTask& task : tasks) {
    double rate_hz = 0.0;
    for (const ReleaseStream& stream : task.releases) {
      rate_hz += 1.0 / to_seconds(stream.spacing);
    }
    if (task.least_gap > Duration::zero()) {
      rate_hz = std::min(rate_hz, 1.0 / to_seconds(task.least_gap));
    }
    sum += rate_hz * to_seconds(task.execution);
  }
  return sum;
}

double rate_monotonic_bound(std::size_t tasks) noexcept {
  const auto n = static_cast<double>(tasks);
  return tasks == 0 ? 1.0 : n * (std::pow(2.0, 1.0 / n) - 1.0);
}

}  // namespace lodesman::cli
