// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/roboclaw_box.h"

#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

const Bytes kDone = hex("FF");

// CRC-16/XMODEM once more, so that answers can be written down without it.
[[nodiscard]] Bytes checked_answer(const Bytes& asked, const Bytes& told) {
  unsigned crc = 0;
  for (const std::uint8_t byte : asked + told) {
    for (unsigned bit = 0x80; bit != 0; bit >>= 1U) {
      const bool out = ((crc >> 15U) & 1U) != ((byte & bit) != 0 ? 1U : 0U);
      crc = ((crc << 1U) & 0xFFFFU) ^ (out ? 0x1021U : 0U);
    }
  }
  return told + Bytes{static_cast<std::uint8_t>(crc >> 8U), static_cast<std::uint8_t>(crc & 0xFFU)};
}

struct Claw {
  RoboClawBox box;
  std::int64_t ms = 0;
  explicit Claw(const RoboClawBoxOptions& options = {}) : box{options, at_ms(0)} {}
  // Each packet after a pause.
  [[nodiscard]] Bytes says(const Bytes& sent, std::int64_t pause_ms = 20) {
    ms += pause_ms;
    return answer(box, sent, at_ms(ms));
  }
  [[nodiscard]] Bytes obeys(const char* order) { return says(checked_answer({}, hex(order))); }
  [[nodiscard]] bool tells(const char* asked, const Bytes& told) {
    return says(hex(asked)) == checked_answer(hex(asked), told);
  }
};

TEST_CASE("roboclaw: orders with their check are done and acknowledged", "[hal_sim][emulators]") {
  Claw c;
  CHECK(c.says(hex("80 00 40 73 9E")) == kDone);
  CHECK(c.box.duty(0) == 64 * 32767 / 127);
  CHECK(c.says(hex("80 22 40 00 C0 00 E0 DF")) == kDone);
  CHECK(c.box.duty(0) == 16384);
  CHECK(c.box.duty(1) == -16384);
  CHECK(c.says(hex("80 06 40 D9 38")) == kDone);
  CHECK(c.box.duty(0) == 0);
  CHECK(c.box.duty(1) == -16384);
  CHECK(c.says(hex("80 22 00 00 00 00 98 17")) == kDone);
  CHECK(c.box.duty(1) == 0);
}

TEST_CASE("roboclaw: what fails its check is not done, and not answered", "[hal_sim][emulators]") {
  Claw c;
  CHECK(c.says(hex("80 22 40 00 C0 00 E0 DE")).empty());
  CHECK(c.says(hex("81 22 40 00 C0 00 E0 DF")).empty());
  CHECK(c.says(hex("12 34 80 22 40 00 C0 00 E0 DF")) == kDone);
  CHECK(c.says(hex("80 63 00 00")).empty());  // no such command
  CHECK(c.obeys("80 00 80").empty());         // more than full
  CHECK(c.box.duty(0) == 16384);
}

TEST_CASE("roboclaw: answers at its own address, and skips packets for others whole",
          "[hal_sim][emulators]") {
  RoboClawBoxOptions options;
  options.address = 0x87;
  Claw c{options};
  CHECK(c.says(hex("80 18")).empty());
  CHECK(c.tells("87 18", hex("00 FC")));
  // Behind another's order, in one go, its own is found.
  CHECK(c.says(hex("80 22 40 00 C0 00 E0 DF") + checked_answer({}, hex("87 20 40 00"))) == kDone);
  CHECK(c.box.duty(0) == 0x4000);
  CHECK(c.box.duty(1) == 0);
}

TEST_CASE("roboclaw: every order for one motor", "[hal_sim][emulators]") {
  Claw c;
  const auto duty = [&](const char* order, std::size_t motor) {
    return c.obeys(order) == kDone ? c.box.duty(motor) : -99999;
  };
  CHECK(duty("80 00 7F", 0) == 32767);
  CHECK(duty("80 01 7F", 0) == -32767);
  CHECK(duty("80 04 7F", 1) == 32767);
  CHECK(duty("80 05 7F", 1) == -32767);
  CHECK(duty("80 06 00", 0) == -32767);
  CHECK(duty("80 06 7F", 0) == 32767);
  CHECK(duty("80 07 00", 1) == -32767);
  CHECK(duty("80 07 20", 1) == -32767 / 2);
  CHECK(duty("80 20 01 02", 0) == 0x0102);
  CHECK(duty("80 21 FF FE", 1) == -2);
  CHECK(duty("80 21 80 00", 1) == -32767);
}

TEST_CASE("roboclaw: tells what it is asked", "[hal_sim][emulators]") {
  Claw c;
  CHECK(c.says(hex("80 18")) == hex("00 FC 19 69"));
  CHECK(c.tells("80 19", hex("00 32")));
  CHECK(c.tells("80 52", hex("00 FA")));
  CHECK(c.tells("80 53", hex("00 FA")));
  CHECK(c.tells("80 5A", hex("00 00 00 00")));
  Bytes version =
      hex("55 53 42 20 52 6F 62 6F 63 6C 61 77 20 32 78 31 35 61 20 76 34 2E 31 2E 33 34");
  CHECK(c.tells("80 15", version + hex("0A 00")));
  REQUIRE(c.obeys("80 22 40 00 C0 00") == kDone);
  CHECK(c.tells("80 30", hex("40 00 C0 00")));
  CHECK(c.tells("80 31", hex("01 F4 01 F4")));  // 5 A each
  RoboClawBoxOptions older;
  older.status_bytes = 2;
  Claw old{older};
  CHECK(old.tells("80 5A", hex("00 00")));
}

TEST_CASE("roboclaw: a pause within a packet drops it", "[hal_sim][emulators]") {
  Claw c;
  CHECK(c.says(hex("80 22 40 00")).empty());
  CHECK(c.says(hex("C0 00 E0 DF"), 10) == kDone);
  CHECK(c.says(hex("80 22 00 00")).empty());
  CHECK(c.says(hex("00 00 98 17"), 11).empty());
  CHECK(c.box.duty(0) == 16384);
  CHECK(c.says(hex("80 22 00 00 00 00 98 17")) == kDone);
}

TEST_CASE("roboclaw: stops by itself when its time-out is set", "[hal_sim][emulators]") {
  Claw c;
  CHECK(c.tells("80 0F", hex("00")));
  REQUIRE(c.obeys("80 22 40 00 C0 00") == kDone);
  CHECK(said_until(c.box, at_ms(c.ms + 100'000)).empty());
  CHECK(c.box.duty(0) == 16384);
  c.ms += 100'000;
  CHECK(c.says(hex("80 0E 0A B9 1F")) == kDone);
  CHECK(c.tells("80 0F", hex("0A")));
  CHECK(said_until(c.box, at_ms(c.ms + 999)).empty());
  CHECK(c.box.duty(0) == 16384);
  CHECK(said_until(c.box, at_ms(c.ms + 1000)).empty());
  CHECK(c.box.duty(0) == 0);
  CHECK(c.box.duty(1) == 0);
  c.ms += 1000;
  REQUIRE(c.obeys("80 22 40 00 C0 00") == kDone);
  CHECK(c.box.duty(0) == 16384);
  c.box.begin_fault(box_fault(FaultKind::kNoTimeOut), at_ms(c.ms));
  CHECK(said_until(c.box, at_ms(c.ms + 9000)).empty());
  CHECK(c.box.duty(0) == 16384);
}

TEST_CASE("roboclaw: its battery sags under load", "[hal_sim][emulators]") {
  Claw c;
  REQUIRE(c.obeys("80 22 7F FF 80 01") == kDone);
  CHECK(c.tells("80 18", hex("00 ED")));  // 23.7 V
  REQUIRE(c.obeys("80 22 7F FF 00 00") == kDone);
  CHECK(c.box.battery_volts() == Approx(24.45));
  c.box.begin_fault(box_fault(FaultKind::kBattery, 0.0, 21.0), at_ms(c.ms));
  CHECK(c.box.battery_volts() == Approx(20.25));
}

TEST_CASE("roboclaw: without power, in the wrong mode, and reset", "[hal_sim][emulators]") {
  RoboClawBoxOptions options;
  options.stored_time_out_100ms = 5;
  Claw c{options};
  REQUIRE(c.says(hex("80 0E 0A B9 1F")) == kDone);
  REQUIRE(c.obeys("80 22 40 00 C0 00") == kDone);
  c.box.begin_fault(box_fault(FaultKind::kWrongMode), at_ms(c.ms));
  CHECK(c.says(hex("80 18")).empty());
  CHECK(c.box.duty(0) == 16384);
  c.box.end_fault(box_fault(FaultKind::kWrongMode), at_ms(c.ms));
  c.box.begin_fault(box_fault(FaultKind::kReset), at_ms(c.ms));
  CHECK(c.box.duty(0) == 0);
  CHECK(c.tells("80 0F", hex("05")));
  REQUIRE(c.obeys("80 22 40 00 C0 00") == kDone);
  c.box.begin_fault(box_fault(FaultKind::kPower), at_ms(c.ms));
  CHECK(c.box.duty(0) == 0);
  CHECK(c.says(hex("80 18")).empty());
  c.box.end_fault(box_fault(FaultKind::kPower), at_ms(c.ms));
  CHECK(c.box.duty(0) == 0);
  CHECK(c.says(hex("80 18")) == hex("00 FC 19 69"));
}

}  // namespace
}  // namespace lodesman
