// SPDX-License-Identifier: Apache-2.0
// A whole run in real time: starts lodesman-low and lodesman-high on a segment of their own, looks
// on, and stops them in order. The caller's thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "deploy/boat/assembled_boat.h"
#include "deploy/operator/run/watcher.h"

namespace lodesman::cli {

// The console beside a run, where there is to be one.
struct ConsoleBeside {
  std::uint16_t port = 0;
  bool or_next = false;  // where that is taken, one of the next
};

struct RealtimeRun {
  std::filesystem::path configuration_file;  // resolved: one file with every key
  std::filesystem::path scenario_file;
  const BoatConfig& configuration;
  const Scenario& scenario;
  // Arguments of lodesman-devices, where it runs beside them: then the truth is in its segment.
  std::optional<std::vector<std::string>> bench;
  bool wait_start = false;  // for an operator's start, instead of starting by itself
  const std::function<bool()>& interrupted;
  const std::function<void(const RunProgress&)>& show;
  std::function<void(const Blackboard&, const Plan&, const SonarPath*, const PlanRecord&)> on_plan;
  // For each row of the trajectory; may be empty.
  std::function<void(const TrajectoryRow&)> on_row = {};
  // The file of a recording, where there is to be one.
  std::optional<std::filesystem::path> record = std::nullopt;
  // Called once at the end with why a recording that was asked for is not whole; may be empty.
  std::function<void(const std::string&)> on_recording_fault = {};
  // What becomes of it changes nothing about the run.
  std::optional<ConsoleBeside> console = std::nullopt;
};

// A process that dies or falls silent is named in the record's `fault`, and the other one is
// stopped. Throws StartupError where a process refuses what it was given, and has said so.
[[nodiscard]] RunRecord run_realtime(const RealtimeRun& run);

}  // namespace lodesman::cli
