// SPDX-License-Identifier: Apache-2.0
// Packets of the manual and of public recordings, to the byte from what they mean.
#include "hal_sim/emulators/nav440_packets.h"

#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman::emulated {
namespace {

using lodesman::testing::hex;

// Level, at rest, in a field as in North America, facing north.
[[nodiscard]] Nav440Values at_rest() {
  Nav440Values v;
  v.acceleration_g = {0.0, 0.0, -1.0};
  v.field_gauss = {0.25, 0.0, 0.35};
  v.rate_sensor_temperature_c.fill(25.0);
  v.board_temperature_c = 25.0;
  return v;
}

[[nodiscard]] Bytes sent(char first, char second, const Nav440Values& values) {
  const std::uint16_t type = uu_type(first, second);
  return uu_frame(type, data_payload(type, values));
}

TEST_CASE("nav440 packets: the check is the manual's", "[hal_sim][emulators]") {
  const std::string_view digits = "123456789";
  CHECK(uu_crc(Bytes{digits.begin(), digits.end()}) == 0xE5CC);
  CHECK(uu_crc(hex("50 4B 00")) == 0x9EF4);
}

TEST_CASE("nav440 packets: A1 with angles, rates, field and time", "[hal_sim][emulators]") {
  Nav440Values v = at_rest();
  v.roll_deg = 1.4996;
  v.pitch_deg = -1.9995;
  v.yaw_deg = -90.0;
  v.rate_deg_s = {0.49988, -0.24994, 9.99756};
  v.acceleration_g = {0.02991, -0.02014, -1.00006};
  v.rate_sensor_temperature_c[0] = 31.25;
  v.itow_ms = 123456789;
  CHECK(sent('A', '1', v) ==
        hex("55 55 41 31 20 01 11 FE 94 C0 00 00 1A FF F3 02 08 00 62 FF BE F3 33 20 00 00 00 2C "
            "CD 28 00 07 5B CD 15 00 00 A9 C3"));
}

TEST_CASE("nav440 packets: A1 with status bits, and with preambles for data",
          "[hal_sim][emulators]") {
  Nav440Values v = at_rest();
  v.yaw_deg = 56.2006;
  v.itow_ms = 1000;
  v.bit_status = 0x1100;
  CHECK(sent('A', '1', v) ==
        hex("55 55 41 31 20 00 00 00 00 27 F7 00 00 00 00 00 00 00 00 00 00 F3 33 20 00 00 00 2C "
            "CD 20 00 00 00 03 E8 11 00 C6 BF"));
  Nav440Values confusing = at_rest();
  confusing.roll_deg = confusing.pitch_deg = 119.9982;
  CHECK(sent('A', '1', confusing) ==
        hex("55 55 41 31 20 55 55 55 55 00 00 00 00 00 00 00 00 00 00 00 00 F3 33 20 00 00 00 2C "
            "CD 20 00 00 00 00 00 00 00 BB C0"));
}

TEST_CASE("nav440 packets: A1 at the ends of its ranges", "[hal_sim][emulators]") {
  Nav440Values v = at_rest();
  v.roll_deg = -180.0;
  v.pitch_deg = 179.9945;
  v.yaw_deg = 359.9945;
  v.rate_deg_s[2] = 700.0;  // more than it can say
  v.rate_sensor_temperature_c[0] = -100.0;
  v.itow_ms = 604799999;
  v.bit_status = 0xFFFF;
  CHECK(sent('A', '1', v) ==
        hex("55 55 41 31 20 80 00 7F FF FF FF 00 00 00 00 7F FF 00 00 00 00 F3 33 20 00 00 00 2C "
            "CD 80 00 24 0C 83 FF FF FF 72 35"));
}

TEST_CASE("nav440 packets: a rate is right to the count over the whole range",
          "[hal_sim][emulators]") {
  Nav440Values v;
  v.rate_deg_s = {315.0, -630.0, 629.98077};
  const Bytes a1 = data_payload(uu_type('A', '1'), v);
  CHECK(Bytes{a1.begin() + 6, a1.begin() + 12} == hex("40 00 80 00 7F FF"));
  const Bytes s0 = data_payload(uu_type('S', '0'), v);
  CHECK(Bytes{s0.begin() + 6, s0.begin() + 12} == hex("40 00 80 00 7F FF"));
}

TEST_CASE("nav440 packets: A0 and A2", "[hal_sim][emulators]") {
  Nav440Values a0 = at_rest();
  a0.yaw_deg = 90.0;
  a0.board_temperature_c = 20.001;
  a0.itow_ms = 65535 + 65536 * 7;
  CHECK(sent('A', '0', a0) ==
        hex("55 55 41 30 1E 00 00 00 00 40 00 00 00 00 00 00 00 00 00 00 00 F3 33 20 00 00 00 2C "
            "CD 19 9A FF FF 00 00 94 39"));
  Nav440Values a2 = at_rest();
  a2.roll_deg = 9.9976;
  a2.pitch_deg = -4.9988;
  a2.rate_deg_s[2] = 2.9993;
  a2.itow_ms = 5000;
  CHECK(sent('A', '2', a2) ==
        hex("55 55 41 32 1E 07 1C FC 72 00 00 00 00 00 00 00 9C 00 00 00 00 F3 33 20 00 20 00 20 "
            "00 00 00 13 88 00 00 3D B7"));
}

TEST_CASE("nav440 packets: N0 and N1, longitude before latitude", "[hal_sim][emulators]") {
  Nav440Values n0;
  n0.yaw_deg = 270.0;
  n0.rate_deg_s[2] = 1.99951;
  n0.velocity_m_s = {0.5, -0.25, 0.0};
  n0.longitude_deg = 138.9;
  n0.latitude_deg = 35.0272;
  n0.altitude_m = 12.5;
  n0.itow_ms = 1000;
  CHECK(sent('N', '0', n0) ==
        hex("55 55 4E 30 20 00 00 00 00 C0 00 00 00 00 00 00 68 00 40 FF E0 00 00 62 C5 F9 2C 18 "
            "E8 81 D6 00 32 03 E8 00 00 37 C1"));
  Nav440Values n1;
  n1.roll_deg = 0.99976;
  n1.pitch_deg = 1.99951;
  n1.yaw_deg = 2.99927;
  n1.rate_deg_s = {0.99976, 1.99951, 2.99927};
  n1.acceleration_g.fill(0.99976);
  n1.velocity_m_s = {1.0, 2.0, 3.0};
  n1.longitude_deg = 127.20786790;
  n1.latitude_deg = 34.60941992;
  n1.altitude_m = 100.0;
  n1.rate_sensor_temperature_c[0] = 0.99792;
  CHECK(sent('N', '1', n1) ==
        hex("55 55 4E 31 2A 00 B6 01 6C 02 22 00 34 00 68 00 9C 0C CC 0C CC 0C CC 00 80 01 00 01 "
            "80 5A 75 7C 53 18 9C 73 DF 01 90 01 47 00 00 00 00 00 00 3F 51"));
}

TEST_CASE("nav440 packets: S1 as recorded, and S0 with its field", "[hal_sim][emulators]") {
  Nav440Values v;
  v.acceleration_g = {-0.009766, 0.006714, 0.996094};
  v.rate_deg_s = {-0.038452, -0.134583, -0.019226};
  v.rate_sensor_temperature_c.fill(31.1859);
  v.board_temperature_c = 31.2225;
  v.counter = 10485;
  v.bit_status = 2;
  CHECK(sent('S', '1', v) ==
        hex("55 55 53 31 18 FF E0 00 16 0C C0 FF FE FF F9 FF FF 27 EB 27 EB 27 "
            "EB 27 F7 28 F5 00 02 23 BC"));
  v.acceleration_g = {-0.008545, 0.005493, 0.998535};
  v.rate_deg_s = {-0.115356, -0.134583, -0.038452};
  v.rate_sensor_temperature_c.fill(31.2317);
  v.board_temperature_c = 31.2408;
  v.counter = 13762;
  CHECK(sent('S', '1', v) ==
        hex("55 55 53 31 18 FF E4 00 12 0C C8 FF FA FF F9 FF FE 27 FA 27 FA 27 "
            "FA 27 FD 35 C2 00 02 C8 D6"));
  Nav440Values turning = at_rest();
  turning.rate_deg_s[2] = 0.99976;
  turning.rate_sensor_temperature_c.fill(20.001);
  turning.board_temperature_c = 21.999;
  turning.counter = 7;
  CHECK(sent('S', '1', turning) ==
        hex("55 55 53 31 18 00 00 00 00 F3 33 00 00 00 00 00 34 19 9A 19 9A 19 9A 1C 29 00 07 00 "
            "00 DC 04"));
  turning.itow_ms = 0x12345678;
  const Bytes s0 = data_payload(uu_type('S', '0'), turning);
  CHECK(s0 == hex("00 00 00 00 F3 33 00 00 00 00 00 34 20 00 00 00 2C CD 19 9A 19 9A 19 9A 1C 29 "
                  "56 78 00 00"));
}

TEST_CASE("nav440 packets: high above the sea the altitude wraps", "[hal_sim][emulators]") {
  Nav440Values v;
  v.altitude_m = 9000.0;  // 36000 counts
  const Bytes n0 = data_payload(uu_type('N', '0'), v);
  CHECK(n0[26] == 0x8C);
  CHECK(n0[27] == 0xA0);
}

TEST_CASE("nav440 packets: test and identity", "[hal_sim][emulators]") {
  Nav440BuiltInTest test;
  test.bit_status = 0x0005;
  test.com_bit = 0x0002;
  test.com_serial_b = 0x0002;
  CHECK(uu_frame(uu_type('T', '0'), test_payload(test)) ==
        hex("55 55 54 30 1C 00 05 00 00 00 00 00 00 00 02 00 00 00 02 00 00 00 00 00 00 00 00 00 "
            "00 00 00 00 00 AE AB"));
  const Nav440BuiltInTest numbered{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14};
  CHECK(test_payload(numbered) == hex("00 01 00 02 00 03 00 04 00 05 00 06 00 07 00 08 00 09 00 0A "
                                      "00 0B 00 0C 00 0D 00 0E"));
  CHECK(uu_frame(uu_type('I', 'D'), identity_payload(440123456, "NAV440 2.0.1 8350-2000")) ==
        hex("55 55 49 44 1B 1A 3B C0 40 4E 41 56 34 34 30 20 32 2E 30 2E 31 20 38 33 35 30 2D 32 "
            "30 30 30 00 10 92"));
}

}  // namespace
}  // namespace lodesman::emulated
