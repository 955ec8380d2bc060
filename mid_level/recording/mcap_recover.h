// SPDX-License-Identifier: Apache-2.0
// Closes a recording that was cut off: all that is whole in it goes into a new file, which is
// finished as any other. The old one stays as it is. One thread; it allocates.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "mid_level/recording/mcap_reader.h"
#include "mid_level/recording/mcap_writer.h"

namespace lodesman {

struct McapRecovery {
  McapEnding ending = McapEnding::kOpen;  // of the old file
  std::string reason;                     // in words, where it was not whole; else empty
  std::uint64_t messages = 0;             // in the new file
  std::uint64_t chunks = 0;               // whole ones of the old file
  std::uint64_t damaged = 0;              // records and chunks that failed their checks
  std::uint64_t lost_bytes = 0;           // of the old file, behind what could be used
  // [ns] log times of the earliest and the latest message; first > last: there is none.
  std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last_ns = 0;
};

// The writer is finished then, and says itself whether it could write.
[[nodiscard]] McapRecovery recover(McapSource& from, McapWriter& to);

// Reads all of it, and writes nothing.
[[nodiscard]] McapRecovery look_through(McapSource& from);

}  // namespace lodesman
