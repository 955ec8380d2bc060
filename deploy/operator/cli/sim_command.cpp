// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/sim_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/console_settings.h"
#include "deploy/boat/device_catalogue.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/boat/version.h"
#include "deploy/operator/cli/bench_options.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/cli/console_option.h"
#include "deploy/operator/cli/number_options.h"
#include "deploy/operator/cli/run_output.h"
#include "deploy/operator/recorder/series_of_boat.h"
#include "deploy/operator/report/output_file.h"
#include "deploy/operator/report/run_files.h"
#include "deploy/operator/run/lockstep_run.h"
#include "deploy/operator/run/realtime_run.h"
#include "deploy/operator/run/run_directory.h"
#include "deploy/operator/watch/find_segment.h"
#include "hal_sim/campaign/encounter.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;

struct SimOptions {
  CommonOptions common;
  std::string scenario;
  std::string profile = "default";
  std::string out;
  std::optional<std::uint64_t> seed;
  std::optional<double> time_limit_s;
  bool force = false;
  bool lockstep = false;
  bool no_images = false;
  bool wait_start = false;
  bool record = false;
  std::string console = kConsoleAuto;
};

[[nodiscard]] fs::path run_directory(const SimOptions& options, const Scenario& scenario) {
  if (!options.out.empty()) {
    return make_named_directory(options.out, options.force);
  }
  const std::int64_t now_s = std::time(nullptr);
  return make_new_directory(fs::path{"runs"} / run_name(now_s * 1'000'000'000, scenario.name));
}

[[nodiscard]] std::string read_text(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream{file, std::ios::binary}.rdbuf();
  return text.str();
}

[[nodiscard]] int exit_status_of(const RunResult& result) noexcept {
  if (result.outcome == "fault") {
    return kExitFault;
  }
  if (result.collided) {
    return kExitCollision;
  }
  return result.reached ? kExitDone : kExitNoGoal;
}

constexpr const char* kRecording = "mission.mcap";

// Of a run in lock-step; the other ways of running have lodesman-recorder.
[[nodiscard]] std::unique_ptr<FileSeries> recording_of(const SimOptions& options,
                                                       const BoatConfig& configuration,
                                                       const fs::path& directory) {
  if (!options.record) {
    return nullptr;
  }
  RecordingNotes notes =
      recording_notes(configuration, "lodesman sim", read_text(directory / "scenario.toml"));
  notes.about["profile"] = options.profile;
  notes.about["mode"] = "lockstep";
  return series_of_run(configuration, directory / kRecording, std::move(notes), Pace::kLockstep);
}

// Closes it. Empty where all is in the file.
[[nodiscard]] std::string fault_of(FileSeries& recording) {
  recording.close();
  return recording.failure();
}

[[nodiscard]] std::uint16_t console_port(const BoatConfig& configuration) {
  return read_console(configuration.document.root().table("console")).port;
}

[[nodiscard]] RunRecord run(const SimOptions& options, const BoatConfig& configuration,
                            const Scenario& scenario, const fs::path& ports,
                            const fs::path& directory, const std::optional<BenchOptions>& bench,
                            RunOutput& output) {
  const auto on_plan = [&](const Blackboard& board, const Plan& plan, const SonarPath* path,
                           const PlanRecord& record) { output.add(board, plan, path, record); };
  const auto on_row = [&](const TrajectoryRow& row) { output.add(row); };
  const std::function<bool()> interrupted = stop_caught;
  const std::function<void(const RunProgress&)> show = [&](const RunProgress& progress) {
    output.show(progress);
  };
  if (options.lockstep) {
    const auto recording = recording_of(options, configuration, directory);
    RunRecord record = run_lockstep(
        {configuration, scenario, interrupted, show, on_plan, {}, on_row, recording.get()});
    output.note(recording ? fault_of(*recording) : "");
    return record;
  }
  std::optional<std::vector<std::string>> bench_arguments;
  if (bench) {
    bench_arguments = arguments_of(*bench, ports);
  }
  return run_realtime(
      {directory / "config.toml", directory / "scenario.toml", configuration, scenario,
       bench_arguments, options.wait_start, interrupted, show, on_plan, on_row,
       options.record ? std::optional{directory / kRecording} : std::nullopt,
       [&output](const std::string& fault) { output.note(fault); },
       console_beside(options.console, console_port(configuration), options.common.quiet)});
}

// What lodesman-low and lodesman-high are told too.
[[nodiscard]] BoatConfig simulated(const SimOptions& options,
                                   const std::optional<BenchOptions>& bench,
                                   const fs::path& ports) {
  CommonOptions common = options.common;
  if (bench) {
    set_bench(*bench, ports, common);
    set_bench_world(load_configuration(options.profile, common), options.scenario, common);
  }
  common.sets.push_back("simulation.scenario=" + toml_string(options.scenario));
  return load_configuration(options.profile, common);
}

[[nodiscard]] int simulate(const SimOptions& options, const std::optional<BenchOptions>& bench) {
  const PortsDirectory ports{bench.has_value()};
  const BoatConfig configuration = simulated(options, bench, ports.path());
  Scenario scenario = load_named_scenario(options.scenario, configuration.speeds);
  scenario.seed = options.seed.value_or(scenario.seed);
  scenario.time_limit_s = options.time_limit_s.value_or(scenario.time_limit_s);
  require_sound(configuration, &scenario);
  if (const char* real = real_device(configuration.devices); real != nullptr && !bench) {
    configuration.document.root().table("devices").refuse(
        real,
        "is real, and sim sails by itself: start lodesman-low and lodesman-high by hand, or use "
        "lodesman hil");
  }
  const auto number = encounter_number(options.scenario);
  const std::string scenario_text =  // before it may be overwritten
      number ? encounter_scenario(*number) : read_text(scenario_file(options.scenario));
  // Nothing is refused any more: now there may be files.
  fs::path directory = run_directory(options, scenario);
  write_whole_file(directory / "config.toml", configuration.to_text());
  write_whole_file(directory / "scenario.toml", scenario_text);

  catch_stop_signals();
  remove_dead_runs();
  RunOutput output{
      scenario, directory,
      run_output_options(configuration, &scenario, options.common.quiet, !options.no_images)};
  if (!options.wait_start) {
    output.say(bench ? "the thrusters are emulated: armed by the launcher"
                     : "the thrusters are simulated: armed by the launcher");
  }
  RunRecord record = run(options, configuration, scenario, ports.path(), directory, bench, output);
  record.result.scenario = scenario.name;
  record.result.profile = options.profile;
  record.result.seed = static_cast<std::int64_t>(scenario.seed);
  record.result.version = kVersion;
  if (stop_caught() && !record.result.reached && record.result.outcome != "fault") {
    record.result.outcome = record.result.collided ? "collision" : "aborted";
  }
  output.finish(directory, record);
  if (options.out.empty() && has_no_clock(directory)) {
    directory = rename_by_clock(directory, record.started_utc_ns, scenario.name);
  }
  if (options.common.json) {
    fmt::print("{}", result_json(record.result));
  } else if (!options.common.quiet) {
    print_summary(record, directory, !options.no_images);
  }
  return output.is_whole() ? exit_status_of(record.result) : kExitFault;
}

void add_options(CLI::App& command, SimOptions& options) {
  command.add_option("scenario", options.scenario, "A scenario file, or the name of a shipped one")
      ->required()
      ->type_name("SCENARIO");
  command.add_option("--profile", options.profile, "default, or paper: as the paper did it")
      ->check(CLI::IsMember({"default", "paper"}));
  command.add_option("--out", options.out, "Run directory [runs/<UTC time>-<scenario>]")
      ->type_name("DIR");
  command.add_flag("--force", options.force, "Into a directory that holds a run: writes over it");
  add_seed_option(command, options.seed);
  command.add_option("--time-limit", options.time_limit_s, "Instead of the scenario's")
      ->type_name("S")
      ->check(number_from(1.0, 1e6));
  command.add_flag("--no-images", options.no_images, "Neither sonar views nor plots");
  command.add_flag("--wait-start", options.wait_start, "Wait for `lodesman start`");
  command.add_flag("--record", options.record,
                   "Every publication into mission.mcap of the run directory");
  add_console_option(command, options.console);
  add_common_options(command, options.common);
}

}  // namespace

void add_sim_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<SimOptions>();
  CLI::App* command = root.add_subcommand("sim", kSimDescription);
  add_options(*command, *options);
  command->add_flag("--lockstep", options->lockstep,
                    "One thread on a virtual clock: deterministic, as fast as the machine allows");
  command->footer(
      "Example: lodesman sim paper-static --profile paper --lockstep\n\nFaults that a "
      "scenario may name:\n" +
      fault_kinds_help());
  command->callback([options, &exit_status] { exit_status = simulate(*options, {}); });
}

void add_hil_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<SimOptions>();
  const auto bench = std::make_shared<BenchOptions>();
  CLI::App* command = root.add_subcommand("hil", kHilDescription);
  add_options(*command, *options);
  add_bench_options(*command, *bench);
  command->footer(
      "Examples: lodesman hil paper-static --profile paper\n"
      "          lodesman hil paper-static --ahrs-port /dev/ttyUSB0 --bench-ahrs-port "
      "/dev/ttyUSB1");
  command->callback([options, bench, &exit_status] {
    complete(*bench);
    exit_status = simulate(*options, *bench);
  });
}

}  // namespace lodesman::cli
