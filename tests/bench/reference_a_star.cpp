// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/reference_a_star.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <functional>
#include <queue>
#include <utility>

#include "low_level/path/moves.h"

namespace lodesman::bench {

ReferenceAStar::ReferenceAStar(const FanShape& fan)
    : fan_{fan},
      nodes_(static_cast<std::size_t>(fan.columns) * static_cast<std::size_t>(fan.rows)) {}

SearchResult ReferenceAStar::search(const PassableGrid& grid, PathPixel start, PathPixel goal) {
  const int columns = fan_.columns;
  Node* const nodes = nodes_.data();
  const auto estimate = [&](int column, int row) {
    const int across = std::abs(column - goal.column);
    const int down = std::abs(row - goal.row);
    return kStraightCost * std::abs(across - down) + kDiagonalCost * std::min(across, down);
  };
  using Entry = std::pair<std::int32_t, std::int32_t>;  // F, pixel
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  stamp_ += 2;
  const int first = start.row * columns + start.column;
  const int last = goal.row * columns + goal.column;
  nodes[first] = {stamp_, 0, first};
  open.emplace(estimate(start.column, start.row), first);
  SearchResult result;
  while (!open.empty()) {
    const std::int32_t at = open.top().second;
    open.pop();
    if (nodes[at].stamp == stamp_ + 1) {
      continue;
    }
    nodes[at].stamp = stamp_ + 1;
    ++result.expansions;
    if (at == last) {
      result.reason = PathReason::kFound;
      result.cost_10_14 = nodes[at].cost;
      break;
    }
    const int column = at % columns;
    const int row = at / columns;
    for (unsigned moves = kMoves[grid.around(column, row)]; moves != 0; moves &= moves - 1) {
      const int direction = std::countr_zero(moves);
      const Step step = kSteps[static_cast<std::size_t>(direction)];
      const int next = at + step.row * columns + step.column;
      const int cost = nodes[at].cost + (is_diagonal(direction) ? kDiagonalCost : kStraightCost);
      const bool is_known = nodes[next].stamp >= stamp_;
      if (!is_known || (nodes[next].stamp == stamp_ && cost < nodes[next].cost)) {
        nodes[next] = {stamp_, cost, at};
        open.emplace(cost + estimate(column + step.column, row + step.row), next);
      }
    }
  }
  path_.clear();
  if (result.reason == PathReason::kFound) {
    for (int at = last;; at = nodes[at].parent) {
      path_.push_back(
          {static_cast<std::int16_t>(at % columns), static_cast<std::int16_t>(at / columns)});
      if (at == first) {
        break;
      }
    }
    std::reverse(path_.begin(), path_.end());
    result.path = path_;
  }
  return result;
}

}  // namespace lodesman::bench
