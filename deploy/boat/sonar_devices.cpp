// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_contract.h"
#include "hal_sim/devices/sim_sonar.h"

namespace lodesman {
namespace {

void check_sonar(const std::string& address) {
  static_cast<void>(DeviceAddress{rest_of(address), {}});
}

}  // namespace

const DeviceContract& sonar_contract() {
  static const DeviceContract kContract{
      "sonar",     &DeviceAddresses::sonar, false,      {"sim", "delta_t"},
      {"delta_t"}, FaultDevice::kSonar,     check_sonar};
  return kContract;
}

std::unique_ptr<ImagingSonar> make_sonar(const Workshop& shop, const std::string& address) {
  return is_sim(shop, address) ? std::make_unique<SimSonar>(*shop.scenario, *shop.link) : nullptr;
}

}  // namespace lodesman
