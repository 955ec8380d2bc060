// SPDX-License-Identifier: Apache-2.0
// From a record of the Delta T to a ping as everything else knows it, and which of the pings that
// come are news. Nothing allocates; one thread.
#pragma once

#include <optional>

#include "drivers/delta_t/record.h"
#include "mid_level/messages/sonar.h"

namespace lodesman::delta_t {

// Which side of the boat the header's positive bearings are on. Seen from above they are to
// starboard, unless the head hangs the other way round; a bench test with one target tells.
enum class BeamSign : std::uint8_t { kStarboard, kPort };

// All but number and capture time. Its beams go from left to right, whichever way the header's do;
// its ranges are true ones by the header's sound speed.
void fill_ping(const Record& record, BeamSign sign, SonarPing& out) noexcept;

struct PingOrderCounts {
  std::uint64_t repeated = 0;  // [-] pings whose number had come before
  std::uint64_t late = 0;      // [-] that came after a younger one
  std::uint64_t lost = 0;      // [-] numbers that were left out
  std::uint64_t restarts = 0;  // [-] of the numbering
};

// Judges pings by the device's own numbers, which may repeat, be overtaken, jump, or begin anew
// when the program that counts them is started again.
class PingOrder {
 public:
  // A number by so much smaller than the newest is that of a ping that came late, unless the next
  // ones follow from it.
  static constexpr std::uint32_t kMostLate = 16;

  // Our own number of a ping that is news: it rises by one a ping, and by one more for each that
  // was lost. Nothing for one that is to be left out.
  [[nodiscard]] std::optional<std::uint64_t> take(std::uint32_t number) noexcept;
  [[nodiscard]] const PingOrderCounts& counts() const noexcept { return counts_; }

 private:
  std::optional<std::uint32_t> newest_;  // the device's number
  std::optional<std::uint32_t> behind_;  // that of the last one which seemed late
  std::uint64_t given_ = 0;              // ours
  PingOrderCounts counts_;
};

}  // namespace lodesman::delta_t
