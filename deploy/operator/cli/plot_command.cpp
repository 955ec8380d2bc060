// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/plot_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "deploy/boat/exit_status.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/operator/bench/file_check.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/cli/number_options.h"
#include "deploy/operator/cli/run_output.h"
#include "deploy/operator/run/run_directory.h"
#include "deploy/operator/run/watched_recording.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;

struct PlotOptions {
  CommonOptions common;
  std::vector<fs::path> files;
  std::string out;
  std::size_t mission = 0;  // counted from 1; 0: the only one
  bool force = false;
  bool no_images = false;
};

// With --force what stands there is written over, the recording itself too.
void refuse_place_of_recording(const PlotOptions& options) {
  for (const fs::path& file : options.files) {
    std::error_code error;
    if (fs::equivalent(fs::absolute(file).parent_path(), options.out, error)) {
      throw StartupError("--out: " + options.out + " is where the recording lies");
    }
  }
}

// runs/pond/mission.mcap is shown in runs/pond/mission.
[[nodiscard]] fs::path directory_for(const PlotOptions& options) {
  if (!options.out.empty()) {
    refuse_place_of_recording(options);
    return make_named_directory(options.out, options.force);
  }
  fs::path name = options.files.front();
  for (const char* ending : {".part", ".mcap"}) {
    name = name.extension() == ending ? name.replace_extension() : name;
  }
  return make_new_directory(name == options.files.front() ? fs::path{name.string() + "-plot"}
                                                          : name);
}

// Index of the mission that is meant.
[[nodiscard]] std::size_t mission_of(const PlotOptions& options, const RecordedBoat& boat) {
  const std::string& file = options.files.front().string();
  const std::size_t count = boat.missions.size();
  if (count == 0) {
    throw StartupError(file + ": no mission was under way while it was recorded");
  }
  if (options.mission == 0 && count > 1) {
    throw StartupError(
        fmt::format("{}: {} missions are in it: --mission 1 to {} names one", file, count, count));
  }
  if (options.mission > count) {
    throw StartupError(fmt::format("--mission: there is no mission {} in {}, which has {}",
                                   options.mission, file, count));
  }
  return options.mission == 0 ? 0 : options.mission - 1;
}

[[nodiscard]] int plot(const PlotOptions& options) {
  refuse_bad_configuration(options.common);
  const RecordedBoat boat = recorded_boat(options.files);
  const std::size_t mission = mission_of(options, boat);
  const fs::path directory = directory_for(options);
  catch_stop_signals();
  const bool quiet = options.common.quiet || options.common.json;
  RunOutput output{scenario_of(boat, mission), directory,
                   run_output_options(boat.configuration, boat.scenario ? &*boat.scenario : nullptr,
                                      quiet, !options.no_images)};
  WatchedRecording run{options.files, boat, mission, stop_caught,
                       [&](const RunProgress& progress) { output.show(progress); }};
  run.on_plan = [&](const Blackboard& board, const Plan& plan, const SonarPath* path,
                    const PlanRecord& record) { output.add(board, plan, path, record); };
  run.on_row = [&](const TrajectoryRow& row) { output.add(row); };
  const WatchedRun shown = watch_recording(run);
  for (const std::string& lack : shown.lacks) {
    output.say("not whole: " + lack);
  }
  output.finish(directory, shown.record);
  if (options.common.json) {
    fmt::print("{}", result_json(shown.record.result));
  } else if (!options.common.quiet) {
    print_summary(shown.record, directory, !options.no_images);
  }
  return output.is_whole() ? kExitDone : kExitFault;
}

}  // namespace

void add_plot_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App* command = root.add_subcommand("plot", kPlotDescription);
  command->add_option("LOG", options->files, "The recording; several files: its parts, in order")
      ->required();
  command->add_option("--out", options->out, "Run directory [LOG without .mcap]")->type_name("DIR");
  command->add_flag("--force", options->force, "Into a directory that holds a run: writes over it");
  command->add_option("--mission", options->mission, "Which of several, counted from 1")
      ->type_name("N")
      ->check(number_from(1.0, 1e6));
  command->add_flag("--no-images", options->no_images, "Neither sonar views nor plots");
  add_common_options(*command, options->common);
  command->footer(
      "A boat on the water has nobody who tells the truth: its track, and how far from it "
      "everything was, are by its own estimate then, which result.json says as counted_from.\n"
      "Example: lodesman plot recordings/20260801T120000Z-boat.mcap");
  command->callback([options, &exit_status] { exit_status = plot(*options); });
}

}  // namespace lodesman::cli
