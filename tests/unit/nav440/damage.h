// SPDX-License-Identifier: Apache-2.0
// A stream of headings, 50 a second from a boat in turns of up to 30 degrees a second, some of
// whose bytes are replaced by random ones: what framing and plausibility make of it.
#pragma once

#include <cstdint>

#include "drivers/nav440/packets.h"

namespace lodesman::testing {

struct DamageCounts {
  std::uint64_t frames = 0;         // sent
  std::uint64_t lost_bytes = 0;     // that the framing did not take
  std::uint64_t untouched = 0;      // frames no byte of which was changed
  std::uint64_t crc_right = 0;      // frames that came out as sent
  std::uint64_t recovered = 0;      // of these, those that both gates believe
  std::uint64_t crc_wrong = 0;      // not as sent, though the CRC holds
  std::uint64_t crc_wrong_yaw = 0;  // of these, in the yaw
  std::uint64_t both_wrong = 0;     // believed by both gates, and some bit is not as sent
  double worst_off_deg = 0.0;       // [deg] of a heading that was believed
  // Believed: heading or rate off by more than plausibility ever allows, or put too early.
  std::uint64_t used_wrong = 0;
};

// `share`: of bytes. A1 or N1.
[[nodiscard]] DamageCounts damaged_stream(nav440::PacketType type, double share,
                                          std::uint64_t frames);

}  // namespace lodesman::testing
