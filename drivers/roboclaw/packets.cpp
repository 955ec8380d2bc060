// SPDX-License-Identifier: Apache-2.0
#include "drivers/roboclaw/packets.h"

#include <algorithm>

namespace lodesman::roboclaw {
namespace {

constexpr std::uint16_t kPolynomial = 0x1021;
constexpr std::size_t kCrcBytes = 2;

using Bytes = std::span<const std::uint8_t>;

void append(Packet& packet, unsigned byte) noexcept {
  packet.data[packet.count++] = static_cast<std::uint8_t>(byte & 0xFFU);
}

void append_word(Packet& packet, unsigned word) noexcept {
  append(packet, word >> 8U);
  append(packet, word);
}

[[nodiscard]] bool are_acknowledges(Bytes bytes) noexcept {
  return std::all_of(bytes.begin(), bytes.end(),
                     [](std::uint8_t byte) { return byte == kAcknowledge; });
}

[[nodiscard]] bool check_holds(std::uint8_t address, Command command, Bytes reply) noexcept {
  const std::array<std::uint8_t, 2> head{address, static_cast<std::uint8_t>(command)};
  const Bytes data = reply.first(reply.size() - kCrcBytes);
  return crc16(data, crc16(head)) == unsigned_of(reply.last(kCrcBytes));
}

// The reply of that many bytes of data at the end of what was received.
[[nodiscard]] std::optional<Bytes> ending(std::uint8_t address, Command command, Bytes received,
                                          std::size_t data_bytes) noexcept {
  const std::size_t size = data_bytes + kCrcBytes;
  if (received.size() < size || !are_acknowledges(received.first(received.size() - size)) ||
      !check_holds(address, command, received.last(size))) {
    return std::nullopt;
  }
  return received.last(size).first(data_bytes);
}

[[nodiscard]] std::optional<Bytes> version(std::uint8_t address, Bytes received) noexcept {
  const auto begin = std::find_if(received.begin(), received.end(),
                                  [](std::uint8_t byte) { return byte != kAcknowledge; });
  const auto late = static_cast<std::size_t>(begin - received.begin());
  const std::size_t size = received.size() - late;
  if (size < kCrcBytes + 1) {
    return std::nullopt;
  }
  const auto data = ending(address, Command::kReadVersion, received, size - kCrcBytes);
  return data && data->back() == 0 ? data : std::nullopt;
}

}  // namespace

std::uint16_t crc16(Bytes bytes, std::uint16_t crc) noexcept {
  unsigned value = crc;
  for (const std::uint8_t byte : bytes) {
    value ^= static_cast<unsigned>(byte) << 8U;
    for (int bit = 0; bit < 8; ++bit) {
      value = (value & 0x8000U) != 0 ? value << 1U ^ kPolynomial : value << 1U;
    }
  }
  return static_cast<std::uint16_t>(value & 0xFFFFU);
}

Packet read_request(std::uint8_t address, Command command) noexcept {
  Packet packet;
  append(packet, address);
  append(packet, static_cast<std::uint8_t>(command));
  return packet;
}

Packet write_byte(std::uint8_t address, Command command, std::uint8_t value) noexcept {
  Packet packet = read_request(address, command);
  append(packet, value);
  append_word(packet, crc16(packet.bytes()));
  return packet;
}

Packet duty_both(std::uint8_t address, std::int16_t first, std::int16_t second) noexcept {
  Packet packet = read_request(address, Command::kDutyBoth);
  append_word(packet, static_cast<std::uint16_t>(first));
  append_word(packet, static_cast<std::uint16_t>(second));
  append_word(packet, crc16(packet.bytes()));
  return packet;
}

std::optional<Bytes> reply_data(std::uint8_t address, Command command, Bytes received) noexcept {
  switch (command) {
    case Command::kReadVersion: return version(address, received);
    case Command::kReadTimeOut: return ending(address, command, received, 1);
    case Command::kReadMainBattery:
    case Command::kReadLogicBattery:
    case Command::kReadTemperature1:
    case Command::kReadTemperature2: return ending(address, command, received, 2);
    case Command::kReadDuties:
    case Command::kReadCurrents: return ending(address, command, received, 4);
    case Command::kReadStatus: {
      const auto status = ending(address, command, received, 4);
      return status ? status : ending(address, command, received, 2);
    }
    default: return std::nullopt;
  }
}

std::uint32_t unsigned_of(Bytes data) noexcept {
  std::uint32_t value = 0;
  for (const std::uint8_t byte : data) {
    value = value << 8U | byte;
  }
  return value;
}

std::int16_t signed_of(std::span<const std::uint8_t, 2> data) noexcept {
  return static_cast<std::int16_t>(unsigned_of(data));
}

}  // namespace lodesman::roboclaw
