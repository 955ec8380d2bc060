// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_contract.h"
#include "deploy/boat/looped_devices.h"
#include "drivers/gpsd/gpsd_receiver.h"
#include "drivers/nav440/nav440_position.h"
#include "drivers/nav440/options.h"
#include "drivers/nmea/nmea_receiver.h"
#include "drivers/stream/make_line.h"
#include "hal_sim/devices/sim_position_sensor.h"

namespace lodesman {
namespace {

// The place of a device that is another contract's too.
constexpr const char* kOfHeading = "@heading";

void check_position(const std::string& address) {
  const std::string scheme = scheme_of(address);
  const std::string rest = rest_of(address);
  if (scheme == "nmea") {
    static_cast<void>(nmea_options({rest, nmea_settings()}));
  } else if (scheme == "gpsd") {
    static_cast<void>(gpsd_options({rest, gpsd_settings()}));
  } else if (scheme == "loop") {
    check_looped_position(address);
  } else if (scheme == "nav440") {
    if (rest != kOfHeading) {
      throw StartupError(std::string{"must be nav440:"} + kOfHeading +
                         ": the unit is heading's, and its settings stand there");
    }
  } else {
    static_cast<void>(DeviceAddress{rest, {}});
  }
}

}  // namespace

const DeviceContract& position_contract() {
  static const DeviceContract kContract{"position",
                                        &DeviceAddresses::position,
                                        true,
                                        {"sim", "loop", "gpsd", "nmea", "nav440"},
                                        FaultDevice::kPosition,
                                        check_position};
  return kContract;
}

void require_shared_position(const DeviceAddresses& devices) {
  if (scheme_of(devices.position) != "nav440") {
    return;
  }
  if (scheme_of(devices.heading) != "nav440") {
    throw StartupError("needs devices.heading to be a nav440: too, not \"" + devices.heading +
                       "\"");
  }
  const Nav440Packet packet = nav440_options({rest_of(devices.heading), nav440_settings()}).packet;
  if (packet != Nav440Packet::kN0 && packet != Nav440Packet::kN1) {
    throw StartupError("needs packet=N1 or packet=N0 in devices.heading: no other has a place");
  }
}

std::unique_ptr<PositionSensor> make_position_sensor(const Workshop& shop,
                                                     const std::string& address) {
  if (is_sim(shop, address)) {
    return std::make_unique<SimPositionSensor>(*shop.scenario, *shop.link);
  }
  const std::string scheme = scheme_of(address);
  Bell<>* bell = &shop.board.bell_of(TaskId::kPosition);
  if (scheme == "nmea") {
    const DeviceAddress where{rest_of(address), nmea_settings()};
    const NmeaOptions options = nmea_options(where);
    return std::make_unique<NmeaReceiver>(real_line(shop, where.place(), options.baud, bell),
                                          options);
  }
  if (scheme == "gpsd") {
    const GpsdOptions options = gpsd_options({rest_of(address), gpsd_settings()});
    shop.lines.push_back(make_tcp_line(options.place, [bell] { ring(*bell); }));
    return std::make_unique<GpsdReceiver>(*shop.lines.back(), options);
  }
  if (scheme == "nav440") {
    return std::make_unique<Nav440Position>(shop.nav440_fixes);
  }
  return scheme == "loop" ? make_looped_position(shop, address) : nullptr;
}

}  // namespace lodesman
