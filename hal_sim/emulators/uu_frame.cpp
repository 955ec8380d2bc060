// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/uu_frame.h"

namespace lodesman::emulated {
namespace {

constexpr std::uint8_t kPreamble = 0x55;
constexpr std::uint16_t kPing = uu_type('P', 'K');
constexpr std::size_t kHead = 5;      // preamble, type, length
constexpr std::size_t kOverhead = 7;  // and the CRC
constexpr std::size_t kShortPing = 4;
// The manual: a packet must come whole within four seconds.
constexpr Duration kPatience = std::chrono::seconds{4};
// How long the unit waits for the rest of a ping that may have none (ours).
constexpr Duration kShortPingPause = std::chrono::milliseconds{10};

}  // namespace

// The manual says 0xFFFF and appends two bytes of nothing; this is the same without them.
std::uint16_t uu_crc(std::span<const std::uint8_t> bytes) noexcept {
  unsigned crc = 0x1D0F;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<unsigned>(byte) << 8U;
    for (int bit = 0; bit < 8; ++bit) {
      crc = ((crc & 0x8000U) != 0 ? (crc << 1U) ^ 0x1021U : crc << 1U) & 0xFFFFU;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

Bytes uu_frame(std::uint16_t type, std::span<const std::uint8_t> payload) {
  Bytes frame;
  frame.reserve(payload.size() + kOverhead);
  frame.assign({kPreamble, kPreamble, static_cast<std::uint8_t>(type >> 8U),
                static_cast<std::uint8_t>(type & 0xFFU),
                static_cast<std::uint8_t>(payload.size())});
  for (const std::uint8_t byte : payload) {
    frame.push_back(byte);
  }
  const std::uint16_t crc = uu_crc(std::span{frame}.subspan(2));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  return frame;
}

void UuReceiver::take(std::uint8_t byte, Time at, std::vector<UuCommand>& commands) {
  pass(at, commands);
  held_.push_back({byte, at});
  scan(at, commands);
}

void UuReceiver::pass(Time now, std::vector<UuCommand>& commands) {
  if (held_.size() == kShortPing && now >= held_.back().at + kShortPingPause &&
      held_bytes(0, kShortPing) == Bytes{kPreamble, kPreamble, 'P', 'K'}) {
    commands.push_back({kPing, held_.back().at + kShortPingPause, {}});
    held_.clear();
  }
  while (!held_.empty() && now >= held_.front().at + kPatience) {
    drop(1);
    scan(now, commands);
  }
}

UuReceiver::Look UuReceiver::look() const {
  if (held_[0].value != kPreamble || (held_.size() > 1 && held_[1].value != kPreamble)) {
    return Look::kSlide;
  }
  if (held_.size() < kHead) {
    // A type does not begin with 55: it is one more byte of a preamble.
    return held_.size() > 2 && held_[2].value == kPreamble ? Look::kSlide : Look::kMore;
  }
  const std::size_t size = held_[kHead - 1].value + kOverhead;
  if (held_[2].value == 'P' && held_[3].value == 'K' && size != kOverhead) {
    return Look::kShortPing;
  }
  if (held_.size() < size) {
    return Look::kMore;
  }
  const std::uint16_t crc = uu_crc(held_bytes(2, size - 4));
  const bool good = held_[size - 2].value == crc >> 8U && held_[size - 1].value == (crc & 0xFFU);
  return good ? Look::kWhole : Look::kSlide;
}

void UuReceiver::scan(Time at, std::vector<UuCommand>& commands) {
  while (!held_.empty()) {
    switch (look()) {
      case Look::kMore: return;
      case Look::kSlide: drop(1); break;
      case Look::kShortPing:
        commands.push_back({kPing, at, {}});
        drop(kShortPing);
        break;
      case Look::kWhole: {
        const std::size_t length = held_[kHead - 1].value;
        const auto type = static_cast<std::uint16_t>((held_[2].value << 8) | held_[3].value);
        commands.push_back({type, at, held_bytes(kHead, length)});
        drop(length + kOverhead);
        break;
      }
    }
  }
}

Bytes UuReceiver::held_bytes(std::size_t from, std::size_t count) const {
  Bytes bytes;
  for (std::size_t i = from; i < from + count; ++i) {
    bytes.push_back(held_[i].value);
  }
  return bytes;
}

void UuReceiver::drop(std::size_t count) {
  held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace lodesman::emulated
