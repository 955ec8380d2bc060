// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_contract.h"
#include "deploy/boat/looped_devices.h"
#include "deploy/boat/voyage.h"
#include "drivers/delta_t/delta_t.h"
#include "drivers/delta_t/ping_player.h"
#include "drivers/stream/udp_socket.h"
#include "hal_sim/devices/sim_sonar.h"

namespace lodesman {
namespace {

// A driver with the socket that it alone uses.
class DeltaTOnNetwork final : public ImagingSonar {
 public:
  DeltaTOnNetwork(const std::string& host, const DeltaTSettings& settings, Bell<>& bell)
      : socket_{{host, 0, settings.port}, [&bell] { ring(bell); }}, driver_{socket_, settings} {}

  [[nodiscard]] ReadStatus poll(Time now, SonarPing& out) noexcept override {
    return driver_.poll(now, out);
  }
  [[nodiscard]] DeviceFault fault() const noexcept override { return driver_.fault(); }

 private:
  UdpSocket socket_;
  DeltaT driver_;
};

[[nodiscard]] DeviceAddress files_at(const std::string& address) {
  DeviceAddress where{rest_of(address), ping_file_settings()};
  if (where.place().empty()) {
    throw StartupError("needs the directory of a recording: file:DIR");
  }
  return where;
}

void check_sonar(const std::string& address) {
  const std::string scheme = scheme_of(address);
  if (scheme == "loop") {
    check_looped_sonar(address);
  } else if (scheme == "delta_t") {
    static_cast<void>(delta_t_settings_in({rest_of(address), delta_t_settings()}));
  } else if (scheme == "file") {
    static_cast<void>(beam_sign_in(files_at(address)));
  } else {
    static_cast<void>(DeviceAddress{rest_of(address), {}});
  }
}

}  // namespace

const DeviceContract& sonar_contract() {
  static const DeviceContract kContract{"sonar",
                                        &DeviceAddresses::sonar,
                                        false,
                                        {"sim", "loop", "delta_t", "file"},
                                        FaultDevice::kSonar,
                                        check_sonar};
  return kContract;
}

std::unique_ptr<ImagingSonar> make_sonar(const Workshop& shop, const std::string& address) {
  if (is_sim(shop, address)) {
    Scenario scenario = *shop.scenario;
    scenario.sonar = sailed_sonar(shop.config, scenario);
    return std::make_unique<SimSonar>(scenario, *shop.link);
  }
  if (scheme_of(address) == "loop") {
    return make_looped_sonar(shop, address);
  }
  if (scheme_of(address) == "delta_t") {
    const DeviceAddress where{rest_of(address), delta_t_settings()};
    return std::make_unique<DeltaTOnNetwork>(where.place(), delta_t_settings_in(where),
                                             shop.board.bell_of(TaskId::kDeltaT));
  }
  if (scheme_of(address) == "file") {
    const DeviceAddress where = files_at(address);
    return std::make_unique<PingPlayer>(where.place(), beam_sign_in(where));
  }
  return nullptr;
}

}  // namespace lodesman
