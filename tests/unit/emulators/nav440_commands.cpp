// SPDX-License-Identifier: Apache-2.0
// What a NAV440 answers to the manual's commands, to the byte.
#include <algorithm>
#include <numbers>

#include "hal_sim/emulators/nav440_unit.h"
#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

const Bytes kPingBytes = hex("55 55 50 4B 00 9E F4");
const Bytes kQuiet = hex("55 55 53 46 05 01 00 01 00 00 40 81");
const Bytes kFieldsSet = hex("55 55 53 46 03 01 00 01 EF 6A");
const Bytes kNakOfSet = hex("55 55 15 15 02 53 46 6C AF");
const Bytes kNakOfGet = hex("55 55 15 15 02 47 50 D1 EF");

[[nodiscard]] Nav440UnitOptions plain() {
  Nav440UnitOptions options;
  options.packet_type = 0x4131;
  options.flicker = false;
  return options;
}

// Long switched on, quiet.
struct QuietUnit {
  Nav440Unit unit{plain(), at_ms(0), std::chrono::minutes{1}};
  QuietUnit() { REQUIRE(answer(unit, kQuiet, at_ms(1)) == kFieldsSet); }
  [[nodiscard]] Bytes says(const Bytes& sent, std::int64_t ms = 10) {
    return answer(unit, sent, at_ms(ms));
  }
};

TEST_CASE("nav440 unit: ping, its short form and echo", "[hal_sim][emulators]") {
  QuietUnit quiet;
  CHECK(quiet.says(kPingBytes) == kPingBytes);
  CHECK(quiet.says(hex("55") + kPingBytes) == kPingBytes);
  CHECK(quiet.says(hex("55 55 50 4B 00 9E F5")).empty());
  CHECK(quiet.says(kPingBytes) == kPingBytes);
  // Without length and check: known by what follows, or by the pause behind it.
  CHECK(quiet.says(hex("55 55 50 4B") + kPingBytes) == kPingBytes + kPingBytes);
  CHECK(quiet.says(hex("55 55 50 4B"), 20).empty());
  CHECK(said_until(quiet.unit, at_ms(29)).empty());
  const auto said = said_until(quiet.unit, at_ms(40));
  REQUIRE(said.size() == 1);
  CHECK(said[0].bytes == kPingBytes);
  CHECK(said[0].begins == at_ms(30));
  for (const char* echoed :
       {"55 55 43 48 03 41 42 43 24 C3", "55 55 43 48 07 55 55 50 4B 00 9E F4 A7 79",
        "55 55 43 48 03 55 55 55 53 73", "55 55 41 52 00 53 4C", "55 55 53 52 00 7E 4F"}) {
    CHECK(quiet.says(hex(echoed), 50) == hex(echoed));
  }
}

TEST_CASE("nav440 unit: a command in pieces counts within four seconds", "[hal_sim][emulators]") {
  QuietUnit quiet;
  CHECK(quiet.says(hex("55 55 43 48 03 41"), 100).empty());
  CHECK(quiet.says(hex("42 43 24 C3"), 4099) == hex("55 55 43 48 03 41 42 43 24 C3"));
  CHECK(quiet.says(hex("55 55 43 48 03 41"), 10000).empty());
  CHECK(quiet.says(hex("42 43 24 C3"), 14000).empty());
  CHECK(quiet.says(kPingBytes, 14001) == kPingBytes);
}

TEST_CASE("nav440 unit: gives each packet that it is asked for", "[hal_sim][emulators]") {
  QuietUnit quiet;
  CHECK(quiet.says(hex("55 55 47 50 02 49 44 23 3D")) ==
        hex("55 55 49 44 1B 1A 3B C0 40 4E 41 56 34 34 30 20 32 2E 30 2E 31 20 38 33 35 30 2D 32 "
            "30 30 30 00 10 92"));
  const Bytes test = quiet.says(hex("55 55 47 50 02 54 30 68 01"));
  CHECK(test.size() == 35);
  CHECK(test[3] == '0');
  CHECK(std::all_of(test.begin() + 5, test.begin() + 33, [](auto byte) { return byte == 0; }));
  for (const auto& [type, size] :
       {std::pair{0x5330, 37}, std::pair{0x5331, 31}, std::pair{0x4130, 37}, std::pair{0x4131, 39},
        std::pair{0x4132, 37}, std::pair{0x4E30, 39}, std::pair{0x4E31, 49}}) {
    const auto high = static_cast<std::uint8_t>(type >> 8);
    const auto low = static_cast<std::uint8_t>(type & 0xFF);
    const Bytes packet = quiet.says(emulated::uu_frame(0x4750, Bytes{high, low}));
    CHECK(packet.size() == static_cast<std::size_t>(size));
    CHECK(packet[2] == high);
    CHECK(packet[3] == low);
  }
  CHECK(quiet.says(hex("55 55 47 50 02 41 31 84 A6")).size() == 39);
  // It is no OEM unit, and three bytes name no packet.
  CHECK(quiet.says(emulated::uu_frame(0x4750, hex("42 31"))) == kNakOfGet);
  CHECK(quiet.says(emulated::uu_frame(0x4750, hex("41 31 00"))) == kNakOfGet);
  CHECK(quiet.says(emulated::uu_frame(0x5A5A, hex("01"))) ==
        emulated::uu_frame(0x1515, hex("5A 5A")));
  CHECK(quiet.says(emulated::uu_frame(0x4152, hex("01"))) ==
        emulated::uu_frame(0x1515, hex("41 52")));
}

TEST_CASE("nav440 unit: its version", "[hal_sim][emulators]") {
  Nav440UnitOptions options = plain();
  options.version = {20, 2, 1, 0, 10};
  Nav440Unit unit{options, at_ms(0)};
  CHECK(answer(unit, hex("55 55 47 50 02 56 52 42 87"), at_ms(1)) ==
        hex("55 55 56 52 05 14 02 01 00 0A 95 AD"));
}

TEST_CASE("nav440 unit: fields are set, told and stored", "[hal_sim][emulators]") {
  QuietUnit quiet;
  CHECK(quiet.says(hex("55 55 53 46 05 01 00 01 00 02 60 C3")) == kFieldsSet);
  CHECK(quiet.says(hex("55 55 53 46 05 01 00 03 41 31 36 6E")) ==
        hex("55 55 53 46 03 01 00 03 CF 28"));
  CHECK(quiet.says(hex("55 55 53 46 09 02 00 01 00 02 00 03 41 31 AD 90")) ==
        emulated::uu_frame(0x5346, hex("02 00 01 00 03")));
  const Bytes ask_three = hex("55 55 47 46 07 03 00 01 00 02 00 03 04 80");
  CHECK(quiet.says(ask_three) ==
        hex("55 55 47 46 0D 03 00 01 00 02 00 02 00 02 00 03 41 31 84 E5"));
  CHECK(quiet.says(hex("55 55 57 46 05 01 00 01 00 04 0F 68")) ==
        hex("55 55 57 46 03 01 00 01 E9 CB"));
  // What is stored is told apart, and counts from the next power-up on.
  CHECK(quiet.says(ask_three) ==
        hex("55 55 47 46 0D 03 00 01 00 02 00 02 00 02 00 03 41 31 84 E5"));
  CHECK(quiet.says(emulated::uu_frame(0x5246, hex("01 00 01"))) ==
        emulated::uu_frame(0x5246, hex("01 00 01 00 04")));
  quiet.unit.power_cycle(at_ms(20));
  CHECK(quiet.says(emulated::uu_frame(0x4746, hex("01 00 01")), 21) ==
        emulated::uu_frame(0x4746, hex("01 00 01 00 04")));
}

TEST_CASE("nav440 unit: of several fields the wrong ones are refused", "[hal_sim][emulators]") {
  QuietUnit quiet;
  const auto set = [&](const char* payload) {
    return quiet.says(emulated::uu_frame(0x5346, hex(payload)));
  };
  CHECK(set("02 00 0F 00 01 00 01 00 04") == kFieldsSet + kNakOfSet);
  CHECK(set("01 00 01 00 03") == kNakOfSet);  // no such divider
  CHECK(set("01 00 02 00 04") == kNakOfSet);  // no such speed
  CHECK(set("01 00 03 42 31") == kNakOfSet);  // no such packet
  CHECK(set("01 00 07 00 01") == kNakOfSet);  // no such orientation
  CHECK(set("01 00 16 00 00") == kNakOfSet);  // no such field
  CHECK(set("01 00 00 00 00") == kNakOfSet);  // no such field
  CHECK(set("01 00 14 00 04") == kNakOfSet);  // no such speed
  CHECK(set("02 00 01 00 02") == kNakOfSet);  // shorter than it says
  CHECK(set("01 00 08 00 40") == kNakOfSet);  // no such bit
  CHECK(set("01 00 07 01 6C").size() == 10);
  CHECK(set("01 00 15 12 34").size() == 10);
  CHECK(set("01 00 08 00 3F").size() == 10);
  // All four masks let everything through until they are set.
  CHECK(quiet.says(emulated::uu_frame(0x4746, hex("05 00 09 00 10 00 11 00 12 00 13"))) ==
        emulated::uu_frame(0x4746, hex("05 00 09 00 00 00 10 FF FF 00 11 FF FF 00 12 FF FF 00 13 "
                                       "FF FF")));
  CHECK(quiet.says(emulated::uu_frame(0x4746, hex("03 00 15 00 16 00 07"))) ==
        emulated::uu_frame(0x4746, hex("02 00 15 12 34 00 07 01 6C")) +
            emulated::uu_frame(0x1515, hex("47 46")));
  CHECK(quiet.says(emulated::uu_frame(0x5246, hex("02 00 15"))) ==
        emulated::uu_frame(0x1515, hex("52 46")));
}

TEST_CASE("nav440 unit: every divider, speed and orientation of the manual is taken",
          "[hal_sim][emulators]") {
  QuietUnit quiet;
  std::vector<int> dividers;
  std::vector<int> orientations;
  for (int value = 0; value < 512; ++value) {
    const auto high = static_cast<std::uint8_t>(value >> 8);
    const auto low = static_cast<std::uint8_t>(value & 0xFF);
    if (quiet.says(emulated::uu_frame(0x5746, Bytes{1, 0, 1, high, low})).size() == 10) {
      dividers.push_back(value);
    }
    if (quiet.says(emulated::uu_frame(0x5746, Bytes{1, 0, 7, high, low})).size() == 10) {
      orientations.push_back(value);
    }
  }
  // Not 1: a hundred A1 a second need more than the 38400 Bd that are stored.
  CHECK(dividers == std::vector<int>{0, 2, 4, 5, 10, 20, 25, 50});
  CHECK(orientations == std::vector<int>{0x000, 0x009, 0x023, 0x02A, 0x041, 0x048, 0x062, 0x06B,
                                         0x085, 0x08C, 0x092, 0x09B, 0x0C4, 0x0CD, 0x0D3, 0x0DA,
                                         0x111, 0x118, 0x124, 0x12D, 0x150, 0x159, 0x165, 0x16C});
  std::vector<int> bauds;
  for (std::uint8_t code = 0; code < 4; ++code) {
    REQUIRE(quiet.says(emulated::uu_frame(0x5346, Bytes{1, 0, 2, 0, code})).size() == 10);
    bauds.push_back(quiet.unit.baud());
  }
  CHECK(bauds == std::vector<int>{9600, 19200, 38400, 57600});
}

TEST_CASE("nav440 unit: what does not fit the line is refused by newer firmware alone",
          "[hal_sim][emulators]") {
  struct Row {
    std::uint8_t baud_code;
    std::uint16_t type;
    std::uint8_t divider;
    bool fits;
  };
  // From how many packets of a kind go over the line in a second.
  for (const Row row : {Row{2, 0x4131, 1, false}, Row{3, 0x4131, 1, true}, Row{2, 0x4130, 1, true},
                        Row{2, 0x4E31, 1, false}, Row{3, 0x4E31, 1, true}, Row{1, 0x4E31, 2, false},
                        Row{1, 0x4131, 2, false}, Row{1, 0x4130, 2, true}, Row{0, 0x4131, 4, false},
                        Row{0, 0x4131, 5, true}, Row{0, 0x5331, 4, true}}) {
    Nav440UnitOptions options = plain();
    options.divider = 0;
    options.baud_code = row.baud_code;
    options.packet_type = row.type;
    const Bytes set = emulated::uu_frame(0x5346, Bytes{1, 0, 1, 0, row.divider});
    INFO(int{row.baud_code} << " " << row.type << " " << int{row.divider});
    Nav440Unit newer{options, at_ms(0)};
    CHECK(answer(newer, set, at_ms(1)) == (row.fits ? kFieldsSet : kNakOfSet));
    options.newer_firmware = false;
    Nav440Unit older{options, at_ms(0)};
    CHECK(answer(older, set, at_ms(1)) == kFieldsSet);
  }
}

TEST_CASE("nav440 unit: a change of speed counts at once", "[hal_sim][emulators]") {
  QuietUnit quiet;
  CHECK(quiet.unit.baud() == 38400);
  CHECK(quiet.says(emulated::uu_frame(0x5346, hex("01 00 02 00 03"))).size() == 10);
  CHECK(quiet.unit.baud() == 57600);
  quiet.unit.power_cycle(at_ms(20));
  CHECK(quiet.unit.baud() == 38400);
}

TEST_CASE("nav440 unit: a vertical gyro has no magnetometer", "[hal_sim][emulators]") {
  Nav440UnitOptions options = plain();
  options.packet_type = 0;
  options.model = "VG440 1.0.0 8350-1000";
  Nav440Unit unit{options, at_ms(0)};
  CHECK(answer(unit, hex("55 55 47 50 02 41 31 84 A6"), at_ms(1)) == kNakOfGet);
  CHECK(answer(unit, emulated::uu_frame(0x4746, hex("01 00 03")), at_ms(1)) ==
        emulated::uu_frame(0x4746, hex("01 00 03 41 32")));
}

TEST_CASE("nav440 unit: calibration ends by itself after more than a turn",
          "[hal_sim][emulators]") {
  QuietUnit quiet;
  const Bytes stop = hex("55 55 57 43 02 00 0B A9 63");
  CHECK(quiet.says(stop) == emulated::uu_frame(0x1515, hex("57 43")));
  const Bytes by_hand = hex("55 55 57 43 02 00 09 89 21");
  CHECK(quiet.says(by_hand) == by_hand);
  CHECK(quiet.says(stop) == stop);
  const Bytes store = hex("55 55 57 43 02 00 0E F9 C6");
  CHECK(quiet.says(store) == store);
  EmulatedMotion turning;
  turning.yaw_rate_rad_s = 2.0 * std::numbers::pi / 10.0;  // a turn in 10 s
  turning.measured = at_ms(10);
  quiet.unit.set_motion(turning);
  const Bytes by_itself = hex("55 55 57 43 02 00 0C D9 84");
  CHECK(quiet.says(by_itself) == by_itself);
  CHECK(said_until(quiet.unit, at_ms(10500)).empty());  // 378 degrees
  const auto said = said_until(quiet.unit, at_ms(10600));
  REQUIRE(said.size() == 1);
  CHECK(said[0].bytes == emulated::uu_frame(0x4343, hex("00 0C 00 00 00 00 80 00")));
}

}  // namespace
}  // namespace lodesman
