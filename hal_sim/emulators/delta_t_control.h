// SPDX-License-Identifier: Apache-2.0
// What the Delta T's program can be told from outside, and the datagram of 256 bytes that tells it.
// From the maker's sample program's text. Pure functions; any thread.
#pragma once

#include <cstdint>
#include <span>

namespace lodesman::emulated {

struct DeltaTSettings {
  std::uint16_t range_m = 30;
  int gain_db = 10;  // [0, 20]
  std::uint16_t sector_deg = 120;
  std::uint16_t beams = 120;
  int averaged = 0;  // [0, 10] pings; 0 and 1: none
  double sound_speed_m_s = 1500.0;
  bool transmits = true;
  bool sends_image = true;  // 83B, else 83P
  bool profile_points = true;
  int profile_least_range_m = 0;
  int profile_least_level_percent = 30;
  int tilt_deg = 0;
};

// Sets what the datagram says; a byte whose value stands for nothing changes nothing. False, and
// nothing changed, where it is no such datagram.
[[nodiscard]] bool obey(std::span<const std::uint8_t> datagram, DeltaTSettings& settings) noexcept;

}  // namespace lodesman::emulated
