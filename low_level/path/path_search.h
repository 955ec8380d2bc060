// SPDX-License-Identifier: Apache-2.0
// The cheapest path over the pixels of the sonar view, and always the same one of several.
// Owned by one thread; it allocates when made and never after.
#pragma once

#include <cstdint>
#include <variant>

#include "low_level/path/grid.h"
#include "low_level/path/jump_point_search.h"
#include "low_level/path/knight_search.h"
#include "low_level/path/search_result.h"

namespace lodesman {

// The paper's names: by the directions in a quarter and its border that a path may take.
enum class Geometry : std::uint8_t {
  k4,  // 8 neighbours at 45 degrees, 10 straight and 14 diagonal (moves.h)
  k8,  // 24 neighbours in 16 directions, a knight's step 22 (knight_search.h)
};

class PathSearch {
 public:
  explicit PathSearch(Geometry geometry = Geometry::k4, SearchLimits limits = {},
                      const FanShape& fan = {});

  // The grid must have the fan's shape. Checked in this order: kStartBlocked (also where the start
  // is not in the fan), kGoalOutOfView, kGoalBlocked, kLimit, kNoPath. The cost is the least there
  // is, and the path the one that the rule of tie_break.h takes. It is valid until the next search.
  [[nodiscard]] SearchResult search(const PassableGrid& grid, PathPixel start,
                                    PathPixel goal) noexcept;

 private:
  std::variant<JumpPointSearch, KnightSearch> search_;
};

}  // namespace lodesman
