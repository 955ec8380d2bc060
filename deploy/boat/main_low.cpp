// SPDX-License-Identifier: Apache-2.0
// lodesman-low: owns the devices and the segment, and runs the low level's real-time tasks.
#include <spdlog/spdlog.h>

#include "deploy/boat/configuration.h"
#include "deploy/boat/exit_status.h"
#include "deploy/boat/log.h"
#include "deploy/boat/process_main.h"
#include "deploy/boat/scenario_voyage.h"
#include "deploy/boat/simulation.h"
#include "deploy/boat/version.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"
#include "mid_level/runtime/realtime_rights.h"
#include "mid_level/runtime/run_realtime.h"

namespace lodesman {
namespace {

int run(const ProcessOptions& options) {
  const TomlDocument configuration = load_whole_configuration(options.configuration_file);
  Scenario scenario = load_named_scenario(options.scenario_file);
  scenario.seed = options.seed.value_or(scenario.seed);
  // A start that is refused leaves everything as it found it, a segment to take over too.
  require_devices(configuration, scenario);
  SharedBlackboard board = SharedBlackboard::create(options.segment);
  if (!board.legacy().empty()) {
    spdlog::warn("segment {}: {}", options.segment, board.legacy());
  }
  SimulatedBoat boat{board.writable(), configuration, scenario};
  if (const std::string missing = set_up_realtime(); !missing.empty()) {
    spdlog::warn("{}", missing);
  }
  const auto tasks = boat.tasks();
  HealthWatch health{*board, tasks, SteadyClock{}.now()};
  const RealtimeRunner runner{tasks, board.writable(), Role::kLow, end_without};
  wait_for_stop([&] {
    say_what_hangs(health);
    return false;
  });
  return kExitDone;
}

}  // namespace
}  // namespace lodesman

int main(int argc, char** argv) {
  lodesman::block_stop_signals();
  lodesman::log_without_blocking();
  CLI::App app{"The low level: devices, sonar, path finder and thrusters", "lodesman-low"};
  app.set_version_flag("--version", lodesman::kVersion);
  lodesman::ProcessOptions options;
  lodesman::add_process_options(app, options);
  return lodesman::process_main(app, argc, argv, [&] { return lodesman::run(options); });
}
