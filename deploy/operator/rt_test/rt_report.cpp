// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/rt_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "deploy/operator/report/numbers.h"

namespace lodesman::cli {
namespace {

using Json = nlohmann::ordered_json;

[[nodiscard]] const TaskSpec& row_of(const TaskFigures& figures) noexcept {
  return kTaskTable[static_cast<std::size_t>(figures.task)];
}

[[nodiscard]] double us(Duration duration) noexcept { return to_seconds(duration) * 1e6; }

[[nodiscard]] Duration at_most(const LateCounts& counts, Duration worst, double share) noexcept {
  return late_at_most(counts, static_cast<std::uint64_t>(worst.count()), share);
}

[[nodiscard]] std::string three(const LateCounts& counts, Duration worst) {
  return fmt::format("{:>6.0f} {:>6.0f} {:>7.0f}", us(at_most(counts, worst, 0.5)),
                     us(at_most(counts, worst, 0.99)), us(worst));
}

[[nodiscard]] Json json_of(const LateCounts& counts, Duration worst) {
  return {{"p50_us", rounded(us(at_most(counts, worst, 0.5)), 3)},
          {"p99_us", rounded(us(at_most(counts, worst, 0.99)), 3)},
          {"worst_us", rounded(us(worst), 3)},
          {"histogram", counts}};
}

[[nodiscard]] std::string milliseconds_or_dash(const std::optional<Duration>& duration) {
  return duration ? fmt::format("{:.2f}", to_seconds(*duration) * 1e3) : "-";
}

[[nodiscard]] Json us_or_null(const std::optional<Duration>& duration) {
  return duration ? Json(rounded(us(*duration), 3)) : Json(nullptr);
}

[[nodiscard]] double share_of_core(const RtReport& report, const ThreadFacts& thread) noexcept {
  return static_cast<double>(thread.cpu_ticks) / ticks_per_second() / report.conditions.seconds;
}

void object_to(std::vector<std::string>& reasons, const TaskFigures& figures, std::uint64_t count,
               const char* what) {
  if (count > 0) {
    reasons.push_back(fmt::format("{}: {} {}", to_string(figures.task), count, what));
  }
}

void object_to(std::vector<std::string>& reasons, const TaskFigures& figures,
               const WorstResponses& worst, const RtConditions& conditions) {
  const Duration deadline = row_of(figures).deadline;
  if (!worst.all_cores || *worst.all_cores > deadline) {
    reasons.push_back(fmt::format(
        "{}: by the analysis a step may end {} after its release on {} cores, its deadline is "
        "{:.0f} ms",
        to_string(figures.task),
        worst.all_cores ? milliseconds_or_dash(worst.all_cores) + " ms" : "any time",
        conditions.cores, to_seconds(deadline) * 1e3));
  }
}

[[nodiscard]] std::string wake_line(const TaskFigures& figures) {
  return fmt::format("{:<12} {:>4} {:>7} {} {} {}", to_string(figures.task), figures.fifo_priority,
                     figures.steps, three(figures.late, figures.worst_late),
                     three(figures.wake_late, figures.worst_wake_late),
                     three(figures.took, figures.worst_took));
}

[[nodiscard]] std::string judged_line(const TaskFigures& figures, const WorstResponses& worst) {
  const auto count = [](const std::optional<std::uint64_t>& number) {
    return number ? std::to_string(*number) : "-";
  };
  const auto& thread = figures.thread;
  return fmt::format("{:<12} {:>6} {:>6} {:>8} {:>6} {:>6} {:>6} {:>7} {:>8} {:>8} {:>8.0f}",
                     to_string(figures.task), figures.overruns, figures.over_budget,
                     figures.past_deadline, thread ? std::to_string(thread->minor_faults) : "-",
                     thread ? std::to_string(thread->major_faults) : "-",
                     count(figures.allocations), thread ? std::to_string(thread->put_off) : "-",
                     milliseconds_or_dash(worst.one_core), milliseconds_or_dash(worst.all_cores),
                     to_seconds(row_of(figures).deadline) * 1e3);
}

[[nodiscard]] Json json_of(const RtReport& report, std::size_t index) {
  const TaskFigures& figures = report.tasks[index];
  const TaskSpec& spec = row_of(figures);
  const auto of_thread = [&](std::uint64_t ThreadFacts::*member) {
    return figures.thread ? Json((*figures.thread).*member) : Json(nullptr);
  };
  return {
      {"name", to_string(figures.task)},
      {"period_us", us(spec.period)},
      {"budget_us", us(spec.budget)},
      {"deadline_us", us(spec.deadline)},
      {"fifo_priority", spec.fifo_priority},
      {"fifo_priority_held", figures.fifo_priority},
      {"steps", figures.steps},
      {"wakes", figures.wakes},
      {"overruns", figures.overruns},
      {"over_budget", figures.over_budget},
      {"past_deadline", figures.past_deadline},
      {"late", json_of(figures.late, figures.worst_late)},
      {"wake_late", json_of(figures.wake_late, figures.worst_wake_late)},
      {"took", json_of(figures.took, figures.worst_took)},
      {"minor_faults", of_thread(&ThreadFacts::minor_faults)},
      {"major_faults", of_thread(&ThreadFacts::major_faults)},
      {"allocations", figures.allocations ? Json(*figures.allocations) : Json(nullptr)},
      {"put_off", of_thread(&ThreadFacts::put_off)},
      {"share_of_core",
       figures.thread ? Json(rounded(share_of_core(report, *figures.thread), 5)) : Json(nullptr)},
      {"response_one_core_us", us_or_null(report.responses[index].one_core)},
      {"response_all_cores_us", us_or_null(report.responses[index].all_cores)}};
}

[[nodiscard]] Json json_of(const CyclictestFigures& figures, int priority) {
  return {{"fifo_priority", priority},     {"wakes", figures.wakes},
          {"p50_us", us(figures.median)},  {"p99_us", us(figures.p99)},
          {"worst_us", us(figures.worst)}, {"histogram", figures.late}};
}

}  // namespace

int cyclictest_priority() noexcept {
  return std::max_element(
             kTaskTable.begin(), kTaskTable.end(),
             [](const auto& a, const auto& b) { return a.fifo_priority < b.fifo_priority; })
      ->fifo_priority;
}

RtReport report_of(const RtConditions& conditions, const BoatLook& first, const BoatLook& last,
                   const std::optional<CyclictestFigures>& cyclictest) {
  RtReport report;
  report.conditions = conditions;
  report.cyclictest = cyclictest;
  for (const TaskSpec& spec : kTaskTable) {
    if (const auto figures = figures_between(first, last, spec.id)) {
      report.tasks.push_back(*figures);
    }
  }
  const auto analysed = as_analysed(report.tasks, first, last);
  const Duration blocking = cyclictest ? cyclictest->worst : Duration{};
  report.utilisation = utilisation(analysed);
  for (std::size_t i = 0; i < analysed.size(); ++i) {
    report.responses.push_back({worst_response(analysed, i, {1, blocking}),
                                worst_response(analysed, i, {conditions.cores, blocking})});
  }
  return report;
}

std::vector<std::string> objections(const RtReport& report) {
  std::vector<std::string> reasons;
  if (report.conditions.seconds < report.conditions.wanted_s) {
    reasons.push_back(fmt::format("it ended after {:.1f} of {:.1f} s", report.conditions.seconds,
                                  report.conditions.wanted_s));
  }
  for (const TaskSpec& spec : kTaskTable) {
    if (std::none_of(report.tasks.begin(), report.tasks.end(),
                     [&](const TaskFigures& figures) { return figures.task == spec.id; })) {
      reasons.push_back(fmt::format("{}: its steps could not be counted", to_string(spec.id)));
    }
  }
  for (std::size_t i = 0; i < report.tasks.size(); ++i) {
    const TaskFigures& figures = report.tasks[i];
    if (figures.fifo_priority < static_cast<std::uint64_t>(row_of(figures).fifo_priority)) {
      reasons.push_back(fmt::format("{}: holds SCHED_FIFO priority {} of {}",
                                    to_string(figures.task), figures.fifo_priority,
                                    row_of(figures).fifo_priority));
    }
    object_to(reasons, figures, figures.overruns, "periods missed");
    object_to(reasons, figures, figures.past_deadline, "steps ended after their deadline");
    object_to(reasons, figures, figures.over_budget, "steps were longer than their budget");
    object_to(reasons, figures, figures.allocations.value_or(0), "allocations in steps");
    if (figures.thread) {
      object_to(reasons, figures, figures.thread->minor_faults + figures.thread->major_faults,
                "page faults");
    }
    object_to(reasons, figures, report.responses[i], report.conditions);
  }
  return reasons;
}

std::vector<std::string> table_lines(const RtReport& report) {
  const RtConditions& c = report.conditions;
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{:.0f} s, load {}, {} cores, {}, Linux {}{}", c.seconds,
                              to_string(c.load), c.cores, c.processor, c.kernel,
                              c.real_time_kernel ? ", a real-time kernel" : ""));
  lines.push_back(fmt::format("{:<12} {:>4} {:>7} {:>21} {:>21} {:>21}", "", "", "", "late us",
                              "late us, woken", "step us"));
  const std::string three_heads = fmt::format("{:>6} {:>6} {:>7}", "50 %", "99 %", "worst");
  lines.push_back(fmt::format("{:<12} {:>4} {:>7} {} {} {}", "task", "FIFO", "steps", three_heads,
                              three_heads, three_heads));
  for (const TaskFigures& figures : report.tasks) {
    lines.push_back(wake_line(figures));
  }
  if (report.cyclictest) {
    lines.push_back(fmt::format("{:<12} {:>4} {:>7} {:>6.0f} {:>6.0f} {:>7.0f}", "cyclictest",
                                cyclictest_priority(), report.cyclictest->wakes,
                                us(report.cyclictest->median), us(report.cyclictest->p99),
                                us(report.cyclictest->worst)));
  } else if (!report.cyclictest_why.empty()) {
    lines.push_back("cyclictest: " + report.cyclictest_why);
  }
  lines.push_back("");
  lines.push_back(fmt::format("{:<12} {:>6} {:>6} {:>8} {:>13} {:>6} {:>7} {:>26}", "", "", "over",
                              "past", "page faults", "allo-", "put", "worst response ms on"));
  lines.push_back(fmt::format("{:<12} {:>6} {:>6} {:>8} {:>6} {:>6} {:>6} {:>7} {:>8} {:>8} {:>8}",
                              "task", "missed", "budget", "deadline", "minor", "major", "cated",
                              "off", "1 core", fmt::format("{} cores", c.cores), "deadline"));
  for (std::size_t i = 0; i < report.tasks.size(); ++i) {
    lines.push_back(judged_line(report.tasks[i], report.responses[i]));
  }
  lines.push_back(
      fmt::format("by the longest steps {:.1f} % of one core; periodic tasks fit below {:.1f} %",
                  100.0 * report.utilisation, 100.0 * rate_monotonic_bound(report.tasks.size())));
  return lines;
}

Json to_json(const RtReport& report) {
  const RtConditions& c = report.conditions;
  Json tasks = Json::array();
  for (std::size_t i = 0; i < report.tasks.size(); ++i) {
    tasks.push_back(json_of(report, i));
  }
  const auto reasons = objections(report);
  return {{"verdict", reasons.empty() ? "pass" : "fail"},
          {"reasons", reasons},
          {"load", to_string(c.load)},
          {"seconds", rounded(c.seconds, 3)},
          {"cores", c.cores},
          {"processor", c.processor},
          {"kernel", c.kernel},
          {"real_time_kernel", c.real_time_kernel},
          {"utilisation", rounded(report.utilisation, 5)},
          {"rate_monotonic_bound", rounded(rate_monotonic_bound(report.tasks.size()), 5)},
          {"tasks", std::move(tasks)},
          {"cyclictest",
           report.cyclictest ? json_of(*report.cyclictest, cyclictest_priority()) : Json(nullptr)},
          {"cyclictest_why",
           report.cyclictest_why.empty() ? Json(nullptr) : Json(report.cyclictest_why)}};
}

}  // namespace lodesman::cli
