// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/thrust_output.h"

#include <cmath>

#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using lodesman::testing::at_ms;

TEST_CASE("thrust output: the table of pulses and duties", "[hal_sim][emulators]") {
  struct Row {
    int command;
    int quarter_us;
    int duty;
  };
  for (const Row row :
       {Row{0, 4095, -32767}, Row{37, 4650, -23221}, Row{126, 5985, -258}, Row{128, 6000, 0},
        Row{129, 6015, 258}, Row{156, 6420, 7224}, Row{255, 7905, 32767}}) {
    CHECK(thrust_command_of_pulse(static_cast<std::uint16_t>(row.quarter_us)) == row.command);
    CHECK(thrust_command_of_duty(row.duty) == row.command);
  }
  CHECK(thrust_command_of_pulse(0) == 128);  // no pulses
}

TEST_CASE("thrust output: every command comes back from its pulse and its duty",
          "[hal_sim][emulators]") {
  for (int command = 0; command <= 255; ++command) {
    const int steps = command < 128 ? command - 127 : command - 128;
    const int expected = command == 127 ? 128 : command;
    CHECK(thrust_command_of_pulse(static_cast<std::uint16_t>(6000 + 15 * steps)) == expected);
    CHECK(thrust_command_of_pulse(static_cast<std::uint16_t>(6000 + 15 * steps + 7)) == expected);
    CHECK(thrust_command_of_duty(static_cast<int>(std::lround(steps * 32767.0 / 127.0))) ==
          expected);
  }
  CHECK(thrust_command_of_pulse(3968) == 0);
  CHECK(thrust_command_of_pulse(8000) == 255);
}

constexpr std::uint16_t kNeutralPulse = 6000;
constexpr std::uint16_t kAheadPulse = 7500;
constexpr std::uint16_t kAsternPulse = 4500;

TEST_CASE("thrust output: an ESC works after two seconds of neutral", "[hal_sim][emulators]") {
  EmulatedEsc esc;
  CHECK(esc.step(kAheadPulse, at_ms(0)) == 128);
  CHECK(esc.step(kNeutralPulse, at_ms(100)) == 128);
  CHECK(esc.step(kAheadPulse, at_ms(1000)) == 128);  // it begins anew
  CHECK(esc.step(kNeutralPulse + 100, at_ms(1100)) == 128);
  CHECK(esc.step(kNeutralPulse, at_ms(3099)) == 128);
  CHECK(esc.step(kAheadPulse, at_ms(3099)) == 128);
  CHECK(esc.step(kNeutralPulse, at_ms(4000)) == 128);
  CHECK(esc.step(kNeutralPulse, at_ms(6000)) == 128);
  CHECK(esc.step(kAheadPulse, at_ms(6001)) == 228);
  CHECK(esc.step(kNeutralPulse + 101, at_ms(6002)) == 135);  // beside its neutral
  CHECK(esc.step(kNeutralPulse + 100, at_ms(6003)) == 128);
  CHECK(esc.step(0, at_ms(6010)) == 128);  // no pulses: it disarms
  CHECK(esc.step(kAheadPulse, at_ms(9999)) == 128);
}

TEST_CASE("thrust output: an ESC reverses after 0.3 s of neutral, not before",
          "[hal_sim][emulators]") {
  EmulatedEsc esc;
  CHECK(esc.step(kNeutralPulse, at_ms(0)) == 128);
  CHECK(esc.step(kNeutralPulse, at_ms(2000)) == 128);
  CHECK(esc.step(kAheadPulse, at_ms(2010)) == 228);
  CHECK(esc.step(kAsternPulse, at_ms(2020)) == 128);
  CHECK(esc.step(kAsternPulse, at_ms(9000)) == 128);  // it waits for neutral
  CHECK(esc.step(kAheadPulse, at_ms(9010)) == 228);
  CHECK(esc.step(kNeutralPulse, at_ms(9020)) == 128);
  CHECK(esc.step(kAsternPulse, at_ms(9319)) == 128);
  CHECK(esc.step(kNeutralPulse, at_ms(9400)) == 128);
  CHECK(esc.step(kAsternPulse, at_ms(9700)) == 27);
  CHECK(esc.step(kNeutralPulse, at_ms(9710)) == 128);
  CHECK(esc.step(kAsternPulse, at_ms(9711)) == 27);  // the same way needs no pause
}

}  // namespace
}  // namespace lodesman
