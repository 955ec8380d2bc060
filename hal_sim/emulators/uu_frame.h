// SPDX-License-Identifier: Apache-2.0
// Frames of the Crossbow 440 series: 55 55, type, length, payload, CRC. As the unit makes them and
// as it takes them. One thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mid_level/base/time.h"

namespace lodesman::emulated {

using Bytes = std::vector<std::uint8_t>;

// A packet type is named by two characters.
[[nodiscard]] constexpr std::uint16_t uu_type(char first, char second) noexcept {
  return static_cast<std::uint16_t>((static_cast<unsigned char>(first) << 8) |
                                    static_cast<unsigned char>(second));
}

[[nodiscard]] std::uint16_t uu_crc(std::span<const std::uint8_t> bytes) noexcept;

// At most 255 bytes of payload.
[[nodiscard]] Bytes uu_frame(std::uint16_t type, std::span<const std::uint8_t> payload);

struct UuCommand {
  std::uint16_t type = 0;
  Time whole{};  // when its last byte had come
  Bytes payload;
};

// Finds commands in what the unit is sent. What fails its check is passed over without a word.
class UuReceiver {
 public:
  // Appends what this byte makes whole.
  void take(std::uint8_t byte, Time at, std::vector<UuCommand>& commands);
  // Appends what the time that goes by makes whole: a ping without length and check.
  void pass(Time now, std::vector<UuCommand>& commands);
  void clear() noexcept { held_.clear(); }

 private:
  struct Held {
    std::uint8_t value = 0;
    Time at{};
  };
  enum class Look : std::uint8_t { kMore, kSlide, kShortPing, kWhole };

  [[nodiscard]] Look look() const;
  [[nodiscard]] Bytes held_bytes(std::size_t from, std::size_t count) const;
  void scan(Time at, std::vector<UuCommand>& commands);
  void drop(std::size_t count);

  std::vector<Held> held_;  // at most one frame
};

}  // namespace lodesman::emulated
