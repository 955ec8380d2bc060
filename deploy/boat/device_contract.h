// SPDX-License-Identifier: Apache-2.0
// What each of the four contracts has to say of its devices: which addresses there are, what must
// hold for their settings, and how one is made. Used by the device catalogue alone.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "deploy/boat/device_catalogue.h"
#include "drivers/hal/device_address.h"
#include "hal_sim/emulators/wire.h"

namespace lodesman {

struct DeviceContract {
  const char* key;  // in [devices]
  std::string DeviceAddresses::*address;
  bool optional;                          // a boat may do without it
  std::vector<std::string_view> schemes;  // of its addresses
  FaultDevice faults;
  // Reads the settings of an address as its driver will, and makes nothing. Throws StartupError.
  void (*check)(const std::string& address);
};

[[nodiscard]] const DeviceContract& heading_contract();
[[nodiscard]] const DeviceContract& sonar_contract();
[[nodiscard]] const DeviceContract& position_contract();
[[nodiscard]] const DeviceContract& thruster_contract();

// Refuses a position from heading's device where that has none to give.
void require_shared_position(const DeviceAddresses& devices);

// nullptr where there is no driver. Throws StartupError.
[[nodiscard]] std::unique_ptr<HeadingSensor> make_heading_sensor(const Workshop& shop,
                                                                 const std::string& address);
[[nodiscard]] std::unique_ptr<ImagingSonar> make_sonar(const Workshop& shop,
                                                       const std::string& address);
[[nodiscard]] std::unique_ptr<PositionSensor> make_position_sensor(const Workshop& shop,
                                                                   const std::string& address);
[[nodiscard]] std::unique_ptr<ThrusterPair> make_thrusters(const Workshop& shop,
                                                           const std::string& address);

// Before and after the colon.
[[nodiscard]] std::string scheme_of(const std::string& address);
[[nodiscard]] std::string rest_of(const std::string& address);
// It is simulated in this process, whose world stands.
[[nodiscard]] bool is_sim(const Workshop& shop, const std::string& address);

// What follows "loop:" has the settings of the driver and of what stands in for the device. Refuses
// a device that nothing stands in for.
[[nodiscard]] DeviceAddress looped_address(
    const std::string& address, const std::vector<std::string_view>& known,
    std::vector<std::string_view> (*settings)(std::string_view driver));
[[nodiscard]] WireSettings wire_of(const DeviceAddress& address);

// `bell`: rung when bytes have come; may be nullptr.
[[nodiscard]] ByteStream& real_line(const Workshop& shop, const std::string& path, int baud,
                                    Bell<>* bell);

}  // namespace lodesman
