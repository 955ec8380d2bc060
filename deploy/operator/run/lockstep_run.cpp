// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/lockstep_run.h"

#include <optional>

#include "deploy/operator/recorder/direct_recording.h"
#include "mid_level/base/stopwatch.h"
#include "mid_level/recording/recording_hash.h"
#include "mid_level/runtime/run_lockstep.h"

namespace lodesman::cli {
namespace {

constexpr Duration kShowPeriod = std::chrono::seconds{1};      // virtual
constexpr Duration kStartPatience = std::chrono::seconds{20};  // for the devices to be ready

[[nodiscard]] std::vector<TaskEntry> tasks_of(AssembledBoat& boat, HighLevel& high,
                                              const LockstepRun& run) {
  std::vector<TaskEntry> tasks = boat.tasks();
  for (const auto& entry : high.tasks()) {
    tasks.push_back(entry);
  }
  if (run.on_tasks) {
    run.on_tasks(tasks);
  }
  return tasks;
}

}  // namespace

RunRecord run_lockstep(const LockstepRun& run) {
  const Stopwatch stopwatch;
  const auto board = std::make_unique<Blackboard>();
  const Voyage voyage = voyage_of(run.configuration, &run.scenario);
  const HighLevelOptions options = high_level_options(run.configuration, voyage);
  AssembledBoat boat{*board, run.configuration, &run.scenario};
  HighLevel high{*board, Role::kHigh, options};
  std::vector<TaskEntry> tasks = tasks_of(boat, high, run);
  SimClock clock;
  // Not zero: a stamp of zero means "never".
  clock.advance_to(Time{std::chrono::seconds{1}});
  DeskOptions at_the_desk = desk_options(run.configuration, voyage);
  at_the_desk.starts_by_itself = true;
  OperatorDesk desk{*board, Role::kHigh, at_the_desk, [&clock] { return clock.now(); }};
  const LockstepOptions lockstep{run.configuration.simulation.lockstep_jitter, run.scenario.seed};
  LockstepRunner runner{tasks, clock, *board, lockstep};
  RunWatcher watcher{*board, with_planned_zones(run.scenario, options),
                     options.controller.waypoint_radius_m};
  if (run.on_plan) {
    watcher.on_plan = [&](const Plan& plan, const SonarPath* path, const PlanRecord& record) {
      run.on_plan(*board, plan, path, record);
    };
  }
  watcher.on_row = run.on_row;
  RecordingHash hash{*board};
  std::optional<DirectRecording> recording;
  if (run.recording != nullptr) {
    recording.emplace(*board, *run.recording);
  }
  const Time limit = clock.now() + kStartPatience + from_seconds(run.scenario.time_limit_s);
  Time next_show = clock.now();
  Time next_poll = clock.now();
  while (!watcher.mission_ended() && clock.now() < limit && !run.interrupted()) {
    runner.step();
    hash.update();
    if (recording) {
      recording->update(clock.now());
    }
    if (clock.now() < next_poll) {
      continue;
    }
    next_poll = clock.now() + std::chrono::milliseconds{20};
    desk.look();
    watcher.poll();
    const RunProgress progress = watcher.progress();
    if (progress.scenario_time_s >= run.scenario.time_limit_s) {
      break;
    }
    if (clock.now() >= next_show) {
      next_show = clock.now() + kShowPeriod;
      run.show(progress);
    }
  }
  const double took_s = to_seconds(stopwatch.elapsed());
  RunRecord record = watcher.finish();
  record.result.mode = "lockstep";
  record.result.recording_hash = hash.digest();
  record.result.real_time_factor = took_s > 0.0 ? record.result.time_s / took_s : 0.0;
  return record;
}

}  // namespace lodesman::cli
