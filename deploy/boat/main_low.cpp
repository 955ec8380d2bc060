// SPDX-License-Identifier: Apache-2.0
// lodesman-low: owns the devices and the segment, and runs the low level's real-time tasks.
#include <spdlog/spdlog.h>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/exit_status.h"
#include "deploy/boat/log.h"
#include "deploy/boat/process_main.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"
#include "mid_level/runtime/realtime_rights.h"
#include "mid_level/runtime/run_realtime.h"

namespace lodesman {
namespace {

struct LowOptions : ProcessOptions {
  std::optional<std::uint64_t> seed;  // instead of the scenario's
};

int run(const LowOptions& options) {
  const BoatConfig config = load_configuration(options.profile, options.common);
  std::optional<Scenario> simulated = simulated_scenario(config);
  if (simulated) {
    simulated->seed = options.seed.value_or(simulated->seed);
  }
  const Scenario* scenario = simulated ? &*simulated : nullptr;
  // A start that is refused leaves everything as it found it, a segment to take over too.
  require_sound(config, scenario);
  SharedBlackboard board = SharedBlackboard::create(config.segment);
  if (!board.legacy().empty()) {
    spdlog::warn("segment {}: {}", config.segment, board.legacy());
  }
  AssembledBoat boat{board.writable(), config, scenario};
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
  lodesman::LowOptions options;
  lodesman::add_process_options(app, options);
  lodesman::add_seed_option(app, options.seed);
  app.footer("Example: lodesman-low --config boat.toml");
  return lodesman::process_main(app, argc, argv, [&] { return lodesman::run(options); });
}
