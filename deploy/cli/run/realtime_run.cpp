// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/run/realtime_run.h"

#include <unistd.h>

#include <memory>
#include <thread>

#include "deploy/cli/run/child_process.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::cli {
namespace {

constexpr Duration kPollPeriod = std::chrono::milliseconds{20};
constexpr Duration kShowPeriod = std::chrono::milliseconds{200};
constexpr Duration kSegmentPatience = std::chrono::seconds{5};
constexpr Duration kStopPatience = std::chrono::seconds{2};

// Both processes and the name they share. High is stopped first, so that its last word is heard.
class TwoProcesses {
 public:
  explicit TwoProcesses(const RealtimeRun& run)
      : segment_{"lodesman-sim-" + std::to_string(getpid())} {
    const std::vector<std::string> common{"--segment",        segment_,
                                          "--config",         run.configuration_file.string(),
                                          "--scenario",       run.scenario_file.string(),
                                          "--seed",           std::to_string(run.scenario.seed),
                                          "--stop-with-input"};
    low_ = std::make_unique<ChildProcess>("lodesman-low", common);
    std::vector<std::string> high = common;
    if (!run.wait_start) {
      high.push_back("--start");
    }
    high_ = std::make_unique<ChildProcess>("lodesman-high", high);
  }
  TwoProcesses(const TwoProcesses&) = delete;
  TwoProcesses& operator=(const TwoProcesses&) = delete;
  ~TwoProcesses() { stop(); }

  [[nodiscard]] const std::string& segment() const noexcept { return segment_; }

  // Which one died, and how; empty while both run.
  [[nodiscard]] std::string fault() {
    for (auto* child : {low_.get(), high_.get()}) {
      if (child->ended()) {
        return child->name() + " died: " + *child->ended();
      }
    }
    return {};
  }

  void stop() {
    high_->stop(kStopPatience);
    low_->stop(kStopPatience);
    remove_dead_segment(segment_);
  }

 private:
  std::string segment_;
  std::unique_ptr<ChildProcess> low_;
  std::unique_ptr<ChildProcess> high_;
};

// Waits for the segment as long as both processes live.
[[nodiscard]] SharedBlackboard observe(TwoProcesses& processes) {
  const SteadyClock clock;
  const Time deadline = clock.now() + kSegmentPatience;
  for (;;) {
    try {
      return SharedBlackboard::observe(processes.segment(), Duration::zero());
    } catch (const StartupError& error) {
      if (const std::string fault = processes.fault(); !fault.empty()) {
        throw StartupError(fault);
      }
      if (clock.now() >= deadline) {
        throw;
      }
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
}

}  // namespace

RunRecord run_realtime(const RealtimeRun& run) {
  TwoProcesses processes{run};
  const SharedBlackboard board = observe(processes);
  const HighLevelOptions options = high_level_options(run.configuration, run.scenario);
  RunWatcher watcher{*board, with_planned_zones(run.scenario, options),
                     options.controller.waypoint_radius_m};
  if (run.on_plan) {
    watcher.on_plan = [&](const Plan& plan, const SonarPath* path, const PlanRecord& record) {
      run.on_plan(*board, plan, path, record);
    };
  }
  const SteadyClock clock;
  const Time started = clock.now();
  Time next_show = started;
  std::string fault;
  while (fault.empty() && !watcher.mission_ended() && !run.interrupted()) {
    std::this_thread::sleep_for(kPollPeriod);
    watcher.poll();
    fault = processes.fault();
    const RunProgress progress = watcher.progress();
    if (!fault.empty() && progress.state == MissionState::kIdle) {
      throw StartupError(fault);  // it refused to start, and has said why
    }
    if (progress.scenario_time_s >= run.scenario.time_limit_s) {
      break;
    }
    if (clock.now() >= next_show) {
      next_show = clock.now() + kShowPeriod;
      run.show(progress);
    }
  }
  const double took_s = to_seconds(clock.now() - started);
  processes.stop();
  watcher.poll();
  RunRecord record = watcher.finish();
  record.result.mode = "realtime";
  record.result.real_time_factor = took_s > 0.0 ? record.result.time_s / took_s : 0.0;
  if (!fault.empty()) {
    record.result.fault = fault;
    record.result.outcome = "fault";
  }
  return record;
}

}  // namespace lodesman::cli
