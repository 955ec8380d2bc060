// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/assembled_boat.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "drivers/hal/registry.h"
#include "hal_sim/devices/sim_heading_sensor.h"
#include "hal_sim/devices/sim_position_sensor.h"
#include "hal_sim/devices/sim_sonar.h"
#include "hal_sim/devices/sim_thruster_pair.h"
#include "hal_sim/world/world_task.h"
#include "mid_level/runtime/task_table.h"

namespace lodesman {
namespace {

constexpr const char* kNone = "none";

[[nodiscard]] bool is_simulated_address(const std::string& address) {
  const std::string scheme = address.substr(0, address.find(':'));
  return scheme == "sim" || scheme == "loop";
}

[[nodiscard]] bool is_real(const std::string& address) {
  return address != kNone && !is_simulated_address(address);
}

// The schemes of the drivers: of a scheme that stands here and has none, that is said.
struct Contract {
  const char* key;
  std::string DeviceAddresses::*address;
  bool optional;
  std::vector<std::string_view> schemes;
};
[[nodiscard]] const std::array<Contract, kDeviceCount>& contracts() {
  static const std::array<Contract, kDeviceCount> kTable{{
      {"heading", &DeviceAddresses::heading, false, {"sim", "nav440"}},
      {"sonar", &DeviceAddresses::sonar, false, {"sim", "delta_t"}},
      {"position", &DeviceAddresses::position, true, {"sim", "gpsd", "nmea", "nav440"}},
      {"thrusters", &DeviceAddresses::thrusters, true, {"sim", "maestro", "roboclaw"}},
  }};
  return kTable;
}

[[nodiscard]] const char* simulated_device(const DeviceAddresses& devices) {
  for (const Contract& contract : contracts()) {
    if (is_simulated_address(devices.*contract.address)) {
      return contract.key;
    }
  }
  return nullptr;
}

[[nodiscard]] bool is_known(const Contract& contract, const std::string& address) {
  const auto colon = address.find(':');
  return colon != std::string::npos &&
         std::find(contract.schemes.begin(), contract.schemes.end(), address.substr(0, colon)) !=
             contract.schemes.end();
}

[[nodiscard]] std::string not_known(const Contract& contract, const std::string& address) {
  std::string text = "\"" + address + "\" is no address of a device; known: ";
  for (const std::string_view scheme : contract.schemes) {
    text.append(scheme).append(":..., ");
  }
  return contract.optional ? text + kNone : text.substr(0, text.size() - 2);
}

void require_addresses(const BoatConfig& config) {
  const TomlTable table = config.document.root().table("devices");
  for (const Contract& contract : contracts()) {
    const std::string& address = config.devices.*contract.address;
    if (address == kNone && !contract.optional) {
      table.refuse(contract.key, "must not be none: no boat sails without it");
    }
    if (address != kNone && !is_known(contract, address)) {
      table.refuse(contract.key, not_known(contract, address));
    }
  }
}

// The simulated vessel has to be moved by something, and to move what is sensed.
void require_sound_vessel(const BoatConfig& config) {
  const TomlTable table = config.document.root().table("devices");
  if (config.simulation.vessel == SimulatedVessel::kThrust) {
    for (const Contract& contract : contracts()) {
      // A sonar listens round any vessel.
      if (is_real(config.devices.*contract.address) && contract.key != std::string_view{"sonar"}) {
        table.refuse(contract.key,
                     "is real, and the simulated vessel is moved by simulated thrust: set "
                     "simulation.vessel to \"estimate\"");
      }
    }
  } else if (is_simulated_address(config.devices.heading) ||
             is_simulated_address(config.devices.position)) {
    config.document.root()
        .table("simulation")
        .refuse("vessel",
                "is where the estimate is, and that would come from simulated sensors aboard it: "
                "must be \"thrust\"");
  }
}

void require_sound_position(const BoatConfig& config, const Voyage& voyage, bool has_truth) {
  const TomlTable estimator = config.document.root().table("estimator");
  const PositionSource source = voyage.position_source;
  if (source == PositionSource::kTruth && is_real(config.devices.thrusters)) {
    estimator.refuse("position_source",
                     "the truth of a simulated world must not steer real thrusters: must be gps or "
                     "dead_reckoning");
  }
  if (source == PositionSource::kTruth && !has_truth) {
    estimator.refuse("position_source",
                     "no world is simulated that would tell the truth: must be gps or "
                     "dead_reckoning");
  }
  if (config.devices.position == kNone && source != PositionSource::kDeadReckoning) {
    config.document.root().table("devices").refuse(
        "position", "is none: the position's source must be dead_reckoning, not " +
                        std::string{source == PositionSource::kGps ? "gps" : "truth"} +
                        " (estimator.position_source, or the scenario's)");
  }
}

// Makes devices of addresses. What is wrong with one is said with the place where it stands.
class Catalogue {
 public:
  Catalogue(const BoatConfig& config, const Scenario* scenario, SimLink* link)
      : config_{config}, scenario_{scenario}, link_{link} {}

  [[nodiscard]] LowLevelDevices make() const {
    const DeviceAddresses& addresses = config_.devices;
    LowLevelDevices devices;
    devices.heading = required<HeadingSensor, SimHeadingSensor>("heading", addresses.heading);
    devices.sonar = required<ImagingSonar, SimSonar>("sonar", addresses.sonar);
    devices.position = optional<PositionSensor, SimPositionSensor>("position", addresses.position);
    devices.thrusters = optional<ThrusterPair, SimThrusterPair>("thrusters", addresses.thrusters);
    return devices;
  }

 private:
  [[noreturn]] void refuse(const char* key, const std::string& reason) const {
    config_.document.root().table("devices").refuse(key, reason);
  }

  template <class Contract, class Simulated>
  [[nodiscard]] std::unique_ptr<Contract> required(const char* key,
                                                   const std::string& address) const {
    DeviceRegistry<Contract> registry{key};
    if (scenario_ != nullptr) {
      registry.add("sim", [this](std::string_view /*name*/) {
        return std::make_unique<Simulated>(*scenario_, *link_);
      });
    }
    if (!registry.knows(address)) {
      refuse(key, "there is no driver for \"" + address + "\" yet");
    }
    try {
      return registry.make(address);
    } catch (const StartupError& error) {
      refuse(key, error.what());
    }
  }

  template <class Contract, class Simulated>
  [[nodiscard]] std::unique_ptr<Contract> optional(const char* key,
                                                   const std::string& address) const {
    return address == kNone ? nullptr : required<Contract, Simulated>(key, address);
  }

  const BoatConfig& config_;
  const Scenario* scenario_;
  SimLink* link_;
};

[[nodiscard]] WorldTask::MovedBy moved_by(const BoatConfig& config) noexcept {
  return config.simulation.vessel == SimulatedVessel::kThrust ? WorldTask::MovedBy::kThrust
                                                              : WorldTask::MovedBy::kEstimate;
}

}  // namespace

bool is_simulated(const BoatConfig& config) { return simulated_device(config.devices) != nullptr; }

bool has_real_devices(const BoatConfig& config) {
  return std::any_of(contracts().begin(), contracts().end(), [&](const Contract& contract) {
    return is_real(config.devices.*contract.address);
  });
}

bool has_real_thrusters(const BoatConfig& config) { return is_real(config.devices.thrusters); }

std::optional<Scenario> simulated_scenario(const BoatConfig& config) {
  require_addresses(config);
  const TomlTable table = config.document.root().table("simulation");
  const char* simulated = simulated_device(config.devices);
  const std::string& name = config.simulation.scenario;
  if (simulated == nullptr) {
    if (!name.empty()) {
      table.refuse("scenario", "no device is simulated: there is no world for it");
    }
    if (config.simulation.vessel == SimulatedVessel::kEstimate) {
      table.refuse("vessel", "no device is simulated: there is no world for it");
    }
    return std::nullopt;
  }
  if (name.empty()) {
    table.refuse("scenario", std::string{"devices."} + simulated +
                                 " is simulated: give the scenario of its world");
  }
  return load_named_scenario(name, config.speeds);
}

void require_sound(const BoatConfig& config, const Scenario* scenario) {
  require_addresses(config);
  const bool has_truth =
      scenario != nullptr && config.simulation.vessel == SimulatedVessel::kThrust;
  if (scenario != nullptr) {
    require_sound_vessel(config);
  }
  require_sound_position(config, voyage_of(config, scenario), has_truth);
  const auto link = std::make_unique<SimLink>();
  static_cast<void>(Catalogue{config, scenario, link.get()}.make());
}

struct AssembledBoat::Impl {
  Impl(Blackboard& board, const BoatConfig& config, const Scenario* scenario)
      : low{board, Role::kLow, Catalogue{config, scenario, link.get()}.make(),
            low_level_options(config, voyage_of(config, scenario))} {
    if (scenario != nullptr) {
      world.emplace(*scenario, load_vessel_parameters(), board, *link, moved_by(config));
    }
  }

  std::unique_ptr<SimLink> link = std::make_unique<SimLink>();
  std::optional<WorldTask> world;
  LowLevel low;
};

AssembledBoat::AssembledBoat(Blackboard& board, const BoatConfig& config, const Scenario* scenario)
    : impl_{std::make_unique<Impl>(board, config, scenario)} {}

AssembledBoat::~AssembledBoat() = default;

std::vector<TaskEntry> AssembledBoat::tasks() {
  std::vector<TaskEntry> entries = impl_->low.tasks();
  if (impl_->world) {
    entries.push_back(scheduled(TaskId::kWorld, *impl_->world));
  }
  return entries;
}

}  // namespace lodesman
