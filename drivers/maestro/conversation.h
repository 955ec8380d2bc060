// SPDX-License-Identifier: Apache-2.0
// Questions to a Maestro and its answers, which have no frame, no check and no number: an answer is
// known by its length and by nothing else having come. So one question is open at a time, all that
// was left on the line is read away before it, and after a lost answer nothing is asked for a
// while, so that a late one finds nobody waiting. Never blocks; one thread, that of the stream.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/maestro/commands.h"
#include "drivers/stream/byte_stream.h"

namespace lodesman::maestro {

// Several packets that go out in one write, so that they leave untorn.
class Message {
 public:
  static constexpr std::size_t kMaxPackets = 6;

  void add(const Packet& packet) noexcept;
  // One that is answered.
  void ask(const Packet& packet) noexcept {
    add(packet);
    reply_bytes_ += kReplyBytes;
  }

  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept {
    return std::span{data_}.first(count_);
  }
  [[nodiscard]] std::size_t reply_bytes() const noexcept { return reply_bytes_; }
  // Where the packet ends that byte `at` is within; `at` where one begins or all is over.
  [[nodiscard]] std::size_t end_of_torn(std::size_t at) const noexcept;

 private:
  std::array<std::uint8_t, kMaxPackets * Packet::kMaxBytes> data_{};
  std::array<std::size_t, kMaxPackets> ends_{};
  std::size_t packets_ = 0;
  std::size_t count_ = 0;
  std::size_t reply_bytes_ = 0;
};

enum class Answer : std::uint8_t {
  kNone,     // nothing is asked
  kAwaited,  // not whole yet, and not too late
  kWhole,    // reply() has it
  kLost,     // too late, or other bytes than the answer's have come
};

class Conversation {
 public:
  static constexpr Duration kReplyWait = std::chrono::milliseconds{100};
  // After a lost answer nothing is asked for this long.
  static constexpr Duration kQuiet = std::chrono::milliseconds{300};
  static constexpr std::size_t kMaxReplies = 3;

  explicit Conversation(ByteStream& stream) noexcept : stream_{stream} {}

  // The connection is another one: nothing is asked, nothing half said.
  void begin() noexcept;

  // Reads all that has come, and judges it. kWhole and kLost are given once.
  [[nodiscard]] Answer listen(Time now) noexcept;
  // Value `index` of the last whole answer, in the order asked.
  [[nodiscard]] std::uint16_t reply(std::size_t index) const noexcept {
    return reply_value(received_.at(2 * index), received_.at(2 * index + 1));
  }
  [[nodiscard]] bool may_ask(Time now) const noexcept {
    return expected_ == 0 && now >= quiet_until_;
  }

  // One write; false where the line did not take all of it. A packet that was torn is finished
  // before anything else is said, one that was not begun is forgotten, and so is the answer.
  [[nodiscard]] bool say(const Message& message, Time now) noexcept;

  // Bytes that were no part of an answer, so far.
  [[nodiscard]] std::uint64_t stray_bytes() const noexcept { return stray_bytes_; }

 private:
  [[nodiscard]] bool read_all(Time now) noexcept;
  void be_quiet(Time now) noexcept;

  ByteStream& stream_;
  std::array<std::uint8_t, kMaxReplies * kReplyBytes> received_{};
  std::size_t count_ = 0;
  std::size_t expected_ = 0;  // 0: nothing is asked
  Time asked_at_{};
  Time quiet_until_{};
  std::uint64_t stray_bytes_ = 0;
  std::array<std::uint8_t, Packet::kMaxBytes> torn_{};  // what is left of a packet to say
  std::size_t torn_count_ = 0;
};

}  // namespace lodesman::maestro
