// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/run/simulated_boat.h"

#include "drivers/hal/registry.h"
#include "hal_sim/devices/sim_heading_sensor.h"
#include "hal_sim/devices/sim_position_sensor.h"
#include "hal_sim/devices/sim_sonar.h"
#include "hal_sim/devices/sim_thruster_pair.h"
#include "hal_sim/world/world_task.h"
#include "mid_level/runtime/task_table.h"

namespace lodesman::cli {
namespace {

// The simulated world's end of a device: "sim:" and a name that is only for people.
template <class Contract, class Device, class Link>
[[nodiscard]] std::unique_ptr<Contract> make_device(const char* contract,
                                                    const std::string& address,
                                                    const Scenario& scenario, Link& link) {
  DeviceRegistry<Contract> registry{contract};
  registry.add("sim",
               [&](std::string_view /*name*/) { return std::make_unique<Device>(scenario, link); });
  return registry.make(address);
}

[[nodiscard]] LowLevelDevices make_devices(const DeviceAddresses& addresses,
                                           const Scenario& scenario, SimLink& link) {
  LowLevelDevices devices;
  devices.heading =
      make_device<HeadingSensor, SimHeadingSensor>("heading", addresses.heading, scenario, link);
  devices.sonar = make_device<ImagingSonar, SimSonar>("sonar", addresses.sonar, scenario, link);
  devices.position = make_device<PositionSensor, SimPositionSensor>("position", addresses.position,
                                                                    scenario, link);
  devices.thrusters =
      make_device<ThrusterPair, SimThrusterPair>("thrusters", addresses.thrusters, scenario, link);
  return devices;
}

}  // namespace

struct SimulatedBoat::Impl {
  Impl(Blackboard& board, const TomlDocument& configuration, const Scenario& scenario)
      : world{scenario, load_vessel_parameters(), board, *link},
        low{board, Role::kLow, make_devices(device_addresses(configuration), scenario, *link),
            low_level_options(configuration, scenario)} {}

  std::unique_ptr<SimLink> link = std::make_unique<SimLink>();
  WorldTask world;
  LowLevel low;
};

SimulatedBoat::SimulatedBoat(Blackboard& board, const TomlDocument& configuration,
                             const Scenario& scenario)
    : impl_{std::make_unique<Impl>(board, configuration, scenario)} {}

SimulatedBoat::~SimulatedBoat() = default;

std::vector<TaskEntry> SimulatedBoat::tasks() {
  std::vector<TaskEntry> entries = impl_->low.tasks();
  entries.push_back(scheduled(TaskId::kWorld, impl_->world));
  return entries;
}

}  // namespace lodesman::cli
