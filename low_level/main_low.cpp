// SPDX-License-Identifier: Apache-2.0
// lodesman-low: owns the devices and the segment, and runs the low level's real-time tasks.
#include <spdlog/spdlog.h>

#include "deploy/cli/run/log.h"
#include "deploy/cli/run/process_main.h"
#include "deploy/cli/run/settings.h"
#include "deploy/cli/run/simulated_boat.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"
#include "mid_level/runtime/realtime_rights.h"
#include "mid_level/runtime/run_realtime.h"

namespace lodesman {
namespace {

int run(const cli::ProcessOptions& options) {
  const TomlDocument configuration = cli::load_whole_configuration(options.configuration_file);
  Scenario scenario = cli::load_named_scenario(options.scenario_file);
  scenario.seed = options.seed.value_or(scenario.seed);
  // A start that is refused leaves everything as it found it, a segment to take over too.
  cli::require_devices(configuration, scenario);
  SharedBlackboard board = SharedBlackboard::create(options.segment);
  if (!board.legacy().empty()) {
    spdlog::warn("segment {}: {}", options.segment, board.legacy());
  }
  cli::SimulatedBoat boat{board.writable(), configuration, scenario};
  if (const std::string missing = set_up_realtime(); !missing.empty()) {
    spdlog::warn("{}", missing);
  }
  const auto tasks = boat.tasks();
  HealthWatch health{*board, tasks, SteadyClock{}.now()};
  const RealtimeRunner runner{tasks, board.writable(), Role::kLow, cli::end_without};
  cli::wait_for_stop([&] {
    cli::say_what_hangs(health);
    return false;
  });
  return cli::kExitDone;
}

}  // namespace
}  // namespace lodesman

int main(int argc, char** argv) {
  namespace cli = lodesman::cli;
  cli::block_stop_signals();
  cli::log_without_blocking();
  CLI::App app{"The low level: devices, sonar, path finder and thrusters", "lodesman-low"};
  cli::ProcessOptions options;
  cli::add_process_options(app, options);
  return cli::process_main(app, argc, argv, [&] { return lodesman::run(options); });
}
