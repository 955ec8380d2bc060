// SPDX-License-Identifier: Apache-2.0
// A whole run in one thread on a virtual clock: every task of both levels over a blackboard on the
// heap. The caller's thread.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "deploy/boat/assembled_boat.h"
#include "deploy/operator/run/watcher.h"
#include "mid_level/runtime/task.h"

namespace lodesman {
class FileSeries;
}  // namespace lodesman

namespace lodesman::cli {

struct LockstepRun {
  const BoatConfig& configuration;
  const Scenario& scenario;
  // Set to true by a signal handler: the run ends as if its time were up.
  const std::function<bool()>& interrupted;
  // Called now and then with how far it is.
  const std::function<void(const RunProgress&)>& show;
  // For each plan, with the blackboard to take its frame from; may be empty.
  std::function<void(const Blackboard&, const Plan&, const SonarPath*, const PlanRecord&)> on_plan;
  // May put others in the place of tasks, to measure them; may be empty.
  std::function<void(std::vector<TaskEntry>&)> on_tasks = {};
  // For each row of the trajectory; may be empty.
  std::function<void(const TrajectoryRow&)> on_row = {};
  FileSeries* recording = nullptr;  // takes every publication; may be nullptr
};

// The record with its hash and real-time factor.
[[nodiscard]] RunRecord run_lockstep(const LockstepRun& run);

}  // namespace lodesman::cli
