// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/packets.h"

#include <algorithm>
#include <numbers>

namespace lodesman::nav440 {
namespace {

// The whole range of a raw number spans so much: the manual's scalings.
constexpr double kWord = 65536.0;
constexpr double kLongWord = 4294967296.0;
constexpr double kGravity_m_s2 = 9.80665;
constexpr double kTeslaOfGauss = 1e-4;
constexpr double kAngle_rad = 2.0 * std::numbers::pi / kWord;
constexpr double kRate_rad_s = 7.0 * std::numbers::pi / kWord;
constexpr double kAcceleration_m_s2 = 20.0 * kGravity_m_s2 / kWord;
constexpr double kField_tesla = 2.0 * kTeslaOfGauss / kWord;
constexpr double kTemperature_celsius = 200.0 / kWord;
constexpr double kVelocity_m_s = 512.0 / kWord;
constexpr double kPlace_deg = 360.0 / kLongWord;
constexpr double kAltitude_m = 16384.0 / kWord;
constexpr double kLeastAltitude_m = -100.0;
constexpr double kAltitudeSpan_m = 16384.0;

// Every multi-byte number has its high byte first. Whoever makes one has seen to the length.
class PayloadReader {
 public:
  explicit PayloadReader(Bytes payload) noexcept : left_{payload} {}

  [[nodiscard]] std::uint8_t byte() noexcept {
    const std::uint8_t value = left_.front();
    left_ = left_.subspan(1);
    return value;
  }
  [[nodiscard]] std::uint16_t word() noexcept {
    const unsigned high = byte();
    return static_cast<std::uint16_t>((high << 8U) | byte());
  }
  [[nodiscard]] std::uint32_t long_word() noexcept {
    const std::uint32_t high = word();
    return (high << 16U) | word();
  }
  [[nodiscard]] double scaled(double factor) noexcept {
    return factor * static_cast<double>(static_cast<std::int16_t>(word()));
  }
  [[nodiscard]] Axes axes(double factor) noexcept {
    const double x = scaled(factor);
    const double y = scaled(factor);
    return {x, y, scaled(factor)};
  }
  [[nodiscard]] Angles angles() noexcept {
    const Axes three = axes(kAngle_rad);
    return {three[0], three[1], three[2]};
  }
  [[nodiscard]] double degrees() noexcept {
    return kPlace_deg * static_cast<double>(static_cast<std::int32_t>(long_word()));
  }
  [[nodiscard]] Place place() noexcept {
    Place place;
    place.velocity_ned_m_s = axes(kVelocity_m_s);
    place.longitude_deg = degrees();
    place.latitude_deg = degrees();
    place.altitude_m = scaled(kAltitude_m);
    // The manual's range is -100 to 16284 m, the upper part of which reads as negative.
    if (place.altitude_m < kLeastAltitude_m) {
      place.altitude_m += kAltitudeSpan_m;
    }
    return place;
  }

 private:
  Bytes left_;
};

[[nodiscard]] S0 s0(PayloadReader from) noexcept {
  S0 packet;
  packet.acceleration_m_s2 = from.axes(kAcceleration_m_s2);
  packet.rate_rad_s = from.axes(kRate_rad_s);
  packet.field_tesla = from.axes(kField_tesla);
  packet.rate_temperature_celsius = from.axes(kTemperature_celsius);
  packet.board_temperature_celsius = from.scaled(kTemperature_celsius);
  packet.time_ms = from.word();
  packet.bit = from.word();
  return packet;
}

[[nodiscard]] S1 s1(PayloadReader from) noexcept {
  S1 packet;
  packet.acceleration_m_s2 = from.axes(kAcceleration_m_s2);
  packet.rate_rad_s = from.axes(kRate_rad_s);
  packet.rate_temperature_celsius = from.axes(kTemperature_celsius);
  packet.board_temperature_celsius = from.scaled(kTemperature_celsius);
  packet.counter = from.word();
  packet.bit = from.word();
  return packet;
}

// A0 and A1 differ in the width of their time alone.
template <class A>
[[nodiscard]] A with_field(PayloadReader& from) noexcept {
  A packet;
  packet.angles = from.angles();
  packet.rate_rad_s = from.axes(kRate_rad_s);
  packet.acceleration_m_s2 = from.axes(kAcceleration_m_s2);
  packet.field_tesla = from.axes(kField_tesla);
  packet.rate_temperature_celsius = from.scaled(kTemperature_celsius);
  return packet;
}

[[nodiscard]] A0 a0(PayloadReader from) noexcept {
  A0 packet = with_field<A0>(from);
  packet.time_ms = from.word();
  packet.bit = from.word();
  return packet;
}

[[nodiscard]] A1 a1(PayloadReader from) noexcept {
  A1 packet = with_field<A1>(from);
  packet.time_ms = from.long_word();
  packet.bit = from.word();
  return packet;
}

[[nodiscard]] A2 a2(PayloadReader from) noexcept {
  A2 packet;
  packet.angles = from.angles();
  packet.rate_rad_s = from.axes(kRate_rad_s);
  packet.acceleration_m_s2 = from.axes(kAcceleration_m_s2);
  packet.rate_temperature_celsius = from.axes(kTemperature_celsius);
  packet.time_ms = from.long_word();
  packet.bit = from.word();
  return packet;
}

[[nodiscard]] N0 n0(PayloadReader from) noexcept {
  N0 packet;
  packet.angles = from.angles();
  packet.rate_rad_s = from.axes(kRate_rad_s);
  packet.place = from.place();
  packet.time_ms = from.word();
  packet.bit = from.word();
  return packet;
}

[[nodiscard]] N1 n1(PayloadReader from) noexcept {
  N1 packet;
  packet.angles = from.angles();
  packet.rate_rad_s = from.axes(kRate_rad_s);
  packet.acceleration_m_s2 = from.axes(kAcceleration_m_s2);
  packet.place = from.place();
  packet.rate_temperature_celsius = from.scaled(kTemperature_celsius);
  packet.time_ms = from.long_word();
  packet.bit = from.word();
  return packet;
}

[[nodiscard]] SelfTest self_test(PayloadReader from) noexcept {
  SelfTest packet;
  for (std::uint16_t& word : packet.words) {
    word = from.word();
  }
  return packet;
}

// Sister units leave the closing zero out.
[[nodiscard]] Identity identity(Bytes payload) noexcept {
  PayloadReader from{payload};
  Identity packet;
  packet.serial = from.long_word();
  const Bytes text = payload.subspan(4);
  const auto end = std::find(text.begin(), text.end(), std::uint8_t{0});
  // Bytes are characters: a view of other bytes than char is what the cast is for.
  packet.model = {reinterpret_cast<const char*>(text.data()),
                  static_cast<std::size_t>(end - text.begin())};
  return packet;
}

[[nodiscard]] Version version(PayloadReader from) noexcept {
  Version packet;
  packet.major = from.byte();
  packet.minor = from.byte();
  packet.patch = from.byte();
  packet.stage = from.byte();
  packet.build = from.byte();
  return packet;
}

[[nodiscard]] Packet fields(Bytes payload) noexcept {
  const std::optional<Fields> found = Fields::in(payload);
  return found ? Packet{*found} : Packet{Unknown{}};
}

constexpr std::size_t kLeastIdentity = 4;

// How long a payload is, of types that have one length.
struct Length {
  PacketType type;
  std::size_t bytes;
  bool continuous;
};
constexpr std::array kLengths{
    Length{kPing, 0, false},         Length{type_of("AR"), 0, false},
    Length{type_of("SR"), 0, false}, Length{kGetPacket, 2, false},
    Length{kNak, 2, false},          Length{type_of("WC"), 2, false},
    Length{type_of("CC"), 8, false}, Length{kVersion, 5, false},
    Length{kSelfTest, 28, false},    Length{kS0, 30, true},
    Length{kS1, 24, true},           Length{type_of("S2"), 28, true},
    Length{kA0, 30, true},           Length{kA1, 32, true},
    Length{kA2, 30, true},           Length{kN0, 32, true},
    Length{kN1, 42, true},           Length{type_of("B1"), 18, true},
    Length{type_of("B2"), 10, true},
};

[[nodiscard]] const Length* length_of(PacketType type) noexcept {
  const auto* found = std::find_if(kLengths.begin(), kLengths.end(),
                                   [type](const Length& length) { return length.type == type; });
  return found == kLengths.end() ? nullptr : found;
}

[[nodiscard]] bool is_of_fields(PacketType type) noexcept {
  return type == kSetFields || type == kWriteFields || type == kGetFields || type == kReadFields;
}

}  // namespace

std::optional<Fields> Fields::in(Bytes payload) noexcept {
  if (payload.empty()) {
    return std::nullopt;
  }
  Fields fields;
  fields.size_ = payload.front();
  fields.list_ = payload.subspan(1);
  if (fields.list_.size() == 4 * fields.size_) {
    fields.stride_ = 4;
  } else if (fields.list_.size() != 2 * fields.size_) {
    return std::nullopt;
  }
  return fields;
}

bool Fields::contain(std::uint16_t id) const noexcept {
  for (std::size_t i = 0; i < size_; ++i) {
    if (this->id(i) == id) {
      return true;
    }
  }
  return false;
}

std::optional<std::uint16_t> Fields::value_of(std::uint16_t id) const noexcept {
  for (std::size_t i = 0; have_values() && i < size_; ++i) {
    if (this->id(i) == id) {
      return value(i);
    }
  }
  return std::nullopt;
}

bool may_be_long(PacketType type, std::size_t payload) noexcept {
  if (const Length* length = length_of(type)) {
    return payload == length->bytes;
  }
  if (is_of_fields(type)) {
    return payload % 2 == 1;
  }
  if (type == kForeignNak) {
    return payload == 2;
  }
  return type != kIdentity || payload >= kLeastIdentity;
}

bool is_known(PacketType type) noexcept {
  return length_of(type) != nullptr || is_of_fields(type) || type == kIdentity || type == kEcho;
}

bool is_continuous(PacketType type) noexcept {
  const Length* length = length_of(type);
  return length != nullptr && length->continuous;
}

Packet decoded(PacketType type, Bytes payload) noexcept {
  if (!may_be_long(type, payload.size())) {
    return Unknown{};
  }
  const PayloadReader from{payload};
  switch (type) {
    case kPing: return Ping{};
    case kEcho: return Echo{payload};
    case kGetPacket: return GetPacket{PayloadReader{from}.word()};
    case kNak: return Nak{PayloadReader{from}.word()};
    case kIdentity: return identity(payload);
    case kVersion: return version(from);
    case kSetFields:
    case kWriteFields:
    case kGetFields:
    case kReadFields: return fields(payload);
    case kSelfTest: return self_test(from);
    case kS0: return s0(from);
    case kS1: return s1(from);
    case kA0: return a0(from);
    case kA1: return a1(from);
    case kA2: return a2(from);
    case kN0: return n0(from);
    case kN1: return n1(from);
    default: return Unknown{};
  }
}

std::optional<HeadingPacket> heading_packet(PacketType type, Bytes payload) noexcept {
  if (!may_be_long(type, payload.size())) {
    return std::nullopt;
  }
  const auto of = [](const auto& packet, bool magnetic, std::uint32_t wraps_ms) {
    return HeadingPacket{packet.angles,  packet.rate_rad_s, magnetic,
                         packet.time_ms, wraps_ms,          packet.bit};
  };
  const PayloadReader from{payload};
  switch (type) {
    case kA0: return of(a0(from), true, kShortTime_ms);
    case kA1: return of(a1(from), true, kWeek_ms);
    case kN0: return of(n0(from), false, kShortTime_ms);
    case kN1: return of(n1(from), false, kWeek_ms);
    default: return std::nullopt;
  }
}

TimeField time_field(PacketType type) noexcept {
  switch (type) {
    case kA0: return {26, 2};
    case kA1: return {26, 4};
    case kN0: return {28, 2};
    case kN1: return {36, 4};
    default: return {};
  }
}

}  // namespace lodesman::nav440
