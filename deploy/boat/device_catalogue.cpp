// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_catalogue.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>

#include "drivers/hal/device_address.h"
#include "drivers/maestro/maestro.h"
#include "drivers/nav440/nav440.h"
#include "drivers/roboclaw/roboclaw.h"
#include "drivers/stream/make_line.h"
#include "hal_sim/devices/sim_heading_sensor.h"
#include "hal_sim/devices/sim_position_sensor.h"
#include "hal_sim/devices/sim_sonar.h"
#include "hal_sim/devices/sim_thruster_pair.h"

namespace lodesman {
namespace {

constexpr const char* kNone = "none";

// The schemes of a contract, the words after "loop:", and whether a boat may do without it.
struct Contract {
  const char* key;
  std::string DeviceAddresses::*address;
  bool optional;
  std::vector<std::string_view> schemes;
  std::vector<std::string_view> looped;
  FaultDevice faults;
};
[[nodiscard]] const std::array<Contract, kDeviceCount>& contracts() {
  static const std::array<Contract, kDeviceCount> kTable{{
      {"heading",
       &DeviceAddresses::heading,
       false,
       {"sim", "loop", "nav440"},
       {"nav440"},
       FaultDevice::kAhrs},
      {"sonar", &DeviceAddresses::sonar, false, {"sim", "delta_t"}, {}, FaultDevice::kSonar},
      {"position",
       &DeviceAddresses::position,
       true,
       {"sim", "gpsd", "nmea", "nav440"},
       {},
       FaultDevice::kPosition},
      {"thrusters",
       &DeviceAddresses::thrusters,
       true,
       {"sim", "loop", "maestro", "roboclaw"},
       {"maestro", "roboclaw"},
       FaultDevice::kThruster},
  }};
  return kTable;
}

[[nodiscard]] std::string scheme_of(const std::string& address) {
  return address.substr(0, address.find(':'));
}
[[nodiscard]] std::string rest_of(const std::string& address) {
  return address.substr(std::min(address.find(':'), address.size() - 1) + 1);
}

[[nodiscard]] bool is_known(const Contract& contract, const std::string& address) {
  return address.find(':') != std::string::npos &&
         std::find(contract.schemes.begin(), contract.schemes.end(), scheme_of(address)) !=
             contract.schemes.end();
}

[[nodiscard]] std::string not_known(const Contract& contract, const std::string& address) {
  std::string text = "\"" + address + "\" is no address of a device; known: ";
  for (const std::string_view scheme : contract.schemes) {
    text.append(scheme).append(":..., ");
  }
  return contract.optional ? text + kNone : text.substr(0, text.size() - 2);
}

// What follows "loop:" has the settings of the driver and of what stands in for the device.
constexpr std::array<std::string_view, 4> kLoopSettings{"wire", "batch_s", "flicker", "esc"};

[[nodiscard]] std::vector<std::string_view> driver_settings(std::string_view driver) {
  return driver == "nav440"     ? nav440_settings()
         : driver == "maestro"  ? maestro_settings()
         : driver == "roboclaw" ? roboclaw_settings()
                                : std::vector<std::string_view>{};
}

[[nodiscard]] DeviceAddress looped_address(const std::string& rest) {
  std::vector<std::string_view> settings =
      driver_settings(std::string_view{rest}.substr(0, rest.find('?')));
  settings.insert(settings.end(), kLoopSettings.begin(), kLoopSettings.end());
  return {rest, settings};
}

[[nodiscard]] WireSettings wire_of(const DeviceAddress& address) {
  WireSettings wire;
  wire.instant = address.word("wire", "slow", {"slow", "instant"}) == "instant";
  wire.batch = from_seconds(address.number("batch_s", 0.0, 0.0, 0.1));
  return wire;
}

[[nodiscard]] EmulatedAhrsOptions emulated_ahrs(const DeviceAddress& address,
                                                const Nav440Options& driver, std::uint64_t seed) {
  EmulatedAhrsOptions options;
  options.unit.flicker = address.word("flicker", "on", {"on", "off"}) == "on";
  options.unit.declination_deg = to_deg(driver.declination_rad);
  options.unit.seed = seed;
  options.wire = wire_of(address);
  options.seed = seed;
  return options;
}

[[nodiscard]] EmulatedThrustersOptions emulated_thrusters(const DeviceAddress& address,
                                                          Duration time_out, std::uint64_t seed) {
  EmulatedThrustersOptions options;
  options.kind =
      address.place() == "roboclaw" ? ThrusterBoxKind::kRoboClaw : ThrusterBoxKind::kMaestro;
  options.time_out = time_out;
  options.has_escs = address.word("esc", "off", {"on", "off"}) == "on";
  options.wire = wire_of(address);
  options.seed = seed;
  return options;
}

// Reads the settings of an address as its driver will, and makes nothing.
void check_settings(const std::string& scheme, const std::string& rest) {
  if (scheme == "nav440") {
    check_nav440_options(nav440_options({rest, nav440_settings()}));
  } else if (scheme == "maestro") {
    static_cast<void>(maestro_options({rest, maestro_settings()}));
  } else if (scheme == "roboclaw") {
    static_cast<void>(roboclaw_options({rest, roboclaw_settings()}));
  } else if (scheme == "sim") {
    static_cast<void>(DeviceAddress{rest, {"like"}}.word("like", "nav440", {"nav440", "nothing"}));
  }
}

void check_loop(const Contract& contract, const std::string& rest) {
  const DeviceAddress address = looped_address(rest);
  if (std::find(contract.looped.begin(), contract.looped.end(), address.place()) ==
      contract.looped.end()) {
    throw StartupError("nothing stands in for \"" + address.place() + "\" here");
  }
  static_cast<void>(wire_of(address));
  if (address.place() == "nav440") {
    check_nav440_options(nav440_options(address));
    static_cast<void>(emulated_ahrs(address, {}, 0));
  } else {
    static_cast<void>(emulated_thrusters(address, Duration{}, 0));
    static_cast<void>(address.place() == "maestro" ? maestro_options(address).time_out
                                                   : roboclaw_options(address).time_out);
  }
}

// Makes the devices of one boat. What is wrong with one is said with the place where it stands.
class Maker {
 public:
  explicit Maker(const Workshop& workshop) : shop_{workshop} {}

  [[nodiscard]] LowLevelDevices make() const {
    const DeviceAddresses& addresses = shop_.config.devices;
    LowLevelDevices devices;
    devices.heading = at("heading", addresses.heading, &Maker::heading);
    devices.sonar = at("sonar", addresses.sonar, &Maker::sonar);
    if (addresses.position != kNone) {
      devices.position = at("position", addresses.position, &Maker::position);
    }
    if (addresses.thrusters != kNone) {
      devices.thrusters = at("thrusters", addresses.thrusters, &Maker::thrusters);
    }
    return devices;
  }

 private:
  // `made` gives nothing where there is no driver.
  template <class Device>
  [[nodiscard]] std::unique_ptr<Device> at(
      const char* key, const std::string& address,
      std::unique_ptr<Device> (Maker::*made)(const std::string&) const) const {
    const TomlTable table = shop_.config.document.root().table("devices");
    try {
      if (auto device = (this->*made)(address)) {
        return device;
      }
    } catch (const StartupError& error) {
      table.refuse(key, error.what());
    }
    table.refuse(key, "there is no driver for \"" + address + "\" yet");
  }

  [[nodiscard]] bool is_sim(const std::string& address) const {
    return scheme_of(address) == "sim" && shop_.scenario != nullptr;
  }

  [[nodiscard]] std::unique_ptr<HeadingSensor> heading(const std::string& address) const {
    const std::string rest = rest_of(address);
    if (is_sim(address)) {
      const bool exact =
          DeviceAddress{rest, {"like"}}.word("like", "nav440", {"nav440", "nothing"}) == "nothing";
      return std::make_unique<SimHeadingSensor>(*shop_.scenario, *shop_.link, !exact);
    }
    if (scheme_of(address) == "nav440") {
      const DeviceAddress where{rest, nav440_settings()};
      const Nav440Options options = nav440_options(where);
      ByteStream& line =
          real_line(where.place(), options.baud, &shop_.board.bell_of(TaskId::kAhrs));
      return std::make_unique<Nav440>(line, options);
    }
    if (scheme_of(address) == "loop") {
      const DeviceAddress where = looped_address(rest);
      Nav440Options options = nav440_options(where);
      const EmulatedAhrsOptions unit = emulated_ahrs(where, options, shop_.scenario->seed);
      options.line_has_speed = !unit.wire.instant;
      return std::make_unique<Nav440>(shop_.looped->add_ahrs(unit).near_end(), options);
    }
    return nullptr;
  }

  [[nodiscard]] std::unique_ptr<ImagingSonar> sonar(const std::string& address) const {
    return is_sim(address) ? std::make_unique<SimSonar>(*shop_.scenario, *shop_.link) : nullptr;
  }

  [[nodiscard]] std::unique_ptr<PositionSensor> position(const std::string& address) const {
    return is_sim(address) ? std::make_unique<SimPositionSensor>(*shop_.scenario, *shop_.link)
                           : nullptr;
  }

  [[nodiscard]] std::unique_ptr<ThrusterPair> thrusters(const std::string& address) const {
    if (is_sim(address)) {
      return std::make_unique<SimThrusterPair>(*shop_.scenario, *shop_.link);
    }
    const std::string scheme = scheme_of(address);
    if (scheme == "maestro" || scheme == "roboclaw") {
      const DeviceAddress where{rest_of(address), driver_settings(scheme)};
      return box(scheme, where, real_line(where.place(), kUsbSpeed_baud, nullptr));
    }
    if (scheme == "loop") {
      const DeviceAddress where = looped_address(rest_of(address));
      const Duration time_out = where.place() == "maestro" ? maestro_options(where).time_out
                                                           : roboclaw_options(where).time_out;
      const auto unit = emulated_thrusters(where, time_out, shop_.scenario->seed);
      return box(where.place(), where, shop_.looped->add_thrusters(unit).near_end());
    }
    return nullptr;
  }

  [[nodiscard]] std::unique_ptr<ThrusterPair> box(const std::string& driver,
                                                  const DeviceAddress& where,
                                                  ByteStream& line) const {
    const ThrustShapeOptions& shape = shop_.config.thrust_shape;
    if (driver == "maestro") {
      return std::make_unique<Maestro>(line, maestro_options(where), shape);
    }
    return std::make_unique<RoboClaw>(line, roboclaw_options(where), shape);
  }

  // `bell`: rung when bytes have come; may be nullptr.
  [[nodiscard]] ByteStream& real_line(const std::string& path, int baud, Bell<>* bell) const {
    std::function<void()> on_bytes;
    if (bell != nullptr) {
      on_bytes = [bell] { ring(*bell); };
    }
    shop_.lines.push_back(make_line(path, baud, std::move(on_bytes)));
    return *shop_.lines.back();
  }

  // Of a port that has none, as USB's has.
  static constexpr int kUsbSpeed_baud = 115200;

  const Workshop& shop_;
};

template <class Is>
[[nodiscard]] const char* first_device(const DeviceAddresses& devices, Is is) {
  for (const Contract& contract : contracts()) {
    if (is(contract)) {
      return contract.key;
    }
  }
  static_cast<void>(devices);
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
  return first_device(devices, [&](const Contract& contract) {
    return is_simulated_address(devices.*contract.address);
  });
}

const char* real_device(const DeviceAddresses& devices) {
  return first_device(devices, [&](const Contract& contract) {
    return is_real_address(devices.*contract.address);
  });
}

const char* real_device_aboard(const DeviceAddresses& devices) {
  return first_device(devices, [&](const Contract& contract) {
    return is_real_address(devices.*contract.address) && contract.key != std::string_view{"sonar"};
  });
}

void require_addresses(const BoatConfig& config) {
  const TomlTable table = config.document.root().table("devices");
  for (const Contract& contract : contracts()) {
    const std::string& address = config.devices.*contract.address;
    if (address == kNone) {
      if (!contract.optional) {
        table.refuse(contract.key, "must not be none: no boat sails without it");
      }
      continue;
    }
    if (!is_known(contract, address)) {
      table.refuse(contract.key, not_known(contract, address));
    }
    try {
      if (scheme_of(address) == "loop") {
        check_loop(contract, rest_of(address));
      } else {
        check_settings(scheme_of(address), rest_of(address));
      }
    } catch (const StartupError& error) {
      table.refuse(contract.key, error.what());
    }
  }
}

void require_drivers(const BoatConfig& config) {
  constexpr std::array<std::string_view, 4> kToCome{"delta_t", "gpsd", "nmea", ""};
  for (const Contract& contract : contracts()) {
    const std::string& address = config.devices.*contract.address;
    const std::string scheme = scheme_of(address);
    const bool is_to_come = std::find(kToCome.begin(), kToCome.end(), scheme) != kToCome.end() ||
                            (scheme == "nav440" && contract.key == std::string_view{"position"});
    if (is_to_come) {
      config.document.root().table("devices").refuse(
          contract.key, "there is no driver for \"" + address + "\" yet");
    }
  }
}

void require_faults(const BoatConfig& config, const Scenario& scenario) {
  for (const Fault& fault : scenario.faults) {
    for (const Contract& contract : contracts()) {
      if (fault.device == contract.faults && needs_bytes(fault.kind) &&
          scheme_of(config.devices.*contract.address) == "sim") {
        config.document.root().table("devices").refuse(
            contract.key, "the scenario's fault \"" + std::string{name_of(fault.device)} + " " +
                              std::string{name_of(fault.kind)} +
                              "\" needs a device that is emulated to the byte (loop:, or lodesman "
                              "hil)");
      }
    }
  }
}

LowLevelDevices make_devices(const Workshop& workshop) { return Maker{workshop}.make(); }

}  // namespace lodesman
