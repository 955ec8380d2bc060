// SPDX-License-Identifier: Apache-2.0
// Whatever a device is sent: it goes on, and answers what it understands.
#include <random>

#include "hal_sim/emulators/maestro_box.h"
#include "hal_sim/emulators/nav440_unit.h"
#include "hal_sim/emulators/roboclaw_box.h"
#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

// Two hundred lots of anything, half of it out of bytes that mean something, each with a pause
// behind it; then what it must answer.
void survives(EmulatedDevice& device, const Bytes& telling, const Bytes& asked,
              const Bytes& answered) {
  std::mt19937 random{7};
  std::int64_t ms = 0;
  for (int lot = 0; lot < 200; ++lot) {
    Bytes sent;
    for (int i = 0; i < 300; ++i) {
      const bool tells = random() % 2 == 0;
      sent.push_back(tells ? telling[random() % telling.size()]
                           : static_cast<std::uint8_t>(random() & 0xFFU));
    }
    static_cast<void>(answer(device, sent, at_ms(ms)));
    ms += 10'000;
    REQUIRE(answer(device, asked, at_ms(ms)) == answered);
    ms += 10'000;
  }
}

TEST_CASE("any bytes: a NAV440 goes on", "[hal_sim][emulators]") {
  Nav440UnitOptions options;
  options.divider = 0;
  Nav440Unit unit{options, at_ms(0)};
  const Bytes ping = hex("55 55 50 4B 00 9E F4");
  survives(unit, hex("55 55 53 46 47 57 52 50 4B 01 02 00"), ping, ping);
}

// It has no pauses: of a command that was begun the next one makes an error, and of Mini SSC two
// bytes may be wanting.
TEST_CASE("any bytes: a Maestro goes on", "[hal_sim][emulators]") {
  std::mt19937 random{7};
  const Bytes telling = hex("84 9F AA 0C FF 90 8A 02 00");
  MaestroBoxOptions options;
  options.channels = 12;
  MaestroBox box{options, at_ms(0)};
  for (int lot = 0; lot < 200; ++lot) {
    Bytes sent;
    for (int i = 0; i < 300; ++i) {
      sent.push_back(random() % 2 == 0 ? telling[random() % telling.size()]
                                       : static_cast<std::uint8_t>(random() & 0xFFU));
    }
    static_cast<void>(answer(box, sent, at_ms(lot)));
    static_cast<void>(answer(box, hex("A1 A1 A1"), at_ms(lot)));
    REQUIRE(answer(box, hex("A1"), at_ms(lot)) == hex("00 00"));
    REQUIRE(box.pulse_quarter_us(0) <= 8000);
  }
}

TEST_CASE("any bytes: a RoboClaw goes on", "[hal_sim][emulators]") {
  RoboClawBox box{{}, at_ms(0)};
  survives(box, hex("80 87 22 06 0E 5A 18 00"), hex("80 22 00 00 00 00 98 17"), hex("FF"));
}

}  // namespace
}  // namespace lodesman
