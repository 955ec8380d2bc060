// SPDX-License-Identifier: Apache-2.0
// What every search over the pixels of the sonar view is given and gives. Plain data; any thread.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "mid_level/messages/path.h"

namespace lodesman {

struct SearchLimits {
  // By default no search ends for it.
  std::uint32_t max_expansions = std::numeric_limits<std::uint32_t>::max();  // [-]
};

struct SearchResult {
  PathReason reason = PathReason::kNoPath;
  std::int32_t cost_10_14 = 0;      // [-] tenths of a straight step; 0 where not found
  std::uint32_t expansions = 0;     // [-] taken from the open list
  std::span<const PathPixel> path;  // start to goal; empty where not found
};

}  // namespace lodesman
