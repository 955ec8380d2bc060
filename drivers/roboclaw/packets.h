// SPDX-License-Identifier: Apache-2.0
// What is said to a RoboClaw motor controller in packet serial mode, to the byte, and what its
// replies mean. Numbers go most significant byte first. A write carries a CRC and is answered by
// one byte; a read carries none and its reply a CRC over address, command and data. Pure functions;
// any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lodesman::roboclaw {

inline constexpr std::uint8_t kFirstAddress = 0x80;
inline constexpr std::uint8_t kLastAddress = 0x87;
inline constexpr std::uint8_t kAcknowledge = 0xFF;

enum class Command : std::uint8_t {
  kForward1 = 0,
  kBackward1 = 1,
  kForward2 = 4,
  kBackward2 = 5,
  kDrive1 = 6,
  kDrive2 = 7,
  kSetTimeOut = 14,
  kReadTimeOut = 15,
  kReadVersion = 21,
  kReadMainBattery = 24,
  kReadLogicBattery = 25,
  kDuty1 = 32,
  kDuty2 = 33,
  kDutyBoth = 34,
  kReadDuties = 48,
  kReadCurrents = 49,
  kReadTemperature1 = 82,
  kReadTemperature2 = 83,
  kReadStatus = 90,
};

inline constexpr int kFullDuty = 32767;
inline constexpr double kBatteryUnit_volts = 0.1;
inline constexpr double kTimeOutUnit_s = 0.1;
// Of a reply: the longest that is read, a version text and its check.
inline constexpr std::size_t kMaxReplyBytes = 64;

struct Packet {
  static constexpr std::size_t kMaxBytes = 8;

  std::array<std::uint8_t, kMaxBytes> data{};
  std::size_t count = 0;  // [-] of bytes

  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept {
    return std::span{data}.first(count);
  }
};

// CRC-16/XMODEM: polynomial 0x1021, start 0, most significant bit first. `crc` is what it was so
// far.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> bytes,
                                  std::uint16_t crc = 0) noexcept;

// A command with one byte of data, or two signed duties of [-32767, 32767]; with its CRC.
[[nodiscard]] Packet write_byte(std::uint8_t address, Command command, std::uint8_t value) noexcept;
[[nodiscard]] Packet duty_both(std::uint8_t address, std::int16_t first,
                               std::int16_t second) noexcept;
[[nodiscard]] Packet read_request(std::uint8_t address, Command command) noexcept;

// The data of the reply to a read: what comes last in `received`, if its length and CRC are right
// and nothing but late acknowledges stands before it. Nothing: not whole yet, or damaged. A status
// has four bytes, or two from old firmware, and its CRC tells which; a version ends with a zero.
[[nodiscard]] std::optional<std::span<const std::uint8_t>> reply_data(
    std::uint8_t address, Command command, std::span<const std::uint8_t> received) noexcept;

// Most significant byte first; of four bytes at most.
[[nodiscard]] std::uint32_t unsigned_of(std::span<const std::uint8_t> data) noexcept;
[[nodiscard]] std::int16_t signed_of(std::span<const std::uint8_t, 2> data) noexcept;

}  // namespace lodesman::roboclaw
