// SPDX-License-Identifier: Apache-2.0
// What a NAV440 says by itself: when, what about, and how that changes with power and time.
#include <cmath>
#include <numbers>

#include "hal_sim/emulators/nav440_unit.h"
#include "mid_level/base/heading.h"
#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;
using std::chrono::seconds;

[[nodiscard]] Nav440UnitOptions streaming(std::uint16_t type = 0x4131) {
  Nav440UnitOptions options;
  options.packet_type = type;
  options.flicker = false;
  return options;
}

[[nodiscard]] int i16(const Bytes& frame, std::size_t payload_at) {
  return static_cast<std::int16_t>((frame[5 + payload_at] << 8) | frame[6 + payload_at]);
}
[[nodiscard]] std::uint32_t u32(const Bytes& frame, std::size_t payload_at) {
  return (std::uint32_t{static_cast<std::uint16_t>(i16(frame, payload_at))} << 16U) |
         static_cast<std::uint16_t>(i16(frame, payload_at + 2));
}
[[nodiscard]] double angle_deg(const Bytes& frame, std::size_t payload_at) {
  return i16(frame, payload_at) * 360.0 / 65536.0;
}

constexpr std::size_t kYawAt = 4;
constexpr std::size_t kItowAt = 26;  // in A1
constexpr std::size_t kBitAt = 30;   // in A1

TEST_CASE("nav440 unit: streams on the grid of its own start", "[hal_sim][emulators]") {
  Nav440Unit unit{streaming(), at_ms(7)};
  const auto said = said_until(unit, at_ms(107));
  REQUIRE(said.size() == 5);  // 50 Hz
  for (std::size_t i = 0; i < said.size(); ++i) {
    CHECK(said[i].begins == at_ms(7 + 20 * (static_cast<int>(i) + 1)));
    CHECK(u32(said[i].bytes, kItowAt) == 20 * (i + 1));
    CHECK(said[i].bytes.size() == 39);
  }
  // The grid stays where it is when the rate changes.
  REQUIRE(answer(unit, emulated::uu_frame(0x5346, hex("01 00 01 00 05")), at_ms(110)).size() == 10);
  const auto slower = said_until(unit, at_ms(207));
  REQUIRE(slower.size() == 2);
  CHECK(slower[0].begins == at_ms(157));
  CHECK(slower[1].begins == at_ms(207));
  REQUIRE(answer(unit, emulated::uu_frame(0x5346, hex("01 00 01 00 00")), at_ms(210)).size() == 10);
  CHECK(said_until(unit, at_ms(9000)).empty());
}

TEST_CASE("nav440 unit: its kind says what it streams", "[hal_sim][emulators]") {
  const auto streamed = [](const char* model) {
    Nav440UnitOptions options = streaming(0);
    options.model = model;
    Nav440Unit unit{options, at_ms(0)};
    const Bytes frame = said_until(unit, at_ms(20)).at(0).bytes;
    return std::string{static_cast<char>(frame[2]), static_cast<char>(frame[3])};
  };
  CHECK(streamed("NAV440 2.0.1 8350-2000") == "N1");
  CHECK(streamed("AHRS440 2.0.1 8350-1000") == "A1");
  CHECK(streamed("VG440 2.0.1 8350-0500") == "A2");
}

TEST_CASE("nav440 unit: its clock drifts, wraps, or stands", "[hal_sim][emulators]") {
  Nav440UnitOptions options = streaming();
  options.clock_drift_ppm = 1000.0;
  Nav440Unit fast{options, at_ms(0)};
  const auto said = said_until(fast, at_ms(10'000));
  CHECK(said.size() == 500);
  CHECK(u32(said.back().bytes, kItowAt) == 10'000);
  CHECK(to_seconds(said.back().begins - at_ms(0)) == Approx(10.0 / 1.001).epsilon(1e-9));
  options = streaming();
  options.itow_offset_ms = 604'799'970;
  Nav440Unit wrapping{options, at_ms(0)};
  const auto wrapped = said_until(wrapping, at_ms(40));
  CHECK(u32(wrapped.at(0).bytes, kItowAt) == 604'799'990);
  CHECK(u32(wrapped.at(1).bytes, kItowAt) == 10);
  options.constant_itow = true;
  Nav440Unit standing{options, at_ms(0)};
  CHECK(u32(said_until(standing, at_ms(400)).back().bytes, kItowAt) == 604'799'970);
}

TEST_CASE("nav440 unit: heading is magnetic in A and true in N", "[hal_sim][emulators]") {
  EmulatedMotion motion;
  motion.heading_true_rad = to_rad(100.0);
  for (const auto& [type, yaw_deg] : {std::pair{0x4131, 107.6}, std::pair{0x4130, 107.6},
                                      std::pair{0x4E31, 100.0}, std::pair{0x4E30, 100.0}}) {
    Nav440UnitOptions options = streaming(static_cast<std::uint16_t>(type));
    options.declination_deg = -7.6;
    Nav440Unit unit{options, at_ms(0)};
    unit.set_motion(motion);
    CHECK(angle_deg(said_until(unit, at_ms(20)).at(0).bytes, kYawAt) ==
          Approx(yaw_deg).margin(0.003));
  }
}

TEST_CASE("nav440 unit: what it feels, level and heeled", "[hal_sim][emulators]") {
  Nav440Unit unit{streaming(), at_ms(0)};
  EmulatedMotion motion;
  motion.heading_true_rad = to_rad(90.0);
  motion.yaw_rate_rad_s = to_rad(9.99756);
  unit.set_motion(motion);
  const Bytes level = said_until(unit, at_ms(20)).at(0).bytes;
  CHECK(i16(level, 10) == 520);  // rate of turn
  CHECK(i16(level, 12) == 0);
  CHECK(i16(level, 14) == 0);
  CHECK(i16(level, 16) == -3277);
  CHECK(i16(level, 18) == 0);      // the field is abeam,
  CHECK(i16(level, 20) == -8192);  // to port when the bow is east
  CHECK(i16(level, 22) == 11469);
  CHECK(i16(level, 24) == 8192);  // 25 degrees
  motion.roll_rad = to_rad(30.0);
  motion.pitch_rad = to_rad(10.0);
  unit.set_motion(motion);
  const Bytes heeled = said_until(unit, at_ms(40)).at(0).bytes;
  CHECK(angle_deg(heeled, 0) == Approx(30.0).margin(0.003));
  CHECK(angle_deg(heeled, 2) == Approx(10.0).margin(0.003));
  CHECK(i16(heeled, 12) == std::lround(3276.8 * std::sin(to_rad(10.0))));
  CHECK(i16(heeled, 14) == std::lround(-3276.8 * std::cos(to_rad(10.0)) * 0.5));
}

TEST_CASE("nav440 unit: place and speed go on between what it is told", "[hal_sim][emulators]") {
  Nav440Unit unit{streaming(0x4E31), at_ms(0)};
  EmulatedMotion motion;
  motion.heading_true_rad = to_rad(179.0);
  motion.yaw_rate_rad_s = to_rad(10.0);
  motion.north_m_s = -2.0;
  motion.east_m_s = 0.5;
  motion.latitude_deg = 35.0;
  motion.longitude_deg = 139.0;
  motion.measured = at_ms(100);
  unit.set_motion(motion);
  const Bytes frame = said_until(unit, at_ms(300)).back().bytes;
  CHECK(angle_deg(frame, kYawAt) == Approx(-179.0).margin(0.003));
  CHECK(i16(frame, 18) == -256);
  CHECK(i16(frame, 20) == 64);
  CHECK(i16(frame, 22) == 0);
  const double longitude_deg = static_cast<std::int32_t>(u32(frame, 24)) * 360.0 / 4294967296.0;
  const double latitude_deg = static_cast<std::int32_t>(u32(frame, 28)) * 360.0 / 4294967296.0;
  CHECK((latitude_deg - 35.0) * 111'000.0 == Approx(-0.4).epsilon(0.03));
  CHECK((longitude_deg - 139.0) * 91'000.0 == Approx(0.1).epsilon(0.1));
}

TEST_CASE("nav440 unit: after power-up it initialises, and its settings are the stored ones",
          "[hal_sim][emulators]") {
  Nav440Unit unit{streaming(), at_ms(0)};
  const auto bit = [&](std::int64_t ms) {
    return i16(said_until(unit, at_ms(ms)).back().bytes, kBitAt);
  };
  CHECK(bit(19'980) == 0x0900);
  CHECK(bit(20'020) == 0);
  REQUIRE(answer(unit, emulated::uu_frame(0x5346, hex("02 00 01 00 0A 00 03 53 31")), at_ms(20'025))
              .size() == 12);
  CHECK(said_until(unit, at_ms(20'225)).size() == 2);
  unit.power_cycle(at_ms(30'003));
  const auto said = said_until(unit, at_ms(30'043));
  REQUIRE(said.size() == 2);
  CHECK(said[0].begins == at_ms(30'023));
  CHECK(said[0].bytes[2] == 'A');
  CHECK(u32(said[0].bytes, kItowAt) == 20);
  CHECK(i16(said[0].bytes, kBitAt) == 0x0900);
  const Bytes test = answer(unit, hex("55 55 47 50 02 54 30 68 01"), at_ms(30'050));
  CHECK(i16(test, 0) == 0x0900);
  CHECK(i16(test, 24) == 0x0001);
  // Told so, it does not raise the alarm; the detail still says it.
  REQUIRE(answer(unit, emulated::uu_frame(0x5346, hex("01 00 12 00 00")), at_ms(30'060)).size() ==
          10);
  CHECK(i16(said_until(unit, at_ms(30'100)).back().bytes, kBitAt) == 0);
  // A unit that has been on for long is settled, and an algorithm reset unsettles it.
  Nav440Unit settled{streaming(), at_ms(0), seconds{60}};
  CHECK(i16(said_until(settled, at_ms(40)).back().bytes, kBitAt) == 0);
  CHECK(u32(said_until(settled, at_ms(80)).back().bytes, kItowAt) == 60'080);
  REQUIRE(answer(settled, hex("55 55 41 52 00 53 4C"), at_ms(90)).size() == 7);
  CHECK(i16(said_until(settled, at_ms(120)).back().bytes, kBitAt) == 0x0900);
}

TEST_CASE("nav440 unit: a software reset comes 10 ms after its echo", "[hal_sim][emulators]") {
  Nav440Unit unit{streaming(), at_ms(0), seconds{60}};
  REQUIRE(answer(unit, emulated::uu_frame(0x5346, hex("01 00 01 00 04")), at_ms(1)).size() == 10);
  REQUIRE(answer(unit, hex("55 55 53 52 00 7E 4F"), at_ms(100)).size() == 7);
  const auto said = said_until(unit, at_ms(150));
  REQUIRE(said.size() == 2);
  CHECK(said[0].begins == at_ms(130));
  CHECK(said[1].begins == at_ms(150));
  CHECK(u32(said[0].bytes, kItowAt) == 20);
}

TEST_CASE("nav440 unit: older firmware overflows a line that is too slow", "[hal_sim][emulators]") {
  Nav440UnitOptions options = streaming();
  options.newer_firmware = false;
  options.baud_code = 0;  // 24 A1 a second at most, and 50 are asked for
  Nav440Unit unit{options, at_ms(0), seconds{60}};
  const auto said = said_until(unit, at_ms(10'000));
  CHECK(said.size() > 240);
  CHECK(said.size() < 260);
  CHECK(i16(said.back().bytes, kBitAt) == 0x0005);
  const Bytes test = answer(unit, hex("55 55 47 50 02 54 30 68 01"), at_ms(10'001));
  CHECK(i16(test, 8) == 0x0001);
  CHECK(i16(test, 10) == 0x0001);
  // With packets that fit it is over a second after the last that was dropped.
  REQUIRE(answer(unit, emulated::uu_frame(0x5346, hex("01 00 01 00 0A")), at_ms(10'002)).size() ==
          10);
  CHECK(i16(said_until(unit, at_ms(10'900)).back().bytes, kBitAt) == 0x0005);
  CHECK(i16(said_until(unit, at_ms(11'100)).back().bytes, kBitAt) == 0);
}

// What waits there makes a heading that much older: 0.31 s at most at this speed.
TEST_CASE("nav440 unit: a line that is too slow finds 256 bytes waiting before one is dropped",
          "[hal_sim][emulators]") {
  constexpr double kBytesAMillisecond = 0.96;  // 9600 Bd
  Nav440UnitOptions options = streaming();
  options.newer_firmware = false;
  options.baud_code = 0;
  Nav440Unit unit{options, at_ms(0), seconds{60}};
  double waiting = 0.0;
  double most = 0.0;
  std::vector<double> at_drops;
  for (std::int64_t ms = 20; ms <= 4000; ms += 20) {  // 50 packets a second are asked for
    waiting = std::max(waiting - 20 * kBytesAMillisecond, 0.0);
    const auto said = said_until(unit, at_ms(ms));
    if (said.empty()) {
      at_drops.push_back(waiting);
    } else {
      waiting += static_cast<double>(said.at(0).bytes.size());
    }
    most = std::max(most, waiting);
  }
  CHECK(at_drops.size() > 90);  // about half
  for (const double bytes : at_drops) {
    CHECK(bytes > 256.0);
  }
  CHECK(most < 256.0 + 39.0 + 1.0);
  CHECK(most > 256.0);
}

TEST_CASE("nav440 unit: its last bits flicker, the same way with the same seed",
          "[hal_sim][emulators]") {
  const auto frames = [](std::uint64_t seed) {
    Nav440UnitOptions options = streaming();
    options.flicker = true;
    options.seed = seed;
    options.constant_itow = true;
    Nav440Unit unit{options, at_ms(0), seconds{60}};
    std::vector<Bytes> all;
    for (const Utterance& utterance : said_until(unit, at_ms(1000))) {
      all.push_back(utterance.bytes);
    }
    return all;
  };
  const auto one = frames(1);
  CHECK(one == frames(1));
  CHECK(one != frames(2));
  for (std::size_t i = 1; i < one.size(); ++i) {
    CHECK(one[i] != one[i - 1]);
    CHECK(std::abs(i16(one[i], 16) + 3277) <= 1);
    CHECK(std::abs(i16(one[i], 10)) <= 1);
    CHECK(i16(one[i], kYawAt) == 0);
  }
}

}  // namespace
}  // namespace lodesman
