// SPDX-License-Identifier: Apache-2.0
// What the payloads of a Crossbow NAV440 and its sisters say, in SI units: pure decoding, as the
// manual lays it out. Body axes are x forward, y right, z down; angles are Euler 3-2-1, yaw to the
// right positive. Nothing allocates; texts and lists are views of the payload. Any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

namespace lodesman::nav440 {

using Bytes = std::span<const std::uint8_t>;
// Two letters, the first in the high byte.
using PacketType = std::uint16_t;
using Axes = std::array<double, 3>;  // x, y, z

[[nodiscard]] constexpr PacketType type_of(std::string_view letters) noexcept {
  return static_cast<PacketType>((static_cast<unsigned char>(letters[0]) << 8U) |
                                 static_cast<unsigned char>(letters[1]));
}

inline constexpr PacketType kPing = type_of("PK");
inline constexpr PacketType kEcho = type_of("CH");
inline constexpr PacketType kGetPacket = type_of("GP");
inline constexpr PacketType kSetFields = type_of("SF");
inline constexpr PacketType kGetFields = type_of("GF");
inline constexpr PacketType kWriteFields = type_of("WF");
inline constexpr PacketType kReadFields = type_of("RF");
inline constexpr PacketType kIdentity = type_of("ID");
inline constexpr PacketType kVersion = type_of("VR");
inline constexpr PacketType kSelfTest = type_of("T0");
inline constexpr PacketType kS0 = type_of("S0");
inline constexpr PacketType kS1 = type_of("S1");
inline constexpr PacketType kA0 = type_of("A0");
inline constexpr PacketType kA1 = type_of("A1");
inline constexpr PacketType kA2 = type_of("A2");
inline constexpr PacketType kN0 = type_of("N0");
inline constexpr PacketType kN1 = type_of("N1");
inline constexpr PacketType kNak = 0x1515;
// By which an OpenIMU refuses what it does not know.
inline constexpr PacketType kForeignNak = 0x0000;

// Of the BIT word that every measuring packet ends with.
inline constexpr std::uint16_t kMasterFail = 0x0001;
inline constexpr std::uint16_t kErrors = 0x000E;  // hardware, communication, software
inline constexpr std::uint16_t kMasterStatus = 0x0100;

// Of the time that packets carry: milliseconds of the GPS week, whole or the low 16 bits.
inline constexpr std::uint32_t kWeek_ms = 604'800'000;
inline constexpr std::uint32_t kShortTime_ms = 65'536;

struct Angles {
  double roll_rad = 0.0;   // [-pi, pi)
  double pitch_rad = 0.0;  // [-pi, pi)
  double yaw_rad = 0.0;    // [-pi, pi) magnetic in A0 and A1, free in A2, true in N0 and N1
};

struct Unknown {};  // of no type that is decoded here
struct Ping {};
struct Echo {
  Bytes payload;
};
struct GetPacket {
  PacketType wanted = 0;
};
struct Nak {
  PacketType refused = 0;
};
struct Identity {
  std::uint32_t serial = 0;
  std::string_view model;  // model, firmware and part number, with blanks between them
};
struct Version {
  std::uint8_t major = 0, minor = 0, patch = 0;
  std::uint8_t stage = 0;  // 0 release candidate, 1 development, 2 alpha, 3 beta
  std::uint8_t build = 0;
};

// SF, WF, GF and RF, of either direction: identifiers, with their values or without.
class Fields {
 public:
  Fields() = default;
  // None where the length is not that of its number of fields.
  [[nodiscard]] static std::optional<Fields> in(Bytes payload) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool have_values() const noexcept { return stride_ == 4; }
  [[nodiscard]] std::uint16_t id(std::size_t i) const noexcept { return word(i * stride_); }
  // Only where they have values.
  [[nodiscard]] std::uint16_t value(std::size_t i) const noexcept { return word(i * stride_ + 2); }
  [[nodiscard]] bool contain(std::uint16_t id) const noexcept;
  [[nodiscard]] std::optional<std::uint16_t> value_of(std::uint16_t id) const noexcept;

 private:
  [[nodiscard]] std::uint16_t word(std::size_t at) const noexcept {
    return static_cast<std::uint16_t>((list_[at] << 8U) | list_[at + 1]);
  }
  Bytes list_;
  std::size_t size_ = 0;
  std::size_t stride_ = 2;
};

struct S0 {
  Axes acceleration_m_s2{};
  Axes rate_rad_s{};
  Axes field_tesla{};  // for a NAV440; a DMU380 counts in units of ten times the size
  Axes rate_temperature_celsius{};
  double board_temperature_celsius = 0.0;
  std::uint16_t time_ms = 0;  // low 16 bits
  std::uint16_t bit = 0;
};
struct S1 {
  Axes acceleration_m_s2{};
  Axes rate_rad_s{};
  Axes rate_temperature_celsius{};
  double board_temperature_celsius = 0.0;
  std::uint16_t counter = 0;  // of the device's clock, not of packets
  std::uint16_t bit = 0;
};
struct A0 {
  Angles angles;
  Axes rate_rad_s{};
  Axes acceleration_m_s2{};
  Axes field_tesla{};
  double rate_temperature_celsius = 0.0;
  std::uint16_t time_ms = 0;  // low 16 bits
  std::uint16_t bit = 0;
};
struct A1 {
  Angles angles;
  Axes rate_rad_s{};
  Axes acceleration_m_s2{};
  Axes field_tesla{};
  double rate_temperature_celsius = 0.0;
  std::uint32_t time_ms = 0;
  std::uint16_t bit = 0;
};
struct A2 {
  Angles angles;
  Axes rate_rad_s{};
  Axes acceleration_m_s2{};
  Axes rate_temperature_celsius{};
  std::uint32_t time_ms = 0;
  std::uint16_t bit = 0;
};
struct Place {
  Axes velocity_ned_m_s{};     // north, east, down
  double longitude_deg = 0.0;  // [-180, 180)
  double latitude_deg = 0.0;
  double altitude_m = 0.0;  // [-100, 16284)
};
struct N0 {
  Angles angles;
  Axes rate_rad_s{};
  Place place;
  std::uint16_t time_ms = 0;  // low 16 bits
  std::uint16_t bit = 0;
};
struct N1 {
  Angles angles;
  Axes rate_rad_s{};
  Axes acceleration_m_s2{};
  Place place;
  double rate_temperature_celsius = 0.0;
  std::uint32_t time_ms = 0;
  std::uint16_t bit = 0;
};

struct SelfTest {
  static constexpr std::array<std::string_view, 14> kWords{"bit_status",
                                                           "hardware_bit",
                                                           "hardware_power_bit",
                                                           "hardware_environmental_bit",
                                                           "com_bit",
                                                           "com_serial_a_bit",
                                                           "com_serial_b_bit",
                                                           "software_bit",
                                                           "software_algorithm_bit",
                                                           "software_data_bit",
                                                           "hardware_status",
                                                           "com_status",
                                                           "software_status",
                                                           "sensor_status"};
  std::array<std::uint16_t, 14> words{};
};

using Packet = std::variant<Unknown, Ping, Echo, GetPacket, Nak, Identity, Version, Fields,
                            SelfTest, S0, S1, A0, A1, A2, N0, N1>;

// Whether a payload of this type may be so long: true for every length of a type that is not known.
[[nodiscard]] bool may_be_long(PacketType type, std::size_t payload) noexcept;
// Whether it is a type of this family that is decoded here.
[[nodiscard]] bool is_known(PacketType type) noexcept;
// A type that the unit sends again and again by itself.
[[nodiscard]] bool is_continuous(PacketType type) noexcept;

// Unknown where the type is, or where the length does not fit it.
[[nodiscard]] Packet decoded(PacketType type, Bytes payload) noexcept;

// What every packet with a heading has in common.
struct HeadingPacket {
  Angles angles;
  Axes rate_rad_s{};
  bool magnetic = false;            // else its yaw is that of true north
  std::uint32_t time_ms = 0;        // [0, time_wraps_ms)
  std::uint32_t time_wraps_ms = 0;  // the time begins anew at it
  std::uint16_t bit = 0;
};
// Of A0, A1, N0 and N1; none of the others, A2 among them, whose yaw drifts freely.
[[nodiscard]] std::optional<HeadingPacket> heading_packet(PacketType type, Bytes payload) noexcept;

// The place of the device's time in such a payload: it changes where nothing else does.
struct TimeField {
  std::size_t at = 0;
  std::size_t size = 0;
};
[[nodiscard]] TimeField time_field(PacketType type) noexcept;

}  // namespace lodesman::nav440
