// SPDX-License-Identifier: Apache-2.0
// What a run that is sailed or shown again leaves in its directory, and what is said of it. The
// main thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "deploy/boat/configuration.h"
#include "deploy/operator/cli/view_saver.h"
#include "deploy/operator/report/plan_story.h"
#include "deploy/operator/report/run_files.h"
#include "deploy/operator/run/progress.h"

namespace lodesman::cli {

// On standard output: how it went, and where its files are; a fault on standard error.
void print_summary(const RunRecord& record, const std::filesystem::path& directory, bool images);

struct RunOutputOptions {
  bool quiet = false;
  bool images = true;
  ViewSettings views;
};

// As the boat of this configuration sails. `world`: the simulated one; nullptr: none.
[[nodiscard]] RunOutputOptions run_output_options(const BoatConfig& config, const Scenario* world,
                                                  bool quiet, bool images);

// What a run writes while it goes on. What cannot be written is said once, and the run goes on.
class RunOutput {
 public:
  // Into an existing directory. StartupError names a file that cannot be made.
  RunOutput(const Scenario& scenario, const std::filesystem::path& directory,
            const RunOutputOptions& options);

  void say(const std::string& news) { line_.say(news); }
  void show(const RunProgress& progress);
  void add(const TrajectoryRow& row);
  void add(const Blackboard& board, const Plan& plan, const SonarPath* path,
           const PlanRecord& record);
  // result.json, then the pictures.
  void finish(const std::filesystem::path& directory, const RunRecord& record);
  // Of what others write: one line; empty where nothing is wrong.
  void note(const std::string& fault);
  // Whether all of it could be written, what was said included.
  [[nodiscard]] bool is_whole() const noexcept { return !lost_ && !line_.failed(); }

 private:
  RunFiles files_;
  ProgressLine line_;
  PlanStory story_;
  double noticed_s_ = 0.0;
  std::optional<ViewSaver> views_;
  bool lost_ = false;
};

}  // namespace lodesman::cli
