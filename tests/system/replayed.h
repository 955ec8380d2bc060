// SPDX-License-Identifier: Apache-2.0
// Runs recorded in lock-step, and their decisions made again. For tests.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "deploy/boat/named_scenario.h"
#include "deploy/operator/recorder/series_of_boat.h"
#include "deploy/operator/replay/replay.h"
#include "deploy/operator/run/lockstep_run.h"
#include "tests/support/catch.h"
#include "tests/support/text_of.h"
#include "tests/system/boat.h"

namespace lodesman::testing {

using namespace cli;

// Long runs are cut off here: by then each has planned round what it meets.
inline constexpr double kLongest_s = 60.0;

// The recording of a shipped scenario, sailed in lock-step.
[[nodiscard]] inline fs::path sailed(const Scratch& scratch, const std::string& name,
                                     const std::string& profile,
                                     const std::vector<std::string>& sets = {},
                                     double longest_s = kLongest_s) {
  CommonOptions options;
  options.sets = sets;
  options.sets.emplace_back("recorder.free_floor_mib=0");
  const BoatConfig configuration = load_configuration(profile, options);
  Scenario scenario = load_named_scenario(name, configuration.speeds);
  scenario.time_limit_s = std::min(scenario.time_limit_s, longest_s);
  const std::function<bool()> never = [] { return false; };
  const std::function<void(const RunProgress&)> silent = [](const RunProgress&) {};
  const fs::path file = scratch.file(name + "-" + profile + ".mcap");
  const auto series = series_of_run(
      configuration, file, recording_notes(configuration, "test", text_of(scenario_file(name))),
      Pace::kLockstep);
  (void)run_lockstep({configuration, scenario, never, silent, {}, {}, {}, series.get()});
  series->close();
  REQUIRE(series->failure().empty());
  return file;
}

[[nodiscard]] inline ReplayResult replayed(const fs::path& file,
                                           std::vector<std::string> sets = {}) {
  return replay({{file}, std::move(sets), [] { return false; }, {}});
}

[[nodiscard]] inline const TaskVerdict& of(const ReplayResult& result, TaskId task) {
  const auto found = std::find_if(result.tasks.begin(), result.tasks.end(),
                                  [&](const TaskVerdict& each) { return each.task == task; });
  REQUIRE(found != result.tasks.end());
  return *found;
}

[[nodiscard]] inline std::string story_of(const ReplayResult& result) {
  const Difference* first = result.first();
  return first == nullptr ? "none differs"
                          : std::string{to_string(first->task)} + ": " + first->channel + " " +
                                std::to_string(first->sequence) + ": " + first->field.path + ": " +
                                first->field.recorded + ", " + first->field.replayed;
}

// Silence would agree with everything.
inline void check_that_each_decides(const ReplayResult& result) {
  CHECK(result.tasks.size() == kReplayedCount);
  for (const TaskVerdict& task : result.tasks) {
    INFO(to_string(task.task));
    CHECK(task.steps > 100);
    CHECK(task.judged > 10);
  }
}

inline void check_that_none_differs(const ReplayResult& result) {
  INFO(story_of(result));
  check_that_each_decides(result);
  CHECK(result.differing() == 0);
  CHECK(result.not_judged() == 0);
  CHECK(result.lacks.empty());
}

}  // namespace lodesman::testing
