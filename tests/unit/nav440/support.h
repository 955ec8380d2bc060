// SPDX-License-Identifier: Apache-2.0
// Bytes and frames for the tests of the NAV440 driver, with a CRC of their own.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/nav440/framing.h"
#include "tests/unit/nav440/vectors.h"

namespace lodesman::testing {

using ByteList = std::vector<std::uint8_t>;

[[nodiscard]] inline ByteList bytes_of(std::string_view hex) {
  ByteList bytes;
  for (std::size_t at = 0; at + 1 < hex.size(); at += 3) {
    bytes.push_back(
        static_cast<std::uint8_t>(std::stoi(std::string{hex.substr(at, 2)}, nullptr, 16)));
  }
  return bytes;
}

[[nodiscard]] inline ByteList vector_bytes(std::string_view number) {
  return bytes_of(vector_of(number));
}

inline void append(ByteList& to, const ByteList& bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

// Bit by bit, as the manual words it: from 0xFFFF, with sixteen zero bits behind the message.
[[nodiscard]] inline std::uint16_t manual_crc(std::span<const std::uint8_t> message) {
  unsigned crc = 0xFFFF;
  const auto push = [&crc](unsigned bit) {
    const bool carries = (crc & 0x8000U) != 0;
    crc = ((crc << 1U) | bit) & 0xFFFFU;
    crc ^= carries ? 0x1021U : 0U;
  };
  for (const std::uint8_t byte : message) {
    for (unsigned bit = 8; bit-- > 0;) {
      push((byte >> bit) & 1U);
    }
  }
  for (int i = 0; i < 16; ++i) {
    push(0);
  }
  return static_cast<std::uint16_t>(crc);
}

[[nodiscard]] inline ByteList frame_of(std::string_view type, const ByteList& payload) {
  ByteList frame{0x55, 0x55, static_cast<std::uint8_t>(type[0]), static_cast<std::uint8_t>(type[1]),
                 static_cast<std::uint8_t>(payload.size())};
  append(frame, payload);
  const std::uint16_t crc = manual_crc(std::span{frame}.subspan(2));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  return frame;
}

// A frame that came out, kept.
struct Kept {
  std::uint16_t type = 0;
  ByteList payload;

  friend bool operator==(const Kept&, const Kept&) = default;
};

// Feeds `bytes` in pieces of this size and keeps what comes out.
[[nodiscard]] inline std::vector<Kept> fed(Nav440Framing& framing,
                                           std::span<const std::uint8_t> bytes, std::size_t piece) {
  std::vector<Kept> frames;
  while (!bytes.empty()) {
    const std::size_t taken = framing.push(bytes.first(std::min(piece, bytes.size())));
    bytes = bytes.subspan(taken);
    while (const auto frame = framing.next()) {
      frames.push_back({frame->type, {frame->payload.begin(), frame->payload.end()}});
    }
  }
  return frames;
}

[[nodiscard]] inline std::vector<Kept> frames_in(std::span<const std::uint8_t> bytes,
                                                 std::size_t piece = 1000) {
  Nav440Framing framing;
  return fed(framing, bytes, piece);
}

[[nodiscard]] inline Kept kept_of(const ByteList& frame) {
  return {static_cast<std::uint16_t>((frame[2] << 8U) | frame[3]),
          {frame.begin() + 5, frame.end() - 2}};
}

}  // namespace lodesman::testing
