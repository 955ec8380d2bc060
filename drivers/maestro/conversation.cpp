// SPDX-License-Identifier: Apache-2.0
#include "drivers/maestro/conversation.h"

#include <algorithm>

namespace lodesman::maestro {
namespace {

constexpr std::size_t kPiece = 64;
constexpr int kMaxPieces = 8;  // a call; who says more is no Maestro

}  // namespace

void Message::add(const Packet& packet) noexcept {
  if (packets_ == kMaxPackets) {
    return;
  }
  for (const std::uint8_t byte : packet.bytes()) {
    data_[count_++] = byte;
  }
  ends_[packets_++] = count_;
}

std::size_t Message::end_of_torn(std::size_t at) const noexcept {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < packets_; ++i) {
    if (at > begin && at < ends_[i]) {
      return ends_[i];
    }
    begin = ends_[i];
  }
  return at;
}

void Conversation::begin() noexcept {
  expected_ = 0;
  count_ = 0;
  torn_count_ = 0;
  quiet_until_ = Time{};
}

Answer Conversation::listen(Time now) noexcept {
  const bool strays = read_all(now);
  if (expected_ == 0) {
    return Answer::kNone;
  }
  if (strays || (count_ < expected_ && now - asked_at_ > kReplyWait)) {
    be_quiet(now);
    return Answer::kLost;
  }
  if (count_ < expected_) {
    return Answer::kAwaited;
  }
  expected_ = 0;
  return Answer::kWhole;
}

// Whether other bytes came than those that are expected.
bool Conversation::read_all(Time now) noexcept {
  bool strays = false;
  std::array<std::uint8_t, kPiece> piece{};
  for (int i = 0; i < kMaxPieces; ++i) {
    const std::size_t got = stream_.read(piece, now).count;
    for (std::size_t byte = 0; byte < got; ++byte) {
      if (count_ < expected_) {
        received_[count_++] = piece[byte];
      } else {
        strays = true;
        ++stray_bytes_;
      }
    }
    if (got == 0) {
      break;
    }
  }
  return strays;
}

void Conversation::be_quiet(Time now) noexcept {
  stray_bytes_ += count_;
  count_ = 0;
  expected_ = 0;
  quiet_until_ = now + kQuiet;
}

bool Conversation::say(const Message& message, Time now) noexcept {
  // What is left of a torn packet, and the message behind it, leave together.
  std::array<std::uint8_t, (Message::kMaxPackets + 1) * Packet::kMaxBytes> out{};
  std::copy_n(torn_.begin(), torn_count_, out.begin());
  const auto said = message.bytes();
  std::copy(said.begin(), said.end(), out.begin() + static_cast<std::ptrdiff_t>(torn_count_));
  const std::size_t taken = stream_.write(std::span{out}.first(torn_count_ + said.size()), now);
  if (taken < torn_count_ + said.size()) {
    const std::size_t end =
        taken < torn_count_ ? torn_count_ : torn_count_ + message.end_of_torn(taken - torn_count_);
    torn_count_ = end - taken;
    std::copy_n(out.begin() + static_cast<std::ptrdiff_t>(taken), torn_count_, torn_.begin());
    be_quiet(now);
    return false;
  }
  torn_count_ = 0;
  if (message.reply_bytes() > 0) {
    count_ = 0;
    expected_ = message.reply_bytes();
    asked_at_ = now;
  }
  return true;
}

}  // namespace lodesman::maestro
