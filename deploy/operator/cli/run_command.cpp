// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/run_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/log.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/run/kept_boat.h"
#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::cli {
namespace {

constexpr const char* kInstalled = "/etc/lodesman/boat.toml";
constexpr Duration kLookPeriod = std::chrono::milliseconds{20};

struct RunOptions {
  CommonOptions common;
  std::string profile = "default";
};

[[nodiscard]] std::vector<std::string> arguments_of(const RunOptions& options) {
  std::vector<std::string> arguments{"--profile", options.profile};
  for (const std::string& file : options.common.config_files) {
    arguments.insert(arguments.end(), {"--config", file});
  }
  for (const std::string& set : options.common.sets) {
    arguments.insert(arguments.end(), {"--set", set});
  }
  return arguments;
}

// Refused here in one line, rather than by each program once.
[[nodiscard]] std::string segment_of_sound(const RunOptions& options) {
  const BoatConfig config = load_configuration(options.profile, options.common);
  const std::optional<Scenario> scenario = simulated_scenario(config);
  require_sound(config, scenario ? &*scenario : nullptr);
  return config.segment;
}

[[nodiscard]] int run(RunOptions options) {
  if (options.common.config_files.empty()) {
    options.common.config_files.emplace_back(kInstalled);
  }
  const std::string segment = segment_of_sound(options);
  log_without_blocking();
  catch_stop_signals();
  const SteadyClock clock;
  KeptBoat boat{arguments_of(options), [&options](const std::string& line) {
                  if (!options.common.quiet) {
                    say(line);
                  }
                }};
  std::optional<std::string> refused;
  while (!stop_caught() && !refused) {
    refused = boat.look(clock.now());
    std::this_thread::sleep_for(kLookPeriod);
  }
  boat.stop(clock.now());
  remove_dead_segment(segment);
  if (refused) {
    say(*refused);
  }
  if (options.common.json) {
    const nlohmann::ordered_json document{
        {"ended", refused ? "refused" : "stopped"},
        {"restarts", {{"low", boat.restarts_of_low()}, {"high", boat.restarts_of_high()}}}};
    fmt::print("{}\n", document.dump());
  }
  return refused ? kExitRefused : kExitDone;
}

}  // namespace

void add_run_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      root.add_subcommand("run",
                          "A boat without a service manager: starts its programs, keeps "
                          "them running, ends with them");
  command->add_option("--profile", options->profile, "default, or paper: as the paper did it")
      ->check(CLI::IsMember({"default", "paper"}));
  add_common_options(*command, options->common);
  command->footer(std::string{"Example: lodesman run --config boat.toml\n\nWithout --config: "} +
                  kInstalled + ". Ctrl-C, or SIGTERM, ends it: the thrusters are neutral first.");
  command->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace lodesman::cli
