// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_catalogue.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "deploy/boat/device_contract.h"
#include "deploy/boat/looped_devices.h"
#include "deploy/boat/voyage.h"

namespace lodesman {
namespace {

constexpr const char* kNone = "none";

[[nodiscard]] std::array<const DeviceContract*, kDeviceCount> contracts() {
  return {&heading_contract(), &sonar_contract(), &position_contract(), &thruster_contract()};
}

[[nodiscard]] bool is_one_of(const std::vector<std::string_view>& schemes,
                             const std::string& address) {
  return address.find(':') != std::string::npos &&
         std::find(schemes.begin(), schemes.end(), scheme_of(address)) != schemes.end();
}

[[nodiscard]] std::string not_known(const DeviceContract& contract, const std::string& address) {
  std::string text = "\"" + address + "\" is no address of a device; known: ";
  for (const std::string_view scheme : contract.schemes) {
    text.append(scheme).append(":..., ");
  }
  return contract.optional ? text + kNone : text.substr(0, text.size() - 2);
}

[[nodiscard]] std::string no_driver(const std::string& address) {
  return "there is no driver for \"" + address + "\" yet";
}

// What is wrong with a device is said with the place where it stands.
template <class Device>
[[nodiscard]] std::unique_ptr<Device> made(const Workshop& shop, const DeviceContract& contract,
                                           std::unique_ptr<Device> (*make)(const Workshop&,
                                                                           const std::string&)) {
  const std::string& address = shop.config.devices.*contract.address;
  if (address == kNone) {
    return nullptr;
  }
  const TomlTable table = shop.config.document.root().table("devices");
  try {
    if (auto device = make(shop, address)) {
      return device;
    }
  } catch (const StartupError& error) {
    table.refuse(contract.key, error.what());
  }
  table.refuse(contract.key, no_driver(address));
}

// Why the device at that address cannot have the fault; empty where it can.
[[nodiscard]] std::string objection_to(const Fault& fault, const std::string& address) {
  const std::string scheme = scheme_of(address);
  if (scheme == "sim" && needs_bytes(fault.device, fault.kind)) {
    return "needs a device that is emulated to the byte (loop:, or lodesman hil)";
  }
  if (scheme == "loop" && alters_pings(fault.device, fault.kind) &&
      !looped_sonar_sends_images(address)) {
    return "is one of images, and output=83P sends none";
  }
  return {};
}

template <class Is>
[[nodiscard]] const char* first_device(Is is) {
  for (const DeviceContract* contract : contracts()) {
    if (is(*contract)) {
      return contract->key;
    }
  }
  return nullptr;
}

}  // namespace

bool is_simulated_address(const std::string& address) {
  const std::string scheme = scheme_of(address);
  return scheme == "sim" || scheme == "loop";
}

bool is_real_address(const std::string& address) {
  return address != kNone && !is_simulated_address(address);
}

const char* simulated_device(const DeviceAddresses& devices) {
  return first_device([&](const DeviceContract& contract) {
    return is_simulated_address(devices.*contract.address);
  });
}

const char* real_device(const DeviceAddresses& devices) {
  return first_device(
      [&](const DeviceContract& contract) { return is_real_address(devices.*contract.address); });
}

const char* real_device_aboard(const DeviceAddresses& devices) {
  return first_device([&](const DeviceContract& contract) {
    return is_real_address(devices.*contract.address) && contract.key != std::string_view{"sonar"};
  });
}

void require_addresses(const BoatConfig& config) {
  const TomlTable table = config.document.root().table("devices");
  for (const DeviceContract* contract : contracts()) {
    const std::string& address = config.devices.*contract->address;
    if (address == kNone) {
      if (!contract->optional) {
        table.refuse(contract->key, "must not be none: no boat sails without it");
      }
      continue;
    }
    if (!is_one_of(contract->schemes, address)) {
      table.refuse(contract->key, not_known(*contract, address));
    }
    try {
      contract->check(address);
    } catch (const StartupError& error) {
      table.refuse(contract->key, error.what());
    }
  }
  try {
    require_shared_position(config.devices);
  } catch (const StartupError& error) {
    table.refuse(position_contract().key, error.what());
  }
}

void require_faults(const BoatConfig& config, const Scenario& scenario) {
  for (const Fault& fault : scenario.faults) {
    for (const DeviceContract* contract : contracts()) {
      const std::string& address = config.devices.*contract->address;
      if (fault.device != contract->faults) {
        continue;
      }
      if (const std::string no = objection_to(fault, address); !no.empty()) {
        config.document.root().table("devices").refuse(
            contract->key, "the scenario's fault \"" + std::string{name_of(fault.device)} + " " +
                               std::string{name_of(fault.kind)} + "\" " + no);
      }
    }
  }
}

void require_scene(const BoatConfig& config, const Scenario& scenario) {
  const DeviceContract& sonar = sonar_contract();
  if (sailed_sonar(config, scenario).scene == SonarScene::kDetections &&
      scheme_of(config.devices.*sonar.address) != "sim") {
    config.document.root().table("devices").refuse(
        sonar.key, "must be sim: in the scene \"detections\", which no other sonar gives");
  }
}

LowLevelDevices make_devices(const Workshop& shop) {
  LowLevelDevices devices;
  devices.heading = made(shop, heading_contract(), make_heading_sensor);
  devices.sonar = made(shop, sonar_contract(), make_sonar);
  devices.position = made(shop, position_contract(), make_position_sensor);
  devices.thrusters = made(shop, thruster_contract(), make_thrusters);
  return devices;
}

}  // namespace lodesman
