// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/sim_command.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include "deploy/cli/common_options.h"
#include "deploy/cli/report/plan_story.h"
#include "deploy/cli/report/plots.h"
#include "deploy/cli/report/run_files.h"
#include "deploy/cli/report/side_flips.h"
#include "deploy/cli/run/lockstep_run.h"
#include "deploy/cli/run/progress.h"
#include "deploy/cli/run/realtime_run.h"
#include "deploy/cli/run/settings.h"
#include "deploy/cli/run/simulated_boat.h"
#include "deploy/cli/run/stop_signals.h"
#include "deploy/cli/run/view_saver.h"
#include "deploy/cli/version.h"
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
  bool lockstep = false;
  bool no_images = false;
  bool wait_start = false;
  std::string console = "off";
};

[[nodiscard]] fs::path run_directory(const SimOptions& options, const Scenario& scenario) {
  const std::time_t now = std::time(nullptr);
  fs::path directory =
      options.out.empty()
          ? fs::path{"runs"} / fmt::format("{:%Y%m%dT%H%M%SZ}-{}", fmt::gmtime(now), scenario.name)
          : fs::path{options.out};
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) {
    throw StartupError("--out: " + directory.string() + ": " + error.message());
  }
  return directory;
}

[[nodiscard]] std::string read_text(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream{file, std::ios::binary}.rdbuf();
  return text.str();
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream stream{file};
  stream << text;
  if (!stream.flush()) {
    throw StartupError(file.string() + ": cannot be written");
  }
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

[[nodiscard]] std::string metres_or_none(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f} m", *value) : "none";
}

void print_summary(const RunRecord& record, const fs::path& directory, bool images) {
  const RunResult& r = record.result;
  if (!r.fault.empty()) {
    fmt::print(stderr, "fault: {}\n", r.fault);
  }
  fmt::print("{} ({}, {}): {} after {:.1f} s, {:.2f} m from the goal\n", r.scenario, r.profile,
             r.mode, r.outcome, r.time_s, r.goal_error_m);
  fmt::print("smallest inoffensive distance {}, hull clearance {}\n",
             metres_or_none(r.min_inoffensive_distance_m), metres_or_none(r.min_hull_clearance_m));
  std::string reasons;
  for (const auto& [reason, count] : r.plan_reasons) {
    reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
  }
  fmt::print("{} plans ({})", r.plans, reasons);
  const SideFlips flips = side_flips(record.plans, record.obstacles);
  fmt::print("; side changed {} times", flips.count);
  if (flips.first_s) {
    fmt::print(", first at {:.1f} s", *flips.first_s);
  }
  fmt::print("\nrun directory: {}\n", directory.string());
  if (images) {
    for (const char* picture : {"world", "inoffensive_distance", "heading", "thrust"}) {
      fmt::print("  {}\n", (directory / (std::string{picture} + ".png")).string());
    }
    fmt::print("  {}\n", (directory / "sonar").string());
  }
}

[[nodiscard]] RunRecord run(const SimOptions& options, const TomlDocument& configuration,
                            const Scenario& scenario, const fs::path& directory) {
  std::optional<ViewSaver> views;
  if (!options.no_images) {
    views.emplace(directory, simulation_settings(configuration).sonar_view_period,
                  scenario.sonar.range_m);
  }
  ProgressLine line{scenario, options.common.quiet};
  PlanStory story;
  const auto on_plan = [&](const Blackboard& board, const Plan& plan, const SonarPath* path,
                           const PlanRecord& record) {
    if (views) {
      views->save(board, plan, path, record);
    }
    if (const std::string news = story.news(record); !news.empty()) {
      line.say(news);
    }
  };
  const std::function<bool()> interrupted = [] { return stop_caught(); };
  const std::function<void(const RunProgress&)> show = [&](const RunProgress& progress) {
    line.show(progress);
  };
  if (options.lockstep) {
    return run_lockstep({configuration, scenario, interrupted, show, on_plan});
  }
  return run_realtime({directory / "config.toml", directory / "scenario.toml", configuration,
                       scenario, options.wait_start, interrupted, show, on_plan});
}

// False, and said, when the run directory could not be filled: after a run that is a fault, no
// refusal.
[[nodiscard]] bool write_run(const fs::path& directory, const RunRecord& record, bool images) {
  try {
    write_run_files(directory, record);
    if (images) {
      draw_pictures(directory, record);
    }
    return true;
  } catch (const StartupError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return false;
  }
}

[[nodiscard]] int simulate(const SimOptions& options) {
  if (options.time_limit_s && std::isnan(*options.time_limit_s)) {  // in no range, says CLI11 not
    throw StartupError("--time-limit: must be a number from 1 to 1000000");
  }
  const TomlDocument configuration = load_configuration(options.profile, options.common);
  Scenario scenario = load_named_scenario(options.scenario);
  scenario.seed = options.seed.value_or(scenario.seed);
  scenario.time_limit_s = options.time_limit_s.value_or(scenario.time_limit_s);
  require_devices(configuration, scenario);
  const auto number = encounter_number(options.scenario);
  const std::string scenario_text =  // before it may be overwritten
      number ? encounter_scenario(*number) : read_text(scenario_file(options.scenario));
  // Nothing is refused any more: now there may be files.
  const fs::path directory = run_directory(options, scenario);
  write_text(directory / "config.toml", configuration.to_text());
  write_text(directory / "scenario.toml", scenario_text);

  catch_stop_signals();
  RunRecord record = run(options, configuration, scenario, directory);
  record.result.scenario = scenario.name;
  record.result.profile = options.profile;
  record.result.seed = static_cast<std::int64_t>(scenario.seed);
  record.result.version = kVersion;
  if (stop_caught() && !record.result.reached && record.result.outcome != "fault") {
    record.result.outcome = record.result.collided ? "collision" : "aborted";
  }
  const bool written = write_run(directory, record, !options.no_images);
  if (options.common.json) {
    fmt::print("{}", result_json(record.result));
  } else if (!options.common.quiet) {
    print_summary(record, directory, !options.no_images);
  }
  return written ? exit_status_of(record.result) : kExitFault;
}

void add_options(CLI::App& command, SimOptions& options) {
  command.add_option("scenario", options.scenario, "A scenario file, or the name of a shipped one")
      ->required()
      ->type_name("SCENARIO");
  command.add_flag("--lockstep", options.lockstep,
                   "One thread on a virtual clock: deterministic, as fast as the machine allows");
  command.add_option("--profile", options.profile, "default, or paper: as the paper did it")
      ->check(CLI::IsMember({"default", "paper"}));
  command.add_option("--out", options.out, "Run directory [runs/<UTC time>-<scenario>]")
      ->type_name("DIR");
  add_seed_option(command, options.seed);
  command.add_option("--time-limit", options.time_limit_s, "Instead of the scenario's")
      ->type_name("S")
      ->check(CLI::Range(1.0, 1e6));
  command.add_flag("--no-images", options.no_images, "Neither sonar views nor plots");
  command.add_flag("--wait-start", options.wait_start, "Wait for `lodesman start`");
  command.add_option("--console", options.console, "off")->check(CLI::IsMember({"off"}));
  add_common_options(command, options.common);
}

}  // namespace

void add_sim_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<SimOptions>();
  CLI::App* command = root.add_subcommand("sim", "Sail a scenario on simulated devices");
  add_options(*command, *options);
  command->footer(
      "Example: lodesman sim paper-static --profile paper --lockstep\n\nFaults that a "
      "scenario may name:\n" +
      fault_kinds_help());
  command->callback([options, &exit_status] { exit_status = simulate(*options); });
}

}  // namespace lodesman::cli
