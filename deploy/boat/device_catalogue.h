// SPDX-License-Identifier: Apache-2.0
// Every kind of device that an address can name, which of them go together, and how each is made:
// the only place that joins a driver with what stands in for its device. Made before any task runs;
// everything that is wrong throws StartupError with its place in the configuration.
#pragma once

#include <memory>
#include <vector>

#include "deploy/boat/configuration.h"
#include "drivers/nav440/fix_relay.h"
#include "drivers/stream/byte_stream.h"
#include "hal_sim/emulators/looped_world.h"
#include "hal_sim/scenario/scenario.h"

namespace lodesman {

// "sim:" or "loop:", whose world is simulated in lodesman-low.
[[nodiscard]] bool is_simulated_address(const std::string& address);
// Neither that nor "none".
[[nodiscard]] bool is_real_address(const std::string& address);

// The key of the first device that is simulated, or that is real; nullptr where none is.
[[nodiscard]] const char* simulated_device(const DeviceAddresses& devices);
[[nodiscard]] const char* real_device(const DeviceAddresses& devices);
// The first real device that moves with the vessel; a sonar listens round any.
[[nodiscard]] const char* real_device_aboard(const DeviceAddresses& devices);

// Refuses what is no address, or has settings that its driver cannot have. Opens nothing.
void require_addresses(const BoatConfig& config);
// Refuses faults that a device as simulated here cannot have.
void require_faults(const BoatConfig& config, const Scenario& scenario);
// Refuses a scene that the sonar cannot give.
void require_scene(const BoatConfig& config, const Scenario& scenario);

// What the devices are made of. Lines and relay must outlive them.
struct Workshop {
  const BoatConfig& config;
  Blackboard& board;
  const Scenario* scenario = nullptr;  // of the simulated world, where there is one
  SimLink* link = nullptr;
  LoopedWorld* looped = nullptr;
  std::vector<std::unique_ptr<ByteStream>>& lines;
  Nav440FixRelay& nav440_fixes;  // from the heading's device to the position's
};
[[nodiscard]] LowLevelDevices make_devices(const Workshop& workshop);

}  // namespace lodesman
