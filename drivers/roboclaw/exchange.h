// SPDX-License-Identifier: Apache-2.0
// One packet to a RoboClaw and what comes back for it. One exchange is in flight at a time, and all
// that was left on the line is read away before the next. An acknowledge is a bare byte without a
// number: one that comes late is credited to nothing, and how many may still come is known. Never
// blocks; one thread, that of the stream.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/roboclaw/packets.h"
#include "drivers/stream/byte_stream.h"

namespace lodesman::roboclaw {

enum class Outcome : std::uint8_t {
  kNone,     // nothing is in flight
  kAwaited,  // not whole yet, and not too late
  kGood,     // acknowledged, or answered; data() has the answer
  kLost,     // too late, or something else has come
};

class Exchange {
 public:
  static constexpr Duration kReplyWait = std::chrono::milliseconds{100};

  Exchange(ByteStream& stream, std::uint8_t address) noexcept
      : stream_{stream}, address_{address} {}

  // The connection is another one.
  void begin() noexcept;

  // Reads all that has come, and judges it. kGood and kLost are given once.
  [[nodiscard]] Outcome listen(Time now) noexcept;
  // False where the line did not take the whole packet: the box drops a piece by itself, after a
  // pause of 10 ms or by its CRC, so what is left of it is not sent later.
  [[nodiscard]] bool send(Command command, const Packet& packet, Time now) noexcept;
  // Nobody waits for what is in flight any more.
  void abandon() noexcept;

  [[nodiscard]] Command command() const noexcept { return command_; }
  [[nodiscard]] std::span<const std::uint8_t> data() const noexcept { return data_; }
  // Acknowledges that nobody waits for and that may still come.
  [[nodiscard]] int owed() const noexcept { return owed_; }
  void forget_owed() noexcept { owed_ = 0; }
  // Bytes that were neither a reply nor owed, so far.
  [[nodiscard]] std::uint64_t stray_bytes() const noexcept { return stray_bytes_; }

 private:
  void take(std::uint8_t byte) noexcept;
  [[nodiscard]] Outcome judge() noexcept;

  ByteStream& stream_;
  std::uint8_t address_;
  bool in_flight_ = false;
  bool overfull_ = false;
  Command command_ = Command::kReadVersion;
  Time sent_at_{};
  std::array<std::uint8_t, kMaxReplyBytes> received_{};
  std::size_t count_ = 0;
  std::span<const std::uint8_t> data_;
  int owed_ = 0;
  std::uint64_t stray_bytes_ = 0;
};

// Whether a command is answered by an acknowledge alone.
[[nodiscard]] constexpr bool is_write(Command command) noexcept {
  return command == Command::kSetTimeOut || command == Command::kDutyBoth;
}

}  // namespace lodesman::roboclaw
