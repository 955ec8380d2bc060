// SPDX-License-Identifier: Apache-2.0
// Bytes in, frames out, wherever the bytes are cut: 55 55, a type of two bytes, a length, so many
// bytes of payload, and a CRC-16 over all but the preamble. Nothing in a payload is escaped, so
// that a preamble may be a false one: what fails its check gives up one byte of it and is looked
// through anew. A fixed buffer; nothing allocates. Owned by one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lodesman {

struct Nav440Frame {
  std::uint16_t type = 0;
  std::span<const std::uint8_t> payload;  // until the framing is next asked or fed
};

struct Nav440FramingCounts {
  std::uint64_t frames = 0;           // [-] whose check holds
  std::uint64_t unknown_types = 0;    // [-] of these, of a type that is not known
  std::uint64_t crc_failures = 0;     // [-] candidates whose check fails
  std::uint64_t protocol_errors = 0;  // [-] of a known type, with a length that it cannot have
  std::uint64_t skipped_bytes = 0;    // [-] that belong to no frame
};

// Polynomial 0x1021, from 0x1D0F on, most significant bit first, nothing reflected. The manual's
// start value of 0xFFFF is the same CRC in its augmented form.
[[nodiscard]] std::uint16_t nav440_crc(std::span<const std::uint8_t> bytes) noexcept;

class Nav440Framing {
 public:
  static constexpr std::size_t kOverhead = 7;  // of a frame, besides its payload
  static constexpr int kBitsOfByte = 10;       // on its line: 8, a start and a stop
  static constexpr std::size_t kLongestFrame = 255 + kOverhead;

  // As new but for the counts: what comes next has nothing to do with what came before.
  void restart() noexcept;

  // How many bytes it takes at least until the next frame can be whole; never so many that a frame
  // could end before the last of them, unless one began inside a damaged one.
  [[nodiscard]] std::size_t wanted() const noexcept;

  // How many of them were taken, from the first on: all, where next() was asked until it gave none.
  [[nodiscard]] std::size_t push(std::span<const std::uint8_t> bytes) noexcept;

  // The next frame whose check holds, of whatever type; none where more bytes are needed.
  [[nodiscard]] std::optional<Nav440Frame> next() noexcept;

  // Bytes that may yet become a frame.
  [[nodiscard]] std::size_t pending() const noexcept { return end_ - begin_ - given_; }
  [[nodiscard]] const Nav440FramingCounts& counts() const noexcept { return counts_; }

 private:
  enum class Verdict { kNeedsMore, kNoPreamble, kNoSuchLength, kCrcFails, kHolds };

  // What begins with the first of these bytes.
  [[nodiscard]] static Verdict judge(std::span<const std::uint8_t> bytes) noexcept;
  // Behind how many bytes there is one within a candidate of a type that is not known; 0: none.
  [[nodiscard]] std::size_t known_frame_within() const noexcept;
  [[nodiscard]] Nav440Frame give() noexcept;
  [[nodiscard]] std::span<const std::uint8_t> held() const noexcept {
    return std::span{bytes_}.subspan(begin_, end_ - begin_);
  }
  void give_up(std::size_t bytes) noexcept;
  void drop_given() noexcept;

  std::array<std::uint8_t, 1024> bytes_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t given_ = 0;  // from begin_ on: the frame that was given last
  Nav440FramingCounts counts_;
};

}  // namespace lodesman
