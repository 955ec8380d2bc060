// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/path_search.h"

namespace lodesman {

PathSearch::PathSearch(Geometry geometry, SearchLimits limits, const FanShape& fan)
    : search_{std::in_place_type<JumpPointSearch>, fan, limits} {
  if (geometry == Geometry::k8) {
    search_.emplace<KnightSearch>(fan, limits);
  }
}

SearchResult PathSearch::search(const PassableGrid& grid, PathPixel start,
                                PathPixel goal) noexcept {
  if (!grid.passable(start.column, start.row)) {
    return {PathReason::kStartBlocked, 0, 0, {}};
  }
  if (!grid.fan().holds(goal.column, goal.row)) {
    return {PathReason::kGoalOutOfView, 0, 0, {}};
  }
  if (!grid.passable(goal.column, goal.row)) {
    return {PathReason::kGoalBlocked, 0, 0, {}};
  }
  if (auto* jumps = std::get_if<JumpPointSearch>(&search_)) {
    return jumps->search(grid, start, goal);
  }
  auto* knights = std::get_if<KnightSearch>(&search_);
  return knights != nullptr ? knights->search(grid, start, goal) : SearchResult{};
}

}  // namespace lodesman
