// SPDX-License-Identifier: Apache-2.0
#include "drivers/roboclaw/exchange.h"

namespace lodesman::roboclaw {
namespace {

constexpr std::size_t kPiece = 64;
constexpr int kMaxPieces = 8;  // a call; who says more is no RoboClaw

}  // namespace

void Exchange::begin() noexcept {
  in_flight_ = false;
  count_ = 0;
  owed_ = 0;
}

Outcome Exchange::listen(Time now) noexcept {
  std::array<std::uint8_t, kPiece> piece{};
  for (int i = 0; i < kMaxPieces; ++i) {
    const std::size_t got = stream_.read(piece, now).count;
    for (std::size_t byte = 0; byte < got; ++byte) {
      take(piece[byte]);
    }
    if (got == 0) {
      break;
    }
  }
  if (!in_flight_) {
    return Outcome::kNone;
  }
  const Outcome outcome = judge();
  if (outcome == Outcome::kGood) {
    in_flight_ = false;
    return outcome;
  }
  if (outcome == Outcome::kLost || now - sent_at_ > kReplyWait) {
    stray_bytes_ += count_;
    abandon();
    return Outcome::kLost;
  }
  return Outcome::kAwaited;
}

void Exchange::take(std::uint8_t byte) noexcept {
  if (!in_flight_) {
    const bool late = byte == kAcknowledge && owed_ > 0;
    owed_ -= late ? 1 : 0;
    stray_bytes_ += late ? 0 : 1;
  } else if (count_ < received_.size()) {
    received_[count_++] = byte;
  } else {
    overfull_ = true;
    ++stray_bytes_;
  }
}

Outcome Exchange::judge() noexcept {
  const auto received = std::span{received_}.first(count_);
  if (overfull_) {
    return Outcome::kLost;
  }
  if (is_write(command_)) {
    return received.empty()                                      ? Outcome::kAwaited
           : received.size() == 1 && received[0] == kAcknowledge ? Outcome::kGood
                                                                 : Outcome::kLost;
  }
  const auto data = reply_data(address_, command_, received);
  if (!data) {
    return Outcome::kAwaited;
  }
  data_ = *data;
  // What stands before it are late acknowledges.
  const auto late = static_cast<int>(data->data() - received.data());
  owed_ = late < owed_ ? owed_ - late : 0;
  return Outcome::kGood;
}

bool Exchange::send(Command command, const Packet& packet, Time now) noexcept {
  if (stream_.write(packet.bytes(), now) < packet.count) {
    return false;
  }
  in_flight_ = true;
  overfull_ = false;
  count_ = 0;
  command_ = command;
  sent_at_ = now;
  return true;
}

void Exchange::abandon() noexcept {
  owed_ += in_flight_ && is_write(command_) ? 1 : 0;
  in_flight_ = false;
}

}  // namespace lodesman::roboclaw
