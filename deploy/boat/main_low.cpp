// SPDX-License-Identifier: Apache-2.0
// lodesman-low: owns the devices and the segment, and runs the low level's real-time tasks.
#include <spdlog/spdlog.h>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/device_watch.h"
#include "deploy/boat/exit_status.h"
#include "deploy/boat/failsafes.h"
#include "deploy/boat/latch_file.h"
#include "deploy/boat/log.h"
#include "deploy/boat/process_main.h"
#include "deploy/boat/service_manager.h"
#include "deploy/boat/status_line.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"
#include "mid_level/runtime/realtime_rights.h"
#include "mid_level/runtime/run_realtime.h"

namespace lodesman {
namespace {

struct LowOptions : ProcessOptions {
  std::optional<std::uint64_t> seed;  // instead of the scenario's
};

// Simulated thrusters harm nobody: nothing of them is kept.
[[nodiscard]] std::optional<LatchFile> latch_of(const BoatConfig& config) {
  const auto place =
      has_real_thrusters(config) ? LatchFile::place_for(config.segment) : std::nullopt;
  return place ? std::optional{LatchFile{*place}} : std::nullopt;
}

void take_over(const std::optional<LatchFile>& latch, BoatConfig& config) {
  const Latch found = latch ? latch->read() : Latch::kClear;
  config.low.thruster.stop_is_latched = found == Latch::kStopped;
  config.low.thruster.remembers = found != Latch::kUnreadable;
  if (found == Latch::kStopped) {
    spdlog::warn("the emergency stop is latched: lodesman estop --release, then lodesman arm");
  } else if (found == Latch::kUnreadable) {
    spdlog::warn("the latch of the emergency stop cannot be read: the thrusters are disarmed");
  }
}

// `begun`: what stood on the segment before is not this program's word.
void keep(std::optional<LatchFile>& latch, Reader<ThrustStatus>& thrust, Time begun) {
  const auto* status = thrust.latest();
  if (!latch || status == nullptr || status->stamp < begun) {
    return;
  }
  if (const auto complaint = latch->follow(status->value)) {
    spdlog::error("{}", *complaint);
  }
}

int run(const LowOptions& options) {
  BoatConfig config = load_configuration(options.profile, options.common);
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
  std::optional<LatchFile> latch = latch_of(config);
  take_over(latch, config);
  const Time begun = SteadyClock{}.now();
  AssembledBoat boat{board.writable(), config, scenario};
  if (const std::string missing = set_up_realtime(); !missing.empty()) {
    spdlog::warn("{}", missing);
  }
  const auto tasks = boat.tasks();
  HealthWatch health{*board, tasks, SteadyClock{}.now()};
  const RealtimeRunner runner{tasks, board.writable(), Role::kLow, end_without};
  std::optional<DeviceWatch> devices;
  if (has_real_devices(config)) {
    devices.emplace(*board, config.devices);
  }
  Reader<ThrustStatus> thrust{board->thrust_status};
  LowStatusLine line{*board};
  ServiceManager manager;
  wait_for_stop([&] {
    say_what_hangs(health);
    manager.look(health, SteadyClock{}.now(), [&] { return line.text(); });
    if (devices) {
      devices->say_news(SteadyClock{}.now());
    }
    keep(latch, thrust, begun);
    return false;
  });
  manager.stopping();
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
  app.add_flag_callback(
      "--failsafes",
      [] {
        for (const std::string& row : lodesman::failsafe_rows()) {
          std::printf("%s\n", row.c_str());
        }
        throw CLI::Success{};
      },
      "Print what happens when something falls silent, and end");
  app.footer("Example: lodesman-low --config boat.toml");
  return lodesman::process_main(app, argc, argv, [&] { return lodesman::run(options); });
}
