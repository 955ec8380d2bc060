// SPDX-License-Identifier: Apache-2.0
// Fixes of the places in a NAV440's packets N0 and N1, for the relay. The unit filters its place at
// 100 Hz from a receiver of a few hertz: of its packets kFixPeriod apart one is given, for those
// between say the same error again. Part of the driver, on its thread; nothing allocates.
//
// The packet has no word of its own for a fix. A unit without one says latitude and longitude 0, or
// raises hardwareStatus in its BIT word, which stands for "no 3D fix" among others (which of them
// raise it is set in field 0x0010): then nothing is given. See docs/wire/nav440.md.
#pragma once

#include <cstdint>

#include "drivers/hal/fix_check.h"
#include "drivers/nav440/fix_relay.h"
#include "drivers/nav440/packets.h"

namespace lodesman::nav440 {

class FixMaker {
 public:
  static constexpr Duration kFixPeriod = std::chrono::milliseconds{200};
  static constexpr std::uint16_t kHardwareStatus = 0x0200;

  explicit FixMaker(Nav440FixRelay* relay) noexcept : relay_{relay} {}

  // A packet that is believed, and when it was measured.
  void take(PacketType type, Bytes payload, std::uint16_t bit, Time measured) noexcept;
  // Once a poll: how the unit is.
  void tell(bool is_connected, DeviceFault fault) noexcept;

 private:
  Nav440FixRelay* relay_;  // nullptr: nobody wants positions
  FrozenPosition frozen_;
  Time given_{};
  DeviceFault ails_ = DeviceFault::kNone;
};

}  // namespace lodesman::nav440
