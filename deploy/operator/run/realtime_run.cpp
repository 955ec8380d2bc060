// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/realtime_run.h"

#include <unistd.h>

#include <memory>
#include <optional>
#include <thread>

#include "deploy/boat/device_bench.h"
#include "deploy/boat/exit_status.h"
#include "deploy/boat/log.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/operator/run/child_process.h"
#include "mid_level/base/clock.h"
#include "mid_level/base/stopwatch.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::cli {
namespace {

constexpr Duration kPollPeriod = std::chrono::milliseconds{20};
constexpr Duration kProgressPeriod = std::chrono::milliseconds{200};
constexpr Duration kSegmentPatience = std::chrono::seconds{5};
constexpr Duration kStopPatience = std::chrono::seconds{2};
constexpr Duration kRecorderPatience = std::chrono::seconds{20};  // to write what waits
constexpr double kSilence_s = 1.0;  // so far scenario time may lag behind this program's own

// Both processes, the bench and the recorder where there are such, and the name they share. High is
// stopped first, so that its last word is heard, and the recorder after both, to record the last.
class TwoProcesses {
 public:
  explicit TwoProcesses(const RealtimeRun& run)
      : segment_{"lodesman-sim-" + std::to_string(getpid())} {
    const std::vector<std::string> common{"--segment",        segment_,
                                          "--config",         run.configuration_file.string(),
                                          "--scenario",       run.scenario_file.string(),
                                          "--stop-with-input"};
    if (run.record) {
      std::vector<std::string> recorder = common;
      recorder.insert(recorder.end(), {"--out", run.record->string()});
      recorder_ = std::make_unique<ChildProcess>("lodesman-recorder", recorder);
    }
    if (run.bench) {
      std::vector<std::string> bench = common;
      bench.insert(bench.end(), {"--seed", std::to_string(run.scenario.seed)});
      bench.insert(bench.end(), run.bench->begin(), run.bench->end());
      bench_ = std::make_unique<ChildProcess>("lodesman-devices", bench);
    }
    std::vector<std::string> low = common;
    low.insert(low.end(), {"--seed", std::to_string(run.scenario.seed)});
    low_ = std::make_unique<ChildProcess>("lodesman-low", low);
    std::vector<std::string> high = common;
    if (!run.wait_start) {
      high.push_back("--start");
    }
    if (run.bench) {
      high.push_back("--arm");
    }
    high_ = std::make_unique<ChildProcess>("lodesman-high", high);
    if (run.console) {
      start_console(*run.console, common);
    }
    pulse_ = std::jthread{[this](const std::stop_token& stop) { beat(stop); }};
  }
  TwoProcesses(const TwoProcesses&) = delete;
  TwoProcesses& operator=(const TwoProcesses&) = delete;
  ~TwoProcesses() {
    stop();
    pulse_ = {};
  }

  [[nodiscard]] const std::string& segment() const noexcept { return segment_; }

  // Which one died, and how; empty while both run. Throws StartupError where it is a refusal.
  [[nodiscard]] std::string fault(bool starting) {
    // The boat sails on without a recorder.
    for (auto* child : {recorder_.get(), bench_.get(), low_.get(), high_.get()}) {
      if (child == nullptr || !child->ended() || (child == recorder_.get() && !starting)) {
        continue;
      }
      if (starting && child->exit_status() == kExitRefused) {
        throw StartupError(child->name() + " has refused to start");
      }
      return child->name() + " died: " + *child->ended();
    }
    return {};
  }

  // Says once that there is no console any more: the boat sails on without it.
  void look_at_console() {
    if (console_ && console_->ended()) {
      say("lodesman-console ended (" + *console_->ended() + "): the run goes on without it");
      console_.reset();
    }
  }

  // Why the recording is not whole; empty where it is, or none was asked for. Once all are stopped.
  [[nodiscard]] std::string recording_fault() {
    if (!recorder_ || recorder_->exit_status() == kExitDone) {
      return {};
    }
    return "lodesman-recorder: " + recorder_->ended().value_or("does not end") +
           ": the recording is not whole";
  }

  void stop() {
    high_->stop(kStopPatience);
    low_->stop(kStopPatience);
    if (recorder_) {
      recorder_->stop(kRecorderPatience);
    }
    console_.reset();
    remove_dead_segment(segment_);
    if (bench_) {
      bench_->stop(kStopPatience);
      remove_dead_segment(world_segment_of(segment_));
    }
  }

 private:
  // It says by itself where it is.
  void start_console(const ConsoleBeside& console, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(),
                     {"--set", "console.port=" + std::to_string(console.port), "--sign-in-once"});
    if (console.or_next) {
      arguments.emplace_back("--or-next-port");
    }
    try {
      console_ = std::make_unique<ChildProcess>("lodesman-console", arguments);
    } catch (const StartupError& error) {
      say(std::string{error.what()} + ": the run goes on without it");
    }
  }

  // On a thread of its own, so that nothing that this program waits for stops the boat.
  void beat(const std::stop_token& stop) const {
    while (!stop.stop_requested()) {
      low_->beat();
      high_->beat();
      if (bench_) {
        bench_->beat();
      }
      std::this_thread::sleep_for(kPulsePeriod);
    }
  }

  std::string segment_;
  std::unique_ptr<ChildProcess> recorder_;  // where there is one
  std::unique_ptr<ChildProcess> bench_;     // likewise
  std::unique_ptr<ChildProcess> low_;
  std::unique_ptr<ChildProcess> high_;
  std::unique_ptr<ChildProcess> console_;  // where there is one
  std::jthread pulse_;
};

// Waits for the segment as long as both processes live; without one `fault` says why, unless it
// was an interrupt.
[[nodiscard]] std::optional<SharedBlackboard> observe(const std::string& segment,
                                                      TwoProcesses& processes,
                                                      const std::function<bool()>& interrupted,
                                                      std::string& fault) {
  const SteadyClock clock;
  const Time deadline = clock.now() + kSegmentPatience;
  while (!interrupted()) {
    try {
      return SharedBlackboard::observe(segment, Duration::zero());
    } catch (const StartupError& error) {
      fault = processes.fault(true);
      if (fault.empty() && clock.now() >= deadline) {
        fault = error.what();
      }
      if (!fault.empty()) {
        break;
      }
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
  return std::nullopt;
}

// Watches until the run is over; gives the fault that ended it, if one did.
[[nodiscard]] std::string watch(const RealtimeRun& run, TwoProcesses& processes,
                                RunWatcher& watcher) {
  const SteadyClock clock;
  const double limit_s = run.scenario.time_limit_s;
  const Time begun = clock.now();
  Time next_show = begun;
  while (!watcher.mission_ended() && !run.interrupted()) {
    std::this_thread::sleep_for(kPollPeriod);
    watcher.poll();
    processes.look_at_console();
    const RunProgress progress = watcher.progress();
    if (std::string fault = processes.fault(progress.state == MissionState::kIdle);
        !fault.empty()) {
      return fault;
    }
    if (progress.scenario_time_s >= limit_s) {
      break;
    }
    const Time started = watcher.mission_started();
    const bool sails = started != Time{};
    if ((sails || !run.wait_start) &&
        to_seconds(clock.now() - (sails ? started : begun)) > limit_s + kSilence_s) {
      return sails ? "lodesman-low has fallen silent" : "the mission has not begun";
    }
    if (clock.now() >= next_show) {
      next_show = clock.now() + kProgressPeriod;
      run.show(progress);
    }
  }
  return {};
}

[[nodiscard]] RunRecord finished(const RealtimeRun& run, RunRecord record, double took_s,
                                 const std::string& fault) {
  record.result.mode = run.bench ? "hil" : "realtime";
  record.result.real_time_factor = took_s > 0.0 ? record.result.time_s / took_s : 0.0;
  if (!fault.empty()) {
    record.result.fault = fault;
    record.result.outcome = "fault";
  }
  return record;
}

}  // namespace

RunRecord run_realtime(const RealtimeRun& run) {
  TwoProcesses processes{run};
  const HighLevelOptions& options = run.configuration.high;
  const Scenario planned = with_planned_zones(run.scenario, options);
  std::string fault;
  const auto board = observe(processes.segment(), processes, run.interrupted, fault);
  const auto truth = board && run.bench ? observe(world_segment_of(processes.segment()), processes,
                                                  run.interrupted, fault)
                                        : std::nullopt;
  if (!board || (run.bench && !truth)) {
    return finished(run, blank_record(planned, options.controller.waypoint_radius_m), 0.0, fault);
  }
  RunWatcher watcher{**board, truth ? **truth : **board, planned,
                     options.controller.waypoint_radius_m};
  watcher.on_row = run.on_row;
  if (run.on_plan) {
    watcher.on_plan = [&](const Plan& plan, const SonarPath* path, const PlanRecord& record) {
      run.on_plan(**board, plan, path, record);
    };
  }
  const Stopwatch stopwatch;
  fault = watch(run, processes, watcher);
  const double took_s = to_seconds(stopwatch.elapsed());
  processes.stop();
  watcher.poll();
  if (const std::string no = processes.recording_fault(); !no.empty() && run.on_recording_fault) {
    run.on_recording_fault(no);
  }
  return finished(run, watcher.finish(), took_s, fault);
}

}  // namespace lodesman::cli
