// SPDX-License-Identifier: Apache-2.0
// The fields that a NAV440 can be set by, and which values it takes. Plain data; one thread.
#pragma once

#include <array>
#include <cstdint>

namespace lodesman::emulated {

// The fields that the emulated unit obeys; the rest it only keeps.
inline constexpr std::uint16_t kFieldDivider = 0x0001;
inline constexpr std::uint16_t kFieldBaud = 0x0002;
inline constexpr std::uint16_t kFieldPacketType = 0x0003;
inline constexpr std::uint16_t kFieldSoftwareStatusMask = 0x0012;

class Nav440Settings {
 public:
  Nav440Settings(std::uint16_t divider, std::uint16_t baud_code, std::uint16_t packet_type);

  [[nodiscard]] static bool has(std::uint16_t id) noexcept;
  // Of a field that it has.
  [[nodiscard]] std::uint16_t at(std::uint16_t id) const noexcept { return values_[id]; }
  void set(std::uint16_t id, std::uint16_t value) noexcept { values_[id] = value; }

  // Whether a field has such a value at all; of the packet type its owner knows.
  [[nodiscard]] static bool allows(std::uint16_t id, std::uint16_t value) noexcept;
  [[nodiscard]] int baud() const noexcept;
  // Whether a packet with a payload of so many bytes goes over the line as often as is set.
  [[nodiscard]] bool fits(std::size_t payload) const noexcept;

 private:
  static constexpr std::size_t kIds = 0x0016;
  std::array<std::uint16_t, kIds> values_{};
};

}  // namespace lodesman::emulated
