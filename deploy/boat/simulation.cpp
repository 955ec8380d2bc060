// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/simulation.h"

#include "deploy/boat/configuration.h"
#include "deploy/boat/scenario_voyage.h"
#include "deploy/boat/voyage.h"
#include "drivers/hal/registry.h"
#include "hal_sim/devices/sim_heading_sensor.h"
#include "hal_sim/devices/sim_position_sensor.h"
#include "hal_sim/devices/sim_sonar.h"
#include "hal_sim/devices/sim_thruster_pair.h"
#include "hal_sim/world/world_task.h"
#include "mid_level/runtime/task_table.h"

namespace lodesman {
namespace {

// The simulated world's end of a device: "sim:" and a name that is only for people. What is wrong
// with the address is said with the place where it stands.
template <class Contract, class Device, class Link>
[[nodiscard]] std::unique_ptr<Contract> make_device(const TomlDocument& configuration,
                                                    const char* contract,
                                                    const std::string& address,
                                                    const Scenario& scenario, Link& link) {
  DeviceRegistry<Contract> registry{contract};
  registry.add("sim",
               [&](std::string_view /*name*/) { return std::make_unique<Device>(scenario, link); });
  try {
    return registry.make(address);
  } catch (const StartupError& error) {
    configuration.root().table("devices").refuse(contract, error.what());
  }
}

[[nodiscard]] LowLevelDevices make_devices(const TomlDocument& configuration,
                                           const Scenario& scenario, SimLink& link) {
  const DeviceAddresses addresses = device_addresses(configuration);
  LowLevelDevices devices;
  devices.heading = make_device<HeadingSensor, SimHeadingSensor>(configuration, "heading",
                                                                 addresses.heading, scenario, link);
  devices.sonar =
      make_device<ImagingSonar, SimSonar>(configuration, "sonar", addresses.sonar, scenario, link);
  devices.position = make_device<PositionSensor, SimPositionSensor>(
      configuration, "position", addresses.position, scenario, link);
  devices.thrusters = make_device<ThrusterPair, SimThrusterPair>(
      configuration, "thrusters", addresses.thrusters, scenario, link);
  return devices;
}

}  // namespace

struct SimulatedBoat::Impl {
  Impl(Blackboard& board, const TomlDocument& configuration, const Scenario& scenario)
      : world{scenario, load_vessel_parameters(), board, *link},
        low{board, Role::kLow, make_devices(configuration, scenario, *link),
            low_level_options(configuration, scenario)} {}

  std::unique_ptr<SimLink> link = std::make_unique<SimLink>();
  WorldTask world;
  LowLevel low;
};

void require_devices(const TomlDocument& configuration, const Scenario& scenario) {
  const auto link = std::make_unique<SimLink>();
  static_cast<void>(make_devices(configuration, scenario, *link));
}

SimulatedBoat::SimulatedBoat(Blackboard& board, const TomlDocument& configuration,
                             const Scenario& scenario)
    : impl_{std::make_unique<Impl>(board, configuration, scenario)} {}

SimulatedBoat::~SimulatedBoat() = default;

std::vector<TaskEntry> SimulatedBoat::tasks() {
  std::vector<TaskEntry> entries = impl_->low.tasks();
  entries.push_back(scheduled(TaskId::kWorld, impl_->world));
  return entries;
}

}  // namespace lodesman
