// SPDX-License-Identifier: Apache-2.0
// Bytes in, sentences out, wherever the bytes are cut (NMEA 0183): '$' or '!', printable
// characters,
// '*', the exclusive or of what lies between as two digits (small letters too), and the end of the
// line. A sentence without a checksum is refused: nothing then tells damage. The standard allows 82
// characters; receivers with eight decimals write more, so that kLongest are taken. What is no part
// of a whole sentence is skipped. A fixed buffer; nothing allocates. Owned by one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace lodesman {

struct NmeaFramingCounts {
  std::uint64_t sentences = 0;         // [-] whose checksum holds
  std::uint64_t wrong_checksums = 0;   // [-] lines whose checksum fails
  std::uint64_t without_checksum = 0;  // [-] lines that have none, or one that is no number
  std::uint64_t broken = 0;            // [-] sentences that another one or no text cut off
  std::uint64_t too_long = 0;          // [-] that had no end after kLongest characters
  std::uint64_t skipped_bytes = 0;     // [-] that belong to no sentence
};

class NmeaFraming {
 public:
  // Of a sentence without the end of its line.
  static constexpr std::size_t kLongest = 120;

  // As new but for the counts.
  void restart() noexcept;

  // Takes one byte. A whole sentence that ends with it, from its '$' or '!' up to its '*': it is
  // valid until the next byte is taken.
  [[nodiscard]] std::optional<std::string_view> push(std::uint8_t byte) noexcept;

  // Bytes that may yet become a sentence; 1: the last byte began one.
  [[nodiscard]] std::size_t pending() const noexcept { return size_; }
  [[nodiscard]] const NmeaFramingCounts& counts() const noexcept { return counts_; }

 private:
  void begin(std::uint8_t byte) noexcept;
  [[nodiscard]] std::optional<std::string_view> end() noexcept;
  void drop(std::uint64_t& count) noexcept;

  std::array<char, kLongest> bytes_{};
  std::size_t size_ = 0;  // 0: between sentences
  NmeaFramingCounts counts_;
};

// The exclusive or of these characters.
[[nodiscard]] std::uint8_t nmea_checksum(std::string_view text) noexcept;

}  // namespace lodesman
