// SPDX-License-Identifier: Apache-2.0
// A run as its recording tells it: the same watcher looks on as when it was sailed. One thread;
// StartupError says what cannot be read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deploy/boat/configuration.h"
#include "deploy/operator/run/watcher.h"
#include "hal_sim/scenario/scenario.h"

namespace lodesman::cli {

// What a recording says of itself, and what a look through it finds.
struct RecordedBoat {
  std::map<std::string, std::string> about;
  BoatConfig configuration;
  std::optional<Scenario> scenario;  // of a simulated one
  bool has_truth = false;
  double sonar_range_m = 0.0;
  // In the order in which they were started, each with its definition's id > 0.
  struct Mission {
    MissionDefinition definition;
    MissionStatus begun;  // when it came under way
  };
  std::vector<Mission> missions;
};

// `files`: one recording, in the order of its parts; not empty.
[[nodiscard]] RecordedBoat recorded_boat(const std::vector<std::filesystem::path>& files);

struct WatchedRecording {
  const std::vector<std::filesystem::path>& files;
  const RecordedBoat& boat;
  std::size_t mission = 0;  // index into the boat's
  std::function<bool()> interrupted;
  std::function<void(const RunProgress&)> show;
  // As in LockstepRun; may be empty.
  std::function<void(const Blackboard&, const Plan&, const SonarPath*, const PlanRecord&)> on_plan =
      {};
  std::function<void(const TrajectoryRow&)> on_row = {};
};

// What the watcher is told of a run: the scenario, or of a boat on the water its mission, from
// where it came under way.
[[nodiscard]] Scenario scenario_of(const RecordedBoat& boat, std::size_t mission);

struct WatchedRun {
  RunRecord record;
  // What is not in it, a line each: files that were cut off, gaps, channels of another build.
  std::vector<std::string> lacks;
};

[[nodiscard]] WatchedRun watch_recording(const WatchedRecording& run);

}  // namespace lodesman::cli
