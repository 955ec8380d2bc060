// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_contract.h"
#include "drivers/maestro/maestro.h"
#include "drivers/roboclaw/roboclaw.h"
#include "hal_sim/devices/sim_thruster_pair.h"

namespace lodesman {
namespace {

// Of a port that has none, as USB's has.
constexpr int kUsbSpeed_baud = 115200;

[[nodiscard]] std::vector<std::string_view> settings_of(std::string_view driver) {
  return driver == "maestro" ? maestro_settings() : roboclaw_settings();
}

[[nodiscard]] DeviceAddress looped_box(const std::string& address) {
  return looped_address(address, {"maestro", "roboclaw"}, settings_of);
}

[[nodiscard]] Duration time_out_of(const std::string& driver, const DeviceAddress& where) {
  return driver == "maestro" ? maestro_options(where).time_out : roboclaw_options(where).time_out;
}

[[nodiscard]] EmulatedThrustersOptions emulated_thrusters(const DeviceAddress& address,
                                                          std::uint64_t seed) {
  EmulatedThrustersOptions options;
  options.kind =
      address.place() == "roboclaw" ? ThrusterBoxKind::kRoboClaw : ThrusterBoxKind::kMaestro;
  options.time_out = time_out_of(address.place(), address);
  options.has_escs = address.word("esc", "off", {"on", "off"}) == "on";
  options.wire = wire_of(address);
  options.seed = seed;
  return options;
}

void check_thruster(const std::string& address) {
  const std::string scheme = scheme_of(address);
  if (scheme == "loop") {
    static_cast<void>(emulated_thrusters(looped_box(address), 0));
  } else if (scheme == "maestro" || scheme == "roboclaw") {
    static_cast<void>(time_out_of(scheme, {rest_of(address), settings_of(scheme)}));
  } else {
    static_cast<void>(DeviceAddress{rest_of(address), {}});
  }
}

[[nodiscard]] std::unique_ptr<ThrusterPair> box(const Workshop& shop, const std::string& driver,
                                                const DeviceAddress& where, ByteStream& line) {
  const ThrustShapeOptions& shape = shop.config.thrust_shape;
  if (driver == "maestro") {
    return std::make_unique<Maestro>(line, maestro_options(where), shape);
  }
  return std::make_unique<RoboClaw>(line, roboclaw_options(where), shape);
}

}  // namespace

const DeviceContract& thruster_contract() {
  static const DeviceContract kContract{"thrusters",
                                        &DeviceAddresses::thrusters,
                                        true,
                                        {"sim", "loop", "maestro", "roboclaw"},
                                        FaultDevice::kThruster,
                                        check_thruster};
  return kContract;
}

std::unique_ptr<ThrusterPair> make_thrusters(const Workshop& shop, const std::string& address) {
  if (is_sim(shop, address)) {
    return std::make_unique<SimThrusterPair>(*shop.scenario, *shop.link);
  }
  const std::string scheme = scheme_of(address);
  if (scheme == "maestro" || scheme == "roboclaw") {
    const DeviceAddress where{rest_of(address), settings_of(scheme)};
    return box(shop, scheme, where, real_line(shop, where.place(), kUsbSpeed_baud, nullptr));
  }
  if (scheme == "loop") {
    const DeviceAddress where = looped_box(address);
    const auto unit = emulated_thrusters(where, shop.scenario->seed);
    return box(shop, where.place(), where, shop.looped->add_thrusters(unit).near_end());
  }
  return nullptr;
}

}  // namespace lodesman
