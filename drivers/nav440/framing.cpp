// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/framing.h"

#include <algorithm>

#include "drivers/nav440/packets.h"

namespace lodesman {
namespace {

constexpr std::uint8_t kPreamble = 0x55;
constexpr std::size_t kTypeAt = 2;
constexpr std::size_t kLengthAt = 4;
constexpr std::size_t kPayloadAt = 5;
constexpr std::uint16_t kPolynomial = 0x1021;
constexpr std::uint16_t kCrcStart = 0x1D0F;

[[nodiscard]] constexpr std::array<std::uint16_t, 256> crc_table() noexcept {
  std::array<std::uint16_t, 256> table{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned crc = byte << 8U;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 0x8000U) != 0 ? (crc << 1U) ^ kPolynomial : crc << 1U;
    }
    table[byte] = static_cast<std::uint16_t>(crc);
  }
  return table;
}

[[nodiscard]] std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  return static_cast<std::uint16_t>((bytes[at] << 8U) | bytes[at + 1]);
}

}  // namespace

std::uint16_t nav440_crc(std::span<const std::uint8_t> bytes) noexcept {
  static constexpr std::array<std::uint16_t, 256> kTable = crc_table();
  unsigned crc = kCrcStart;
  for (const std::uint8_t byte : bytes) {
    crc = ((crc << 8U) ^ kTable[((crc >> 8U) ^ byte) & 0xFFU]) & 0xFFFFU;
  }
  return static_cast<std::uint16_t>(crc);
}

void Nav440Framing::restart() noexcept {
  drop_given();
  counts_.skipped_bytes += end_ - begin_;
  begin_ = end_ = 0;
}

std::size_t Nav440Framing::wanted() const noexcept {
  const std::size_t held = pending();
  if (held <= kLengthAt) {
    return kOverhead - held;
  }
  const std::size_t whole = bytes_[begin_ + given_ + kLengthAt] + kOverhead;
  return whole > held ? whole - held : 1;
}

std::size_t Nav440Framing::push(std::span<const std::uint8_t> bytes) noexcept {
  drop_given();
  if (bytes.size() > bytes_.size() - end_) {
    std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(begin_),
              bytes_.begin() + static_cast<std::ptrdiff_t>(end_), bytes_.begin());
    end_ -= begin_;
    begin_ = 0;
  }
  const std::size_t taken = std::min(bytes.size(), bytes_.size() - end_);
  std::copy_n(bytes.begin(), taken, bytes_.begin() + static_cast<std::ptrdiff_t>(end_));
  end_ += taken;
  return taken;
}

std::optional<Nav440Frame> Nav440Framing::next() noexcept {
  drop_given();
  for (;;) {
    give_up(known_frame_within());
    switch (judge(held())) {
      case Verdict::kNeedsMore: return std::nullopt;
      case Verdict::kHolds: return give();
      case Verdict::kCrcFails: ++counts_.crc_failures; break;
      case Verdict::kNoSuchLength: ++counts_.protocol_errors; break;
      case Verdict::kNoPreamble: break;
    }
    give_up(1);
  }
}

Nav440Frame Nav440Framing::give() noexcept {
  const std::span<const std::uint8_t> bytes = held();
  const std::uint16_t type = word_at(bytes, kTypeAt);
  ++counts_.frames;
  counts_.unknown_types += nav440::is_known(type) ? 0U : 1U;
  given_ = bytes[kLengthAt] + kOverhead;
  return {type, bytes.subspan(kPayloadAt, bytes[kLengthAt])};
}

// Of three 55 in a row the first is no preamble: a type that begins with 55 is none of this unit's,
// and one that came as "UE" would wait for bytes that belong to the frame behind.
Nav440Framing::Verdict Nav440Framing::judge(std::span<const std::uint8_t> bytes) noexcept {
  const std::size_t to_look_at = std::min(bytes.size(), kTypeAt + 1);
  for (std::size_t i = 0; i < to_look_at; ++i) {
    if ((bytes[i] == kPreamble) != (i < kTypeAt)) {
      return Verdict::kNoPreamble;
    }
  }
  if (bytes.size() <= kLengthAt) {
    return Verdict::kNeedsMore;
  }
  const std::size_t length = bytes[kLengthAt];
  if (!nav440::may_be_long(word_at(bytes, kTypeAt), length)) {
    return Verdict::kNoSuchLength;
  }
  if (bytes.size() < length + kOverhead) {
    return Verdict::kNeedsMore;
  }
  const std::size_t checked = kPayloadAt - kTypeAt + length;
  return nav440_crc(bytes.subspan(kTypeAt, checked)) == word_at(bytes, kTypeAt + checked)
             ? Verdict::kHolds
             : Verdict::kCrcFails;
}

// The one that is whole first, so that it is the same however the bytes come.
std::size_t Nav440Framing::known_frame_within() const noexcept {
  const std::span<const std::uint8_t> bytes = held();
  if (bytes.size() <= kLengthAt || nav440::is_known(word_at(bytes, kTypeAt)) ||
      judge(bytes) == Verdict::kNoPreamble) {
    return 0;
  }
  std::size_t first_end = std::min(bytes.size() + 1, bytes[kLengthAt] + kOverhead);
  std::size_t found = 0;
  for (std::size_t at = 1; at + kOverhead < first_end; ++at) {
    const std::span<const std::uint8_t> rest = bytes.subspan(at);
    if (judge(rest) == Verdict::kHolds && nav440::is_known(word_at(rest, kTypeAt))) {
      const std::size_t end = at + rest[kLengthAt] + kOverhead;
      found = end < first_end ? at : found;
      first_end = std::min(first_end, end);
    }
  }
  return found;
}

void Nav440Framing::give_up(std::size_t bytes) noexcept {
  begin_ += bytes;
  counts_.skipped_bytes += bytes;
}

void Nav440Framing::drop_given() noexcept {
  begin_ += given_;
  given_ = 0;
  if (begin_ == end_) {
    begin_ = end_ = 0;
  }
}

}  // namespace lodesman
