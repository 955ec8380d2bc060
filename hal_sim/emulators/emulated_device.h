// SPDX-License-Identifier: Apache-2.0
// What stands in for a device, to the byte. It is handed the bytes it gets and the time that
// passes, and has neither a clock nor a line of its own, so that the same one serves in lock-step,
// behind a pty and behind a real cable. Written from the makers' manuals alone: it shares no
// constant with the drivers that it is there to test. One thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mid_level/base/time.h"

namespace lodesman {

inline constexpr std::int64_t kBitsAByte = 10;  // on a serial line: 8, a start and a stop

// What a device says, and from when on: a burst of bytes that leaves it without a pause.
struct Utterance {
  Time begins{};
  std::vector<std::uint8_t> bytes;
};

class EmulatedDevice {
 public:
  EmulatedDevice() = default;
  EmulatedDevice(const EmulatedDevice&) = delete;
  EmulatedDevice& operator=(const EmulatedDevice&) = delete;
  virtual ~EmulatedDevice() = default;

  // Goes on to `now`, which never falls; appends what it says meanwhile, in order.
  virtual void step(Time now, std::vector<Utterance>& said) = 0;
  // Bytes that were whole by `at`, after it was stepped to then; appends what it answers at once.
  virtual void receive(std::span<const std::uint8_t> bytes, Time at,
                       std::vector<Utterance>& said) = 0;
  // Off and on again at `now`: what it does not keep is as the maker or its owner set it.
  virtual void power_cycle(Time now) = 0;
  // [Bd] that it speaks and listens at; 0: its line has no speed.
  [[nodiscard]] virtual int baud() const = 0;
};

}  // namespace lodesman
