// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/decode/nav440_lines.h"

#include <string>

#include "drivers/nav440/framing.h"
#include "drivers/nav440/packets.h"

namespace lodesman {
namespace nav440 {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kDigits = "0123456789ABCDEF";

[[nodiscard]] std::string hex_of(Bytes bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text.push_back(kDigits[byte >> 4U]);
    text.push_back(kDigits[byte & 15U]);
  }
  return text;
}

[[nodiscard]] std::string name_of(PacketType type) {
  const auto high = static_cast<std::uint8_t>(type >> 8U);
  const auto low = static_cast<std::uint8_t>(type & 0xFFU);
  const auto is_printed = [](std::uint8_t byte) { return byte > ' ' && byte < 0x7F; };
  if (is_printed(high) && is_printed(low)) {
    return {static_cast<char>(high), static_cast<char>(low)};
  }
  return "0x" + hex_of(std::array<std::uint8_t, 2>{high, low});
}

// Fills in what is its own behind `type` and `known`.
class Writer {
 public:
  Writer(Json& json, Bytes payload) : json_{json}, payload_{payload} {}

  void operator()(const Unknown& /*packet*/) { json_["payload"] = hex_of(payload_); }
  void operator()(const Ping& /*packet*/) {}
  void operator()(const Echo& packet) { json_["payload"] = hex_of(packet.payload); }
  void operator()(const GetPacket& packet) { json_["wanted"] = name_of(packet.wanted); }
  void operator()(const Nak& packet) { json_["refused"] = name_of(packet.refused); }
  void operator()(const Identity& packet) {
    json_["serial"] = packet.serial;
    json_["model"] = packet.model;
  }
  void operator()(const Version& packet) {
    json_["version"] = std::to_string(packet.major) + "." + std::to_string(packet.minor) + "." +
                       std::to_string(packet.patch);
    json_["stage"] = packet.stage;
    json_["build"] = packet.build;
  }
  void operator()(const Fields& packet) {
    json_["fields"] = Json::array();
    for (std::size_t i = 0; i < packet.size(); ++i) {
      Json field{{"id", packet.id(i)}};
      if (packet.have_values()) {
        field["value"] = packet.value(i);
      }
      json_["fields"].push_back(std::move(field));
    }
  }
  void operator()(const SelfTest& packet) {
    for (std::size_t i = 0; i < packet.words.size(); ++i) {
      json_[std::string{SelfTest::kWords[i]}] = packet.words[i];
    }
  }
  void operator()(const S0& packet) {
    acceleration_and_rate(packet);
    json_["field_tesla"] = packet.field_tesla;
    temperatures(packet);
    json_["time_ms"] = packet.time_ms;
    json_["bit"] = packet.bit;
  }
  void operator()(const S1& packet) {
    acceleration_and_rate(packet);
    temperatures(packet);
    json_["counter"] = packet.counter;
    json_["bit"] = packet.bit;
  }
  void operator()(const A0& packet) { angles_and_field(packet); }
  void operator()(const A1& packet) { angles_and_field(packet); }
  void operator()(const A2& packet) {
    angles(packet.angles, "yaw_free_rad");
    rate_and_acceleration(packet);
    json_["rate_temperature_celsius"] = packet.rate_temperature_celsius;
    time_and_bit(packet);
  }
  void operator()(const N0& packet) {
    angles(packet.angles, "yaw_true_rad");
    json_["rate_rad_s"] = packet.rate_rad_s;
    place(packet.place);
    time_and_bit(packet);
  }
  void operator()(const N1& packet) {
    angles(packet.angles, "yaw_true_rad");
    rate_and_acceleration(packet);
    place(packet.place);
    json_["x_rate_temperature_celsius"] = packet.rate_temperature_celsius;
    time_and_bit(packet);
  }

 private:
  void angles(const Angles& angles, const char* yaw) {
    json_["roll_rad"] = angles.roll_rad;
    json_["pitch_rad"] = angles.pitch_rad;
    json_[yaw] = angles.yaw_rad;
  }
  template <class Packet>
  void angles_and_field(const Packet& packet) {
    angles(packet.angles, "yaw_magnetic_rad");
    rate_and_acceleration(packet);
    json_["field_tesla"] = packet.field_tesla;
    json_["x_rate_temperature_celsius"] = packet.rate_temperature_celsius;
    time_and_bit(packet);
  }
  template <class Packet>
  void rate_and_acceleration(const Packet& packet) {
    json_["rate_rad_s"] = packet.rate_rad_s;
    json_["acceleration_m_s2"] = packet.acceleration_m_s2;
  }
  template <class Packet>
  void acceleration_and_rate(const Packet& packet) {
    json_["acceleration_m_s2"] = packet.acceleration_m_s2;
    json_["rate_rad_s"] = packet.rate_rad_s;
  }
  template <class Packet>
  void temperatures(const Packet& packet) {
    json_["rate_temperature_celsius"] = packet.rate_temperature_celsius;
    json_["board_temperature_celsius"] = packet.board_temperature_celsius;
  }
  template <class Packet>
  void time_and_bit(const Packet& packet) {
    json_["time_ms"] = packet.time_ms;
    json_["bit"] = packet.bit;
  }
  void place(const Place& place) {
    json_["velocity_ned_m_s"] = place.velocity_ned_m_s;
    json_["longitude_deg"] = place.longitude_deg;
    json_["latitude_deg"] = place.latitude_deg;
    json_["altitude_m"] = place.altitude_m;
  }

  Json& json_;
  Bytes payload_;
};

[[nodiscard]] Json json_of(const Nav440Frame& frame) {
  Json json{{"type", name_of(frame.type)}, {"known", is_known(frame.type)}};
  std::visit(Writer{json, frame.payload}, decoded(frame.type, frame.payload));
  return json;
}

}  // namespace
}  // namespace nav440

DecodeCounts nav440_lines(std::span<const std::uint8_t> bytes,
                          const std::function<void(const nlohmann::ordered_json&)>& line) {
  Nav440Framing framing;
  while (!bytes.empty()) {
    bytes = bytes.subspan(framing.push(bytes));
    while (const auto frame = framing.next()) {
      line(nav440::json_of(*frame));
    }
  }
  const Nav440FramingCounts& counts = framing.counts();
  return {counts.frames, counts.skipped_bytes + framing.pending(),
          counts.crc_failures + counts.protocol_errors};
}

}  // namespace lodesman
