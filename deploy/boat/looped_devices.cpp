// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/looped_devices.h"

#include "drivers/delta_t/delta_t.h"
#include "drivers/nmea/nmea_receiver.h"

namespace lodesman {
namespace {

// The world's step, at which a looped sonar's records leave: they are as old then as they say.
constexpr Duration kWorldPeriod = std::chrono::milliseconds{20};
// Slower lines do not hold five fixes a second.
constexpr int kFastLine_baud = 19200;

[[nodiscard]] DeviceAddress stand_in(const std::string& address, const char* device,
                                     std::vector<std::string_view> settings,
                                     std::initializer_list<std::string_view> more) {
  const std::string rest = rest_of(address);
  const std::string named = rest.substr(0, rest.find('?'));
  if (named != device) {
    throw StartupError("nothing stands in for \"" + named + "\" here");
  }
  settings.insert(settings.end(), more);
  return {rest, settings};
}

[[nodiscard]] DeviceAddress looped_receiver(const std::string& address) {
  return stand_in(address, "nmea", nmea_settings(), {"wire", "batch_s"});
}
[[nodiscard]] DeviceAddress looped_sonar(const std::string& address) {
  return stand_in(address, "delta_t", delta_t_settings(), {"wire"});
}
[[nodiscard]] bool is_instant(const DeviceAddress& address) {
  return address.word("wire", "slow", {"slow", "instant"}) == "instant";
}

}  // namespace

void check_looped_position(const std::string& address) {
  const DeviceAddress where = looped_receiver(address);
  static_cast<void>(nmea_options(where));
  static_cast<void>(wire_of(where));
}

void check_looped_sonar(const std::string& address) {
  const DeviceAddress where = looped_sonar(address);
  static_cast<void>(delta_t_settings_in(where));
  static_cast<void>(is_instant(where));
}

bool looped_sonar_sends_images(const std::string& address) {
  const DeltaTSettings settings = delta_t_settings_in(looped_sonar(address));
  return !settings.controls || settings.control.output == delta_t::RecordKind::kImage;
}

std::unique_ptr<PositionSensor> make_looped_position(const Workshop& shop,
                                                     const std::string& address) {
  const DeviceAddress where = looped_receiver(address);
  const NmeaOptions options = nmea_options(where);
  EmulatedPositionOptions unit = emulated_position_options(*shop.scenario);
  unit.wire = wire_of(where);
  unit.receiver.baud = options.baud;
  if (options.baud < kFastLine_baud) {
    unit.receiver.period = std::chrono::seconds{1};
  }
  if (unit.wire.instant) {
    unit.receiver.latency = Duration::zero();
  }
  return std::make_unique<NmeaReceiver>(shop.looped->add_position(unit).near_end(), options);
}

std::unique_ptr<ImagingSonar> make_looped_sonar(const Workshop& shop, const std::string& address) {
  const DeviceAddress where = looped_sonar(address);
  EmulatedSonarOptions unit = emulated_sonar_options(*shop.scenario);
  unit.program.instant = is_instant(where);
  unit.program.leaves_at_multiples_of = kWorldPeriod;
  return std::make_unique<DeltaT>(shop.looped->add_sonar(unit).near_end(),
                                  delta_t_settings_in(where));
}

}  // namespace lodesman
