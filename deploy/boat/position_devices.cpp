// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_contract.h"
#include "hal_sim/devices/sim_position_sensor.h"

namespace lodesman {
namespace {

void check_position(const std::string& address) {
  static_cast<void>(DeviceAddress{rest_of(address), {}});
}

}  // namespace

const DeviceContract& position_contract() {
  static const DeviceContract kContract{"position",
                                        &DeviceAddresses::position,
                                        true,
                                        {"sim", "gpsd", "nmea", "nav440"},
                                        {"gpsd", "nmea", "nav440"},
                                        FaultDevice::kPosition,
                                        check_position};
  return kContract;
}

std::unique_ptr<PositionSensor> make_position_sensor(const Workshop& shop,
                                                     const std::string& address) {
  return is_sim(shop, address) ? std::make_unique<SimPositionSensor>(*shop.scenario, *shop.link)
                               : nullptr;
}

}  // namespace lodesman
