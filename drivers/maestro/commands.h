// SPDX-License-Identifier: Apache-2.0
// What is said to a Pololu Maestro, to the byte, and what its answers mean. Command bytes are 0x80
// and above, data bytes hold 7 bits; pulses are in quarters of a microsecond; answers are 16 bits,
// least significant byte first, without any check. Pure functions; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lodesman::maestro {

inline constexpr std::uint8_t kSetTarget = 0x84;
inline constexpr std::uint8_t kSetSpeed = 0x87;
inline constexpr std::uint8_t kSetAcceleration = 0x89;
inline constexpr std::uint8_t kSetPwm = 0x8A;
inline constexpr std::uint8_t kGetPosition = 0x90;
inline constexpr std::uint8_t kGetMoving = 0x93;
inline constexpr std::uint8_t kSetTargets = 0x9F;
inline constexpr std::uint8_t kGetErrors = 0xA1;
inline constexpr std::uint8_t kGoHome = 0xA2;
inline constexpr std::uint8_t kStopScript = 0xA4;
inline constexpr std::uint8_t kRunSubroutine = 0xA7;
inline constexpr std::uint8_t kRunSubroutineWith = 0xA8;
inline constexpr std::uint8_t kPololuProtocol = 0xAA;
inline constexpr std::uint8_t kScriptStatus = 0xAE;
inline constexpr std::uint8_t kMiniSsc = 0xFF;

inline constexpr std::uint8_t kDefaultDevice = 12;
inline constexpr int kMaxChannel = 23;
inline constexpr std::size_t kReplyBytes = 2;  // to get errors, and to get position
inline constexpr double kQuartersPerMicrosecond = 4.0;
inline constexpr double kPulseStep_us = 1.0 / kQuartersPerMicrosecond;

// Bits of the error register. Any of them drives all outputs to their error action.
enum ErrorBit : std::uint16_t {
  kSignalError = 1U << 0U,
  kOverrunError = 1U << 1U,
  kBufferFull = 1U << 2U,
  kCrcError = 1U << 3U,
  kProtocolError = 1U << 4U,
  kTimeOutError = 1U << 5U,
  kScriptStackError = 1U << 6U,
  kCallStackError = 1U << 7U,
  kProgramCounterError = 1U << 8U,
};
inline constexpr std::uint16_t kAllErrors = 0x01FF;  // no other bit is ever set

struct Packet {
  static constexpr std::size_t kMaxBytes = 8;

  std::array<std::uint8_t, kMaxBytes> data{};
  std::size_t count = 0;  // [-] of bytes

  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept {
    return std::span{data}.first(count);
  }
  void append(std::uint8_t byte) noexcept { data[count++] = byte; }
};

// Compact protocol. Target in quarters of a microsecond, 14 bits; 0 stops the pulses.
[[nodiscard]] Packet set_target(std::uint8_t channel, std::uint16_t target_quarter_us) noexcept;
[[nodiscard]] Packet get_position(std::uint8_t channel) noexcept;
[[nodiscard]] Packet get_errors() noexcept;
[[nodiscard]] Packet go_home() noexcept;
// 8 bits: 0 is neutral less the channel's range, 127 neutral, 254 neutral and the range.
[[nodiscard]] Packet mini_ssc(std::uint8_t channel, std::uint8_t target) noexcept;

// A compact packet as the Pololu protocol has it, for one of several boxes on a line.
[[nodiscard]] Packet addressed(const Packet& compact, std::uint8_t device) noexcept;

// Over all bytes of a packet: polynomial 0x91, least significant bit first, start 0.
[[nodiscard]] std::uint8_t crc7(std::span<const std::uint8_t> bytes) noexcept;
// With its check behind it, as a box wants it whose setting "Enable CRC" is on. Not for Mini SSC.
[[nodiscard]] Packet with_crc(const Packet& packet) noexcept;

[[nodiscard]] constexpr std::uint16_t reply_value(std::uint8_t low, std::uint8_t high) noexcept {
  return static_cast<std::uint16_t>(low | high << 8U);
}

}  // namespace lodesman::maestro
