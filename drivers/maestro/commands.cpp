// SPDX-License-Identifier: Apache-2.0
#include "drivers/maestro/commands.h"

namespace lodesman::maestro {
namespace {

constexpr std::uint8_t kDataBits = 0x7F;
constexpr std::uint8_t kCrcPolynomial = 0x91;

template <class... Bytes>
[[nodiscard]] Packet packet_of(Bytes... bytes) noexcept {
  static_assert(sizeof...(bytes) <= Packet::kMaxBytes);
  Packet packet;
  (packet.append(static_cast<std::uint8_t>(bytes)), ...);
  return packet;
}

}  // namespace

Packet set_target(std::uint8_t channel, std::uint16_t target_quarter_us) noexcept {
  return packet_of(kSetTarget, channel & kDataBits, target_quarter_us & kDataBits,
                   target_quarter_us >> 7U & kDataBits);
}

Packet get_position(std::uint8_t channel) noexcept {
  return packet_of(kGetPosition, channel & kDataBits);
}

Packet get_errors() noexcept { return packet_of(kGetErrors); }

Packet go_home() noexcept { return packet_of(kGoHome); }

Packet mini_ssc(std::uint8_t channel, std::uint8_t target) noexcept {
  return packet_of(kMiniSsc, channel, target);
}

Packet addressed(const Packet& compact, std::uint8_t device) noexcept {
  Packet packet = packet_of(kPololuProtocol, device & kDataBits);
  for (std::size_t i = 0; i < compact.count && packet.count < Packet::kMaxBytes; ++i) {
    packet.append(i == 0 ? static_cast<std::uint8_t>(compact.data[i] & kDataBits)
                         : compact.data[i]);
  }
  return packet;
}

std::uint8_t crc7(std::span<const std::uint8_t> bytes) noexcept {
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = ((crc & 1U) != 0 ? crc ^ kCrcPolynomial : crc) >> 1U;
    }
  }
  return static_cast<std::uint8_t>(crc);
}

Packet with_crc(const Packet& packet) noexcept {
  Packet checked = packet;
  if (checked.count < Packet::kMaxBytes) {
    checked.append(crc7(packet.bytes()));
  }
  return checked;
}

}  // namespace lodesman::maestro
