// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_bench.h"

#include "drivers/stream/make_line.h"
#include "drivers/stream/udp_socket.h"
#include "hal_sim/emulators/device_port.h"
#include "hal_sim/emulators/emulated_ahrs.h"
#include "hal_sim/emulators/emulated_position.h"
#include "hal_sim/emulators/emulated_sonar.h"
#include "hal_sim/world/world_task.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman {
namespace {

constexpr Duration kWorldPeriod = std::chrono::milliseconds{20};
constexpr Duration kLookPeriod = std::chrono::milliseconds{100};
// A USB port has no speed of its own.
constexpr int kUsbSpeed_baud = 115200;

[[nodiscard]] std::unique_ptr<HostLine> line_for(const std::string& cable,
                                                 const std::filesystem::path& name, int baud) {
  return cable.empty() ? make_pty_line(name)
                       : make_cable_line(cable, baud != 0 ? baud : kUsbSpeed_baud, open_port);
}

[[nodiscard]] EmulatedAhrsOptions ahrs_options(const Scenario& scenario) {
  EmulatedAhrsOptions options;
  options.unit.seed = options.seed = scenario.seed;
  return options;
}

[[nodiscard]] EmulatedPositionOptions position_options(const DeviceBenchOptions& bench,
                                                       const Scenario& scenario) {
  EmulatedPositionOptions options = emulated_position_options(scenario);
  options.receiver.epoch = bench.epoch;
  return options;
}

[[nodiscard]] EmulatedSonarOptions sonar_options(const DeviceBenchOptions& bench,
                                                 const Scenario& scenario) {
  EmulatedSonarOptions options = emulated_sonar_options(scenario);
  options.program.epoch = bench.epoch;
  return options;
}

[[nodiscard]] EmulatedThrustersOptions box_options(const DeviceBenchOptions& bench,
                                                   const Scenario& scenario) {
  EmulatedThrustersOptions options;
  options.kind = bench.box;
  options.has_escs = bench.has_escs;
  options.seed = scenario.seed;
  return options;
}

}  // namespace

std::string world_segment_of(const std::string& boat_segment) { return boat_segment + "-world"; }

struct DeviceBench::Impl {
  Impl(const DeviceBenchOptions& options, const Scenario& scenario, Time now)
      : boat_segment{options.boat_segment},
        board{SharedBlackboard::create(world_segment_of(options.boat_segment))},
        world{scenario, load_hull(options.hull), board.writable(), *link},
        mission{writer_of(board.writable(), board.writable().mission_status, Role::kHigh)},
        ahrs{ahrs_options(scenario), scenario.faults, now},
        position{position_options(options, scenario), scenario.faults, now},
        sonar{sonar_options(options, scenario), scenario.faults, now},
        thrusters{box_options(options, scenario), scenario.faults, now},
        thrust{link->thrust, Role::kLow, "emulated thrust"},
        samples{link->world},
        ahrs_port{ahrs.device(), ahrs.wire(),
                  line_for(options.ahrs_port, options.directory / "ahrs", ahrs.device().baud())},
        position_port{position.device(), position.wire(),
                      line_for(options.position_port, options.directory / "position",
                               position.device().baud())},
        thruster_port{thrusters.device(), thrusters.wire(),
                      line_for(options.thruster_port, options.directory / "thrusters",
                               thrusters.device().baud())} {
    if (options.sonar_port != 0) {
      sonar_socket.emplace(UdpOptions{options.sonar_host, options.sonar_port, 0});
    }
  }

  void follow_boat(Time now) {
    if (now < next_look) {
      return;
    }
    next_look = now + kLookPeriod;
    if (!boat || boat->is_superseded()) {
      try {
        missions.reset();
        boat.emplace(SharedBlackboard::observe(boat_segment, Duration::zero()));
        missions.emplace((*boat)->mission_status);
      } catch (const StartupError&) {
        boat.reset();  // not yet
      }
    }
    if (missions) {
      if (const auto* status = missions->latest();
          status != nullptr && status->stamp != mission_told) {
        mission_told = status->stamp;
        mission.publish(status->value, status->stamp);
      }
    }
  }

  void step(Time now) {
    follow_boat(now);
    const auto* sample = samples.latest();
    thruster_port.pump(now);
    if (now >= next_world) {
      next_world = std::max(next_world + kWorldPeriod, now - kWorldPeriod);
      if (sample != nullptr) {
        thrusters.feel(sample->value, now);
      }
      thrust.publish(thrusters.output(now), now);
      world.step(now);
      sample = samples.latest();
      if (sample != nullptr) {
        ahrs.feel(sample->value, thrusters.share(), now);
        position.feel(sample->value, thrusters.share(), now);
        sonar.feel(sample->value, now);
      }
    }
    ahrs_port.pump(now);
    position_port.pump(now);
    if (sonar_socket) {
      sonar.exchange(*sonar_socket, now);
    }
  }

  std::string boat_segment;
  SharedBlackboard board;
  std::unique_ptr<SimLink> link = std::make_unique<SimLink>();
  WorldTask world;
  Writer<MissionStatus> mission;
  EmulatedAhrs ahrs;
  EmulatedPosition position;
  EmulatedSonar sonar;
  EmulatedThrusters thrusters;
  Writer<SimThrust> thrust;
  Reader<WorldSample> samples;
  DevicePort ahrs_port;
  DevicePort position_port;
  DevicePort thruster_port;
  std::optional<UdpSocket> sonar_socket;
  std::optional<SharedBlackboard> boat;
  std::optional<Reader<MissionStatus>> missions;
  Time mission_told{};
  Time next_look{};
  Time next_world{};
};

DeviceBench::DeviceBench(const DeviceBenchOptions& options, const Scenario& scenario, Time now)
    : impl_{std::make_unique<Impl>(options, scenario, now)} {}

DeviceBench::~DeviceBench() = default;

void DeviceBench::step(Time now) { impl_->step(now); }

std::string DeviceBench::order(const std::string& text) {
  if (text == "clear") {
    impl_->ahrs.faults().clear();
    impl_->position.faults().clear();
    impl_->sonar.faults().clear();
    impl_->thrusters.faults().clear();
    return {};
  }
  ParsedFault parsed = parse_fault(text);
  if (!parsed.fault) {
    return parsed.refusal;
  }
  const auto* sample = impl_->samples.latest();
  parsed.fault->at_s += sample != nullptr ? sample->value.scenario_time_s : 0.0;
  const Fault& fault = *parsed.fault;
  Impl& bench = *impl_;
  const bool taken =
      bench.ahrs.faults().add(fault, bench.ahrs.device(), bench.ahrs.wire()) ||
      bench.position.faults().add(fault, bench.position.device(), bench.position.wire()) ||
      (bench.sonar_socket &&
       bench.sonar.faults().add(fault, bench.sonar.device(), bench.sonar.network())) ||
      bench.thrusters.faults().add(fault, bench.thrusters.device(), bench.thrusters.wire());
  return taken ? "" : "no such fault of a device on this bench";
}

}  // namespace lodesman
