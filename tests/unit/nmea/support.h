// SPDX-License-Identifier: Apache-2.0
// Sentences as a receiver writes them, and a driver at the other end of a line in memory.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/nmea/nmea_receiver.h"
#include "drivers/stream/memory_line.h"
#include "tests/support/catch.h"
#include "tests/support/fixes_now.h"
#include "tests/unit/nmea/sentence_lines.h"

namespace lodesman::testing {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A receiver at the far end; what it says arrives at once.
class Wired {
 public:
  Wired() { static_cast<void>(driver.poll(now)); }  // what comes before it listens is lost

  void say(std::string_view text) {
    for (const char letter : text) {
      REQUIRE(line.send(static_cast<std::uint8_t>(letter), now));
    }
  }
  void pass(Duration span) { now += span; }

  // All fixes that there are now.
  [[nodiscard]] std::vector<PositionFix> fixes() {
    return testing::fixes_now(driver, now, corrupt, last);
  }
  // What an epoch brings, and a second passes.
  [[nodiscard]] std::vector<PositionFix> fixes_of(const Fixed& fix) {
    say(gga_line(fix) + rmc_line(fix));
    std::vector<PositionFix> given = fixes();
    pass(seconds{1});
    return given;
  }

  Time now{seconds{100}};
  std::unique_ptr<MemoryLine> line_ = std::make_unique<MemoryLine>();
  MemoryLine& line = *line_;
  NmeaReceiver driver{line.near_end(), NmeaOptions{}};
  ReadStatus last = ReadStatus::kNothingNew;
  int corrupt = 0;
};

}  // namespace lodesman::testing
