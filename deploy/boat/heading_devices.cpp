// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_contract.h"
#include "drivers/nav440/nav440.h"
#include "hal_sim/devices/sim_heading_sensor.h"

namespace lodesman {
namespace {

[[nodiscard]] DeviceAddress looped_ahrs(const std::string& address) {
  return looped_address(address, {"nav440"}, [](std::string_view) { return nav440_settings(); });
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

[[nodiscard]] bool is_exact(const std::string& address) {
  const DeviceAddress where{rest_of(address), {"like"}};
  return where.word("like", "nav440", {"nav440", "nothing"}) == "nothing";
}

void check_heading(const std::string& address) {
  const std::string scheme = scheme_of(address);
  if (scheme == "nav440") {
    check_nav440_options(nav440_options({rest_of(address), nav440_settings()}));
  } else if (scheme == "loop") {
    const DeviceAddress where = looped_ahrs(address);
    check_nav440_options(nav440_options(where));
    static_cast<void>(emulated_ahrs(where, {}, 0));
  } else {
    static_cast<void>(is_exact(address));
  }
}

}  // namespace

const DeviceContract& heading_contract() {
  static const DeviceContract kContract{
      "heading",    &DeviceAddresses::heading, false, {"sim", "loop", "nav440"}, FaultDevice::kAhrs,
      check_heading};
  return kContract;
}

std::unique_ptr<HeadingSensor> make_heading_sensor(const Workshop& shop,
                                                   const std::string& address) {
  if (is_sim(shop, address)) {
    return std::make_unique<SimHeadingSensor>(*shop.scenario, *shop.link, !is_exact(address));
  }
  const std::string scheme = scheme_of(address);
  if (scheme == "nav440") {
    const DeviceAddress where{rest_of(address), nav440_settings()};
    const Nav440Options options = nav440_options(where);
    ByteStream& line =
        real_line(shop, where.place(), options.baud, &shop.board.bell_of(TaskId::kAhrs));
    const bool gives_places = scheme_of(shop.config.devices.position) == "nav440";
    return std::make_unique<Nav440>(line, options, gives_places ? &shop.nav440_fixes : nullptr);
  }
  if (scheme == "loop") {
    const DeviceAddress where = looped_ahrs(address);
    Nav440Options options = nav440_options(where);
    const EmulatedAhrsOptions unit = emulated_ahrs(where, options, shop.scenario->seed);
    options.line_has_speed = !unit.wire.instant;
    return std::make_unique<Nav440>(shop.looped->add_ahrs(unit).near_end(), options);
  }
  return nullptr;
}

}  // namespace lodesman
