// SPDX-License-Identifier: Apache-2.0
// What planning, guidance and control cost a ping: whole runs in lock-step, with a stopwatch round
// the steps of these three tasks. Prints a Markdown table. One thread.
#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "deploy/operator/report/percentiles.h"
#include "deploy/operator/run/lockstep_run.h"
#include "mid_level/base/stopwatch.h"

namespace lodesman::bench {
namespace {

constexpr std::array kScenarios{"paper-static", "paper-multiple", "paper-speed-1.12", "ring-opens",
                                "twenty-movers"};

// A task and how long its steps took, in microseconds, since somebody last looked.
class Measured final : public Task {
 public:
  Measured(Task& task, double& spent_us) : task_{task}, spent_us_{spent_us} {}
  void step(Time now) noexcept override {
    const Stopwatch stopwatch;
    task_.step(now);
    spent_us_ += to_seconds(stopwatch.elapsed()) * 1e6;
  }
  void enter_safe_state(Time now) noexcept override { task_.enter_safe_state(now); }

 private:
  Task& task_;
  double& spent_us_;
};

struct Cost {
  std::vector<double> ping_us;
  cli::RunResult result;
};

Cost sail(const std::string& scenario_name) {
  const BoatConfig configuration = load_configuration("default", {});
  const Scenario scenario = load_named_scenario(scenario_name, configuration.speeds);
  const std::function<bool()> never = [] { return false; };
  const std::function<void(const cli::RunProgress&)> silent = [](const cli::RunProgress&) {};
  Cost cost;
  double spent_us = 0.0;
  std::vector<std::unique_ptr<Measured>> measured;
  cli::LockstepRun run{configuration, scenario, never, silent, {}};
  run.on_plan = [&](const Blackboard&, const Plan&, const SonarPath*, const cli::PlanRecord&) {
    cost.ping_us.push_back(spent_us);
    spent_us = 0.0;
  };
  run.on_tasks = [&](std::vector<TaskEntry>& tasks) {
    for (TaskEntry& entry : tasks) {
      const TaskId id = entry.spec.id;
      if (id == TaskId::kPathFinder || id == TaskId::kPlanner || id == TaskId::kController) {
        measured.push_back(std::make_unique<Measured>(*entry.task, spent_us));
        entry.task = measured.back().get();
      }
    }
  };
  cost.result = cli::run_lockstep(run).result;
  return cost;
}

void print_table() {
  std::puts("| scenario | pings | median us | p99 us | worst us | mean share of a core at 10 Hz |");
  std::puts("|---|---|---|---|---|---|");
  for (const char* scenario_name : kScenarios) {
    const Cost cost = sail(scenario_name);
    const cli::Percentiles us = cli::percentiles(cost.ping_us);
    double sum_us = 0.0;
    for (const double ping_us : cost.ping_us) {
      sum_us += ping_us;
    }
    const double mean_us = sum_us / static_cast<double>(cost.ping_us.size());
    std::printf("| %s | %zu | %.0f | %.0f | %.0f | %.2f %% |\n", scenario_name, cost.ping_us.size(),
                us.p50, us.p99, us.max, mean_us / 1e5 * 100.0);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace lodesman::bench

int main() {
  try {
    lodesman::bench::print_table();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
