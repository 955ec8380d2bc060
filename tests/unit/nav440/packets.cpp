// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/packets.h"

#include <cmath>
#include <fstream>
#include <iterator>

#include "mid_level/base/heading.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"
#include "tests/unit/nav440/support.h"

namespace lodesman::testing {
namespace {

using namespace nav440;  // all that this file is about

constexpr double kGravity_m_s2 = 9.80665;

// What a vector's frame decodes to; what it is a view of is kept.
template <class P>
[[nodiscard]] P packet_of(std::string_view number) {
  static ByteList kept;
  kept = kept_of(vector_bytes(number)).payload;
  const Packet packet = decoded(kept_of(vector_bytes(number)).type, kept);
  REQUIRE(std::holds_alternative<P>(packet));
  return std::get<P>(packet);
}

[[nodiscard]] bool near(double value, double expected, double within) {
  return std::abs(value - expected) <= within;
}
// Of numbers that are given to five or six digits.
[[nodiscard]] bool angles_are(const Angles& angles, double roll_deg, double pitch_deg,
                              double yaw_deg) {
  return near(to_deg(angles.roll_rad), roll_deg, 6e-5) &&
         near(to_deg(angles.pitch_rad), pitch_deg, 6e-5) &&
         near(to_deg(angles.yaw_rad), yaw_deg, 6e-5);
}
[[nodiscard]] bool rates_are(const Axes& rate_rad_s, double x_deg_s, double y_deg_s,
                             double z_deg_s) {
  return near(to_deg(rate_rad_s[0]), x_deg_s, 6e-6) && near(to_deg(rate_rad_s[1]), y_deg_s, 6e-6) &&
         near(to_deg(rate_rad_s[2]), z_deg_s, 6e-6);
}
[[nodiscard]] bool axes_are(const Axes& axes, double unit, double x, double y, double z,
                            double within = 6e-6) {
  return near(axes[0] / unit, x, within) && near(axes[1] / unit, y, within) &&
         near(axes[2] / unit, z, within);
}
[[nodiscard]] bool field_is(const Axes& field_tesla, double x_gauss, double y_gauss,
                            double z_gauss) {
  return axes_are(field_tesla, 1e-4, x_gauss, y_gauss, z_gauss);
}

TEST_CASE("nav440 packets: A-1 to A-19: requests and replies", "[nav440]") {
  CHECK(std::holds_alternative<Ping>(decoded(kPing, {})));
  const Echo echo = packet_of<Echo>("A-2");
  CHECK(std::string(echo.payload.begin(), echo.payload.end()) == "ABC");
  CHECK(packet_of<GetPacket>("A-3").wanted == kA1);
  CHECK(packet_of<GetPacket>("A-4").wanted == kIdentity);
  CHECK(packet_of<GetPacket>("A-5").wanted == kVersion);
  CHECK(packet_of<GetPacket>("A-6").wanted == kSelfTest);
  CHECK(packet_of<Nak>("A-15").refused == kSetFields);
  CHECK(packet_of<Nak>("A-16").refused == kGetPacket);
  const Version version = packet_of<Version>("A-18");
  CHECK(version.major == 20);
  CHECK(version.minor == 2);
  CHECK(version.patch == 1);
  CHECK(version.stage == 0);
  CHECK(version.build == 10);
  CHECK(packet_of<Echo>("A-19").payload.size() == 7);
  CHECK(packet_of<Echo>("A-34").payload.size() == 3);
  for (const char* number : {"A-17", "A-17a", "A-17b", "A-17c", "A-33", "A-33a"}) {
    const Kept frame = kept_of(vector_bytes(number));
    CHECK(is_known(frame.type));
    CHECK(std::holds_alternative<Unknown>(decoded(frame.type, frame.payload)));
  }
}

TEST_CASE("nav440 packets: A-7 to A-14: fields, with values and without", "[nav440]") {
  const auto set = packet_of<Fields>("A-7");
  CHECK(set.have_values());
  CHECK(set.size() == 1);
  CHECK(set.value_of(1) == 2);
  const auto reply = packet_of<Fields>("A-8");
  CHECK_FALSE(reply.have_values());
  CHECK(reply.size() == 1);
  CHECK(reply.contain(1));
  CHECK_FALSE(reply.contain(2));
  CHECK_FALSE(reply.value_of(1).has_value());
  CHECK(packet_of<Fields>("A-9").value_of(1) == 0);
  CHECK(packet_of<Fields>("A-10").value_of(3) == kA1);
  CHECK(packet_of<Fields>("A-10a").contain(3));
  CHECK(packet_of<Fields>("A-11").size() == 2);
  CHECK(packet_of<Fields>("A-11").value_of(3) == kA1);
  CHECK(packet_of<Fields>("A-12").size() == 3);
  const auto got = packet_of<Fields>("A-13");
  CHECK(got.value_of(1) == 2);
  CHECK(got.value_of(2) == 2);
  CHECK(got.value_of(3) == kA1);
  CHECK(got.id(1) == 2);
  CHECK(packet_of<Fields>("A-14").value_of(1) == 4);
  CHECK(packet_of<Fields>("A-14a").contain(1));
}

TEST_CASE("nav440 packets: a list of fields whose length is not its own is none", "[nav440]") {
  CHECK_FALSE(Fields::in({}).has_value());
  for (const ByteList& payload : {ByteList{1}, ByteList{2, 0, 1}, ByteList{1, 0, 1, 0, 2, 0, 3},
                                  ByteList{255, 0, 1}, ByteList{0, 0, 1}}) {
    CHECK_FALSE(Fields::in(payload).has_value());
    CHECK(std::holds_alternative<Unknown>(decoded(kSetFields, payload)));
  }
  CHECK(Fields::in(ByteList{0})->size() == 0);
}

TEST_CASE("nav440 packets: A-20: identity, with its closing zero and without", "[nav440]") {
  const auto identity = packet_of<Identity>("A-20");
  CHECK(identity.serial == 440123456);
  CHECK(identity.model == "NAV440 2.0.1 8350-2000");
  ByteList payload = kept_of(vector_bytes("A-20")).payload;
  payload.pop_back();
  CHECK(std::get<Identity>(decoded(kIdentity, payload)).model == "NAV440 2.0.1 8350-2000");
  CHECK(std::get<Identity>(decoded(kIdentity, ByteList{0, 0, 0, 1})).model.empty());
}

TEST_CASE("nav440 packets: F4: A-21 to A-24: A1 to the last bit", "[nav440]") {
  const A1 a21 = packet_of<A1>("A-21");
  CHECK(angles_are(a21.angles, 1.4996, -1.9995, -90.0));
  CHECK(near(compass_deg(a21.angles.yaw_rad), 270.0, 1e-9));
  CHECK(rates_are(a21.rate_rad_s, 0.49988, -0.24994, 9.99756));
  CHECK(axes_are(a21.acceleration_m_s2, kGravity_m_s2, 0.02991, -0.02014, -1.00006));
  CHECK(field_is(a21.field_tesla, 0.25, 0.0, 0.35001));
  CHECK(near(a21.rate_temperature_celsius, 31.25, 1e-9));
  CHECK(a21.time_ms == 123456789);
  CHECK(a21.bit == 0);
  const A1 a22 = packet_of<A1>("A-22");
  CHECK(angles_are(a22.angles, 0.0, 0.0, 56.2006));
  CHECK(near(a22.rate_temperature_celsius, 25.0, 1e-9));
  CHECK(a22.time_ms == 1000);
  CHECK(a22.bit == 0x1100);
  const A1 a23 = packet_of<A1>("A-23");
  CHECK(angles_are(a23.angles, 119.9982, 119.9982, 0.0));
  const A1 a24 = packet_of<A1>("A-24");
  CHECK(near(a24.angles.roll_rad, -std::numbers::pi, 0.0));
  CHECK(angles_are(a24.angles, -180.0, 179.9945, -0.0055));
  CHECK(near(compass_deg(a24.angles.yaw_rad), 359.9945, 1e-4));
  CHECK(near(to_deg(a24.rate_rad_s[2]), 629.981, 6e-4));
  CHECK(near(a24.rate_temperature_celsius, -100.0, 0.0));
  CHECK(a24.time_ms == 604799999);
  CHECK(a24.bit == 0xFFFF);
}

TEST_CASE("nav440 packets: F4: the least negative values are one bit below zero", "[nav440]") {
  ByteList payload(32, 0);
  payload[4] = payload[5] = 0xFF;  // yaw
  payload[24] = 0xFF;
  payload[25] = 0xDF;  // -33: -0.1 degrees
  const A1 packet = std::get<A1>(decoded(kA1, payload));
  CHECK(near(to_deg(packet.angles.yaw_rad), -360.0 / 65536.0, 1e-12));
  CHECK(near(packet.rate_temperature_celsius, -33.0 * 200.0 / 65536.0, 1e-12));
}

TEST_CASE("nav440 packets: A-25 and A-26: A0 and A2", "[nav440]") {
  const A0 a0 = packet_of<A0>("A-25");
  CHECK(angles_are(a0.angles, 0.0, 0.0, 90.0));
  CHECK(near(a0.rate_temperature_celsius, 20.001, 6e-4));
  CHECK(a0.time_ms == 65535);
  const A2 a2 = packet_of<A2>("A-26");
  CHECK(angles_are(a2.angles, 9.9976, -4.9988, 0.0));
  CHECK(near(to_deg(a2.rate_rad_s[2]), 2.9993, 6e-5));
  CHECK(near(a2.acceleration_m_s2[2] / kGravity_m_s2, -1.00006, 6e-6));
  CHECK(a2.rate_temperature_celsius == Axes{25.0, 25.0, 25.0});
  CHECK(a2.time_ms == 5000);
}

TEST_CASE("nav440 packets: A-27 and A-28: N0 and N1", "[nav440]") {
  const N0 n0 = packet_of<N0>("A-27");
  CHECK(angles_are(n0.angles, 0.0, 0.0, -90.0));
  CHECK(near(to_deg(n0.rate_rad_s[2]), 1.99951, 6e-6));
  CHECK(n0.place.velocity_ned_m_s == Axes{0.5, -0.25, 0.0});
  CHECK(near(n0.place.longitude_deg, 138.9, 1e-7));
  CHECK(near(n0.place.latitude_deg, 35.0272, 1e-7));
  CHECK(near(n0.place.altitude_m, 12.5, 0.0));
  CHECK(n0.time_ms == 1000);
  const N1 n1 = packet_of<N1>("A-28");
  CHECK(angles_are(n1.angles, 0.99976, 1.99951, 2.99927));
  CHECK(rates_are(n1.rate_rad_s, 0.99976, 1.99951, 2.99927));
  CHECK(axes_are(n1.acceleration_m_s2, kGravity_m_s2, 0.99976, 0.99976, 0.99976));
  CHECK(n1.place.velocity_ned_m_s == Axes{1.0, 2.0, 3.0});
  CHECK(near(n1.place.longitude_deg, 127.207868, 1e-6));
  CHECK(near(n1.place.latitude_deg, 34.609420, 1e-6));
  CHECK(near(n1.place.altitude_m, 100.0, 0.0));
  CHECK(near(n1.rate_temperature_celsius, 0.99792, 6e-6));
  CHECK(n1.time_ms == 0);
  CHECK(n1.bit == 0);
}

TEST_CASE("nav440 packets: an altitude is read by the manual's range", "[nav440]") {
  const auto altitude_m = [](std::uint8_t high, std::uint8_t low) {
    ByteList payload(32, 0);
    payload[26] = high;
    payload[27] = low;
    return std::get<N0>(decoded(kN0, payload)).place.altitude_m;
  };
  CHECK(near(altitude_m(0x00, 0x00), 0.0, 0.0));
  CHECK(near(altitude_m(0x7F, 0xFF), 8191.75, 0.0));
  CHECK(near(altitude_m(0x80, 0x00), 8192.0, 0.0));
  CHECK(near(altitude_m(0xFE, 0x70), -100.0, 0.0));
  CHECK(near(altitude_m(0xFE, 0x6F), 16283.75, 0.0));
}

TEST_CASE("nav440 packets: S0 by its layout", "[nav440]") {
  ByteList payload;
  for (std::uint8_t i = 0; i < 15; ++i) {
    payload.push_back(i);
    payload.push_back(0);
  }
  const S0 s0 = std::get<S0>(decoded(kS0, payload));
  const double step = 256.0 / 65536.0;
  CHECK(axes_are(s0.acceleration_m_s2, 20.0 * kGravity_m_s2 * step, 0, 1, 2, 1e-12));
  CHECK(axes_are(s0.rate_rad_s, to_rad(1260.0) * step, 3, 4, 5, 1e-12));
  CHECK(axes_are(s0.field_tesla, 2e-4 * step, 6, 7, 8, 1e-12));
  CHECK(axes_are(s0.rate_temperature_celsius, 200.0 * step, 9, 10, 11, 1e-12));
  CHECK(near(s0.board_temperature_celsius, 12 * 200.0 * step, 1e-12));
  CHECK(s0.time_ms == 13 * 256);
  CHECK(s0.bit == 14 * 256);
}

TEST_CASE("nav440 packets: A-29 to A-31: S1, two of them recorded", "[nav440]") {
  const S1 first = packet_of<S1>("A-29");
  CHECK(axes_are(first.acceleration_m_s2, kGravity_m_s2, -0.0098, 0.0067, 0.9961, 6e-5));
  CHECK(near(to_deg(first.rate_rad_s[1]), -0.135, 6e-4));
  CHECK(near(first.rate_temperature_celsius[0], 31.19, 6e-3));
  CHECK(near(first.board_temperature_celsius, 31.22, 6e-3));
  CHECK(first.counter == 10485);
  CHECK(first.bit == 2);
  const S1 last = packet_of<S1>("A-30");
  CHECK(axes_are(last.acceleration_m_s2, kGravity_m_s2, -0.0085, 0.0055, 0.9985, 6e-5));
  CHECK(last.counter == 13762);
  const S1 made = packet_of<S1>("A-31");
  CHECK(near(made.acceleration_m_s2[2] / kGravity_m_s2, -1.00006, 6e-6));
  CHECK(near(to_deg(made.rate_rad_s[2]), 0.99976, 6e-6));
  CHECK(near(made.board_temperature_celsius, 22.0001, 6e-5));
  CHECK(made.counter == 7);
}

TEST_CASE("nav440 packets: A-32: the self test by its words", "[nav440]") {
  const SelfTest test = packet_of<SelfTest>("A-32");
  CHECK(test.words[0] == 5);
  CHECK(test.words[4] == 2);
  CHECK(test.words[6] == 2);
  CHECK(SelfTest::kWords[6] == "com_serial_b_bit");
  CHECK(std::count(test.words.begin(), test.words.end(), 0) == 11);
}

TEST_CASE("nav440 packets: a payload of another length is of no type", "[nav440]") {
  for (const PacketType type :
       {kPing, kGetPacket, kNak, kVersion, kSelfTest, kS0, kS1, kA0, kA1, kA2, kN0, kN1}) {
    for (std::size_t size = 0; size < 256; ++size) {
      const ByteList payload(size, 0x11);
      const bool read = !std::holds_alternative<Unknown>(decoded(type, payload));
      CHECK(read == may_be_long(type, size));
      CHECK((!heading_packet(type, payload) || read));
    }
  }
}

TEST_CASE("nav440 packets: a heading comes of A0, A1, N0 and N1 alone", "[nav440]") {
  const auto of = [](const char* number) {
    const Kept frame = kept_of(vector_bytes(number));
    return heading_packet(frame.type, frame.payload);
  };
  REQUIRE(of("A-21").has_value());
  CHECK(of("A-21")->magnetic);
  CHECK(of("A-21")->time_ms == 123456789);
  CHECK(of("A-21")->time_wraps_ms == 604'800'000);
  CHECK(of("A-25")->magnetic);
  CHECK(of("A-25")->time_wraps_ms == 65536);
  CHECK_FALSE(of("A-27")->magnetic);
  CHECK(of("A-27")->time_wraps_ms == 65536);
  CHECK_FALSE(of("A-28")->magnetic);
  CHECK_FALSE(of("A-26").has_value());
  CHECK_FALSE(of("A-29").has_value());
}

TEST_CASE("nav440 packets: a recorded stream reads as a unit that lies still", "[nav440]") {
  const auto file = data_path("imu_0x5555/Scale1.raw");
  if (!file) {
    return;
  }
  std::ifstream stream{*file, std::ios::binary};
  const ByteList bytes{std::istreambuf_iterator<char>{stream}, {}};
  int read = 0;
  for (const Kept& frame : frames_in(bytes)) {
    const S1 packet = std::get<S1>(decoded(frame.type, frame.payload));
    REQUIRE(near(packet.acceleration_m_s2[2] / kGravity_m_s2, 1.0, 0.02));
    REQUIRE(near(packet.rate_rad_s[2], 0.0, 0.01));
    REQUIRE(near(packet.board_temperature_celsius, 31.0, 1.0));
    REQUIRE(packet.bit == 2);
    ++read;
  }
  CHECK(read == 1002);
}

}  // namespace
}  // namespace lodesman::testing
