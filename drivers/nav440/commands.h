// SPDX-License-Identifier: Apache-2.0
// What a host says to a NAV440: whole frames, ready for the line. Nothing allocates. Any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "drivers/nav440/packets.h"

namespace lodesman::nav440 {

// Of the unit's fields, those that a driver has to do with.
inline constexpr std::uint16_t kRateDivider = 0x0001;  // 0: it says nothing by itself
inline constexpr std::uint16_t kSpeedCode = 0x0002;
inline constexpr std::uint16_t kContinuousType = 0x0003;

// Packets leave at this rate by the divider.
inline constexpr int kFullRate_hz = 100;

struct Field {
  std::uint16_t id = 0;
  std::uint16_t value = 0;
};

class Command {
 public:
  static constexpr std::size_t kMostFields = 8;

  [[nodiscard]] Bytes bytes() const noexcept { return Bytes{bytes_}.first(size_); }

  [[nodiscard]] static Command ping() noexcept;
  [[nodiscard]] static Command get_packet(PacketType wanted) noexcept;
  // At once, until its power goes; at most kMostFields of them, as with the others.
  [[nodiscard]] static Command set_fields(std::initializer_list<Field> fields) noexcept;
  [[nodiscard]] static Command get_fields(std::initializer_list<std::uint16_t> ids) noexcept;
  // Of what it keeps without power. The driver never writes it: it wears out.
  [[nodiscard]] static Command write_fields(std::initializer_list<Field> fields) noexcept;
  [[nodiscard]] static Command read_fields(std::initializer_list<std::uint16_t> ids) noexcept;

 private:
  Command(PacketType type, std::size_t payload) noexcept;
  [[nodiscard]] static Command of_fields(PacketType type,
                                         std::initializer_list<Field> fields) noexcept;
  [[nodiscard]] static Command of_ids(PacketType type,
                                      std::initializer_list<std::uint16_t> ids) noexcept;
  void append(std::uint8_t byte) noexcept { bytes_[size_++] = byte; }
  void append_word(std::uint16_t word) noexcept;
  [[nodiscard]] Command& closed() noexcept;

  std::array<std::uint8_t, 8 + 4 * kMostFields> bytes_{};
  std::size_t size_ = 0;
};

// [-] the value of kSpeedCode for a speed in Bd; none where the unit has no such speed.
[[nodiscard]] std::optional<std::uint16_t> speed_code(int baud) noexcept;

}  // namespace lodesman::nav440
