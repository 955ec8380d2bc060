// SPDX-License-Identifier: Apache-2.0
// Whether a unit's measurements have stopped though its packets keep coming. The rates and
// accelerations of a real one flicker in their last bits, at rest too; so one whose every
// measurement repeats to the bit for most of a second is frozen, where nearly each packet of the
// time before differed from the one before it. One that never flickers, as an ideal one at rest, is
// not called frozen. Nothing allocates; one thread.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/nav440/packets.h"

namespace lodesman::nav440 {

class FrozenWatch {
 public:
  explicit FrozenWatch(int rate_hz) noexcept;

  void restart() noexcept;
  // Takes the next packet of one type, of those with a heading; whether it is one of a frozen unit.
  [[nodiscard]] bool frozen(PacketType type, Bytes payload) noexcept;

 private:
  // The measurements alone: neither the time nor the BIT word, which changes by itself.
  [[nodiscard]] bool repeats(PacketType type, Bytes payload) noexcept;

  std::array<std::uint8_t, 64> last_{};
  std::size_t size_ = 0;
  int looked_back_;         // packets
  int repeats_needed_;      // in a row
  std::uint64_t past_ = 0;  // a bit a packet, the newest lowest: whether it differed
  int repeats_ = 0;         // in a row
  bool was_lively_ = false;
};

}  // namespace lodesman::nav440
