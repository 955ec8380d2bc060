// SPDX-License-Identifier: Apache-2.0
// Joins an emulated device to a line of bytes, and gives it its faults by the scenario's time. The
// same calls at the same times give the same bytes. One thread, the one that holds the far end of
// the line.
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/stream/memory_line.h"
#include "hal_sim/emulators/faulty_device.h"
#include "hal_sim/emulators/wire.h"

namespace lodesman {

// Goes on to `now`: the device gets the bytes that `wire` has for it when they are whole, steps,
// and what it says goes onto the wire. Appends what arrives at the host, which may be later than
// `now`. Before it, wire.advance(now) and wire.from_host() for what the host wrote.
void exchange(FaultyDevice& device, EmulatedWire& wire, int host_baud, Time now,
              std::vector<TimedByte>& to_host);

// The same with a line in memory, once a step of whoever drives the world.
class LineFeed {
 public:
  // All of them must outlive it.
  LineFeed(FaultyDevice& device, EmulatedWire& wire, MemoryLine& line) noexcept
      : device_{device}, wire_{wire}, line_{line} {}

  // Time never falls. What a full line does not take is lost.
  void pump(Time now);

 private:
  FaultyDevice& device_;
  EmulatedWire& wire_;
  MemoryLine& line_;
  std::vector<TimedByte> to_host_;
};

// The faults of one device: each begins and ends at its time.
class FaultTimetable {
 public:
  FaultTimetable(const std::vector<Fault>& faults, FaultDevice device);

  // One more, while it runs. Of another device, or none that device or way can have: not taken.
  [[nodiscard]] bool add(const Fault& fault, const FaultyDevice& device, const FaultyWay& way);
  // All that run end at the next advance, and those to come never begin.
  void clear() noexcept;
  void advance(double scenario_time_s, Time now, FaultyDevice& device, FaultyWay& way);

 private:
  enum class State : std::uint8_t { kToCome, kRunning, kOver };
  struct Entry {
    Fault fault;
    State state = State::kToCome;
  };

  FaultDevice device_;
  std::vector<Entry> entries_;
};

}  // namespace lodesman
