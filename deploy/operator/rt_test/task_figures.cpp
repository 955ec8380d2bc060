// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/task_figures.h"

#include <algorithm>

namespace lodesman::cli {
namespace {

[[nodiscard]] LateCounts between(const LateCounts& first, const LateCounts& last) noexcept {
  LateCounts counts{};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] = last[i] - first[i];
  }
  return counts;
}

[[nodiscard]] Duration worst_between(const LateCounts& counts, std::uint64_t before_ns,
                                     std::uint64_t after_ns) noexcept {
  return after_ns > before_ns ? Duration{static_cast<std::int64_t>(after_ns)}
                              : late_at_most(counts, after_ns, 1.0);
}

[[nodiscard]] std::optional<ThreadFacts> thread_between(const BoatLook& first, const BoatLook& last,
                                                        const std::string& name) {
  const auto before = first.threads.find(name);
  const auto after = last.threads.find(name);
  if (before == first.threads.end() || after == last.threads.end() ||
      before->second.thread != after->second.thread) {
    return std::nullopt;
  }
  const ThreadFacts& from = before->second;
  const ThreadFacts& to = after->second;
  return ThreadFacts{to.thread, to.minor_faults - from.minor_faults,
                     to.major_faults - from.major_faults, to.cpu_ticks - from.cpu_ticks,
                     to.put_off - from.put_off};
}

// A thread that has never asked the heap for anything is not among those that were counted.
[[nodiscard]] std::optional<std::uint64_t> allocations_between(
    const BoatLook& first, const BoatLook& last, const std::optional<ThreadFacts>& thread) {
  if (!thread || !first.counts_allocations || !last.counts_allocations) {
    return std::nullopt;
  }
  const auto count = [&thread](const BoatLook& look) {
    const auto found = look.allocations.find(thread->thread);
    return found != look.allocations.end() ? found->second : 0;
  };
  return count(last) - count(first);
}

[[nodiscard]] const TaskSpec& row_of(TaskId task) noexcept {
  return kTaskTable[static_cast<std::size_t>(task)];
}

// Empty where nothing was published.
[[nodiscard]] std::optional<Duration> spacing_of(const std::string& channel, const BoatLook& first,
                                                 const BoatLook& last) {
  const auto before = first.publications.find(channel);
  const auto after = last.publications.find(channel);
  if (before == first.publications.end() || after == last.publications.end() ||
      after->second <= before->second) {
    return std::nullopt;
  }
  return (last.at - first.at) / static_cast<std::int64_t>(after->second - before->second);
}

}  // namespace

BoatLook look_at_boat(const Blackboard& board, pid_t low, pid_t high,
                      const AllocationCounter& allocations, Time now) {
  BoatLook look;
  look.at = now;
  for (std::size_t task = 0; task < kTaskCount; ++task) {
    Reader<TaskHealth> reader{board.task_health[task]};
    if (const auto* newest = reader.latest(); newest != nullptr) {
      look.health[task] = newest->value;
    }
  }
  look.threads = thread_facts(low);
  look.threads.merge(thread_facts(high));
  for_each_channel(board, [&look](const ChannelInfo& info, const auto& channel) {
    look.publications[info.name] = channel.head.newest.load(std::memory_order_acquire);
  });
  look.allocations = allocations.counts();
  look.counts_allocations = look.allocations.contains(low) && look.allocations.contains(high);
  return look;
}

std::optional<TaskFigures> figures_between(const BoatLook& first, const BoatLook& last,
                                           TaskId task) {
  const auto& before = first.health[static_cast<std::size_t>(task)];
  const auto& after = last.health[static_cast<std::size_t>(task)];
  if (!before || !after || after->steps <= before->steps) {
    return std::nullopt;
  }
  TaskFigures figures;
  figures.task = task;
  figures.fifo_priority = after->fifo_priority;
  figures.steps = after->steps - before->steps;
  figures.wakes = after->wakes - before->wakes;
  figures.overruns = after->overruns - before->overruns;
  figures.over_budget = after->over_budget - before->over_budget;
  figures.past_deadline = after->past_deadline - before->past_deadline;
  figures.late = between(before->late, after->late);
  figures.wake_late = between(before->wake_late, after->wake_late);
  figures.took = between(before->took, after->took);
  figures.worst_late = worst_between(figures.late, before->worst_late_ns, after->worst_late_ns);
  figures.worst_wake_late =
      worst_between(figures.wake_late, before->worst_wake_late_ns, after->worst_wake_late_ns);
  figures.worst_took = worst_between(figures.took, before->worst_step_ns, after->worst_step_ns);
  figures.thread = thread_between(first, last, to_string(task));
  figures.allocations = allocations_between(first, last, figures.thread);
  return figures;
}

std::vector<AnalysedTask> as_analysed(std::span<const TaskFigures> figures, const BoatLook& first,
                                      const BoatLook& last) {
  std::vector<AnalysedTask> tasks;
  for (const TaskFigures& figure : figures) {
    const TaskSpec& spec = row_of(figure.task);
    AnalysedTask task{spec.fifo_priority, figure.worst_took, spec.deadline, spec.least_gap, {}};
    task.releases.push_back({spec.period, {}});
    for (const WakeEdge& edge : kWakeEdges) {
      if (edge.wakes != figure.task || edge.when == WakeWhen::kNewState) {
        continue;
      }
      const auto spacing = edge.when == WakeWhen::kNewSample
                               ? std::optional{row_of(edge.writer).period}
                               : spacing_of(std::string{edge.channel}, first, last);
      if (spacing) {
        task.releases.push_back({*spacing, row_of(edge.writer).deadline});
      }
    }
    tasks.push_back(std::move(task));
  }
  return tasks;
}

}  // namespace lodesman::cli
