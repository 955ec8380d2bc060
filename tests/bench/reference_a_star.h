// SPDX-License-Identifier: Apache-2.0
// A* as a textbook has it, on the finished bitmap: octile heuristic, std::priority_queue, arrays
// with stamps instead of clearing, no corner cutting, the path as every pixel. It stops as soon as
// the goal is taken from the queue. One thread.
#pragma once

#include <cstdint>
#include <vector>

#include "low_level/path/grid.h"
#include "low_level/path/search_result.h"

namespace lodesman::bench {

class ReferenceAStar {
 public:
  explicit ReferenceAStar(const FanShape& fan);

  [[nodiscard]] SearchResult search(const PassableGrid& grid, PathPixel start, PathPixel goal);

  // Of the last search.
  [[nodiscard]] bool has_expanded(int column, int row) const noexcept {
    return nodes_[static_cast<std::size_t>(row * fan_.columns + column)].stamp == stamp_ + 1;
  }

 private:
  struct Node {
    std::uint32_t stamp = 0;  // of the search that reached it; one more once it is expanded
    std::int32_t cost = 0;
    std::int32_t parent = 0;
  };

  FanShape fan_;
  std::vector<Node> nodes_;
  std::vector<PathPixel> path_;
  std::uint32_t stamp_ = 0;
};

}  // namespace lodesman::bench
