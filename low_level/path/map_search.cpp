// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/map_search.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "mid_level/base/check.h"

namespace lodesman {
namespace {

// The square root of 2 as a whole number of 2^-40: sums stay exact and so does every comparison of
// f, and on the longest path of the largest map it is off by a millionth of a cell.
constexpr std::int64_t kOne = std::int64_t{1} << 40;
constexpr std::int64_t kRootOfTwo = 1554944255988;  // the whole number nearest to kOne * sqrt(2)

}  // namespace

PassableMap::PassableMap(int width, int height) : width_{width}, height_{height} {
  LODESMAN_CHECK(width > 0 && height > 0 &&
                 static_cast<std::size_t>(width) <= kMaxCells / static_cast<std::size_t>(height));
  cells_.resize(static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height + 2));
}

std::uint32_t PassableMap::free_cells() const noexcept {
  return static_cast<std::uint32_t>(std::count(cells_.begin(), cells_.end(), 1));
}

std::uint32_t PassableMap::around(MapCell cell) const noexcept {
  std::uint32_t pattern = 0;
  unsigned bit = 0;
  for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
    const std::size_t left = place_of({cell.column - 1, row});
    for (std::size_t i = 0; i < 3; ++i) {
      pattern |= std::uint32_t{cells_[left + i]} << bit++;
    }
  }
  return pattern;
}

double MapSearchResult::cost(MapCosts costs) const noexcept {
  return costs == MapCosts::kPaper ? cost_10_14() / static_cast<double>(kStraightCost)
                                   : straight_steps + diagonal_steps * std::numbers::sqrt2;
}

MapSearch::MapSearch(int width, int height, MapCosts costs)
    : width_{width},
      height_{height},
      straight_{costs == MapCosts::kPaper ? kStraightCost : kOne},
      diagonal_{costs == MapCosts::kPaper ? kDiagonalCost : kRootOfTwo},
      nodes_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

MapSearchResult MapSearch::search(const PassableMap& map, MapCell start, MapCell goal,
                                  std::uint32_t max_expansions) {
  LODESMAN_CHECK(map.width() == width_ && map.height() == height_);
  MapSearchResult result;
  if (!map.passable(start) || !map.passable(goal)) {
    result.reason = map.passable(start) ? PathReason::kGoalBlocked : PathReason::kStartBlocked;
    return result;
  }
  begin_search();
  reach(start, goal, 0, 0);
  while (!open_.empty()) {
    const Open next = open_.front();
    std::pop_heap(open_.begin(), open_.end(), Later{});
    open_.pop_back();
    Node& node = nodes_[next.index];
    if (node.stamp != stamp_) {
      continue;  // expanded already, when it was reached more cheaply
    }
    if (result.expansions >= max_expansions) {
      result.reason = PathReason::kLimit;
      return result;
    }
    node.stamp = stamp_ + 1;
    ++result.expansions;
    const MapCell cell = cell_of(next.index);
    if (cell == goal) {
      result.reason = PathReason::kFound;
      trace(start, goal, result);
      return result;
    }
    expand(map, cell, goal);
  }
  return result;
}

void MapSearch::begin_search() noexcept {
  if (stamp_ >= std::numeric_limits<std::uint32_t>::max() - 4) {
    std::fill(nodes_.begin(), nodes_.end(), Node{});
    stamp_ = 0;
  }
  stamp_ += 2;
  open_.clear();
}

// The cost on an empty map. It never falls by more than a step costs, so that a cell is expanded
// once.
std::int64_t MapSearch::estimate(MapCell cell, MapCell goal) const noexcept {
  const int columns = std::abs(cell.column - goal.column);
  const int rows = std::abs(cell.row - goal.row);
  return straight_ * std::abs(columns - rows) + diagonal_ * std::min(columns, rows);
}

void MapSearch::reach(MapCell cell, MapCell goal, std::int64_t cost, std::uint8_t direction) {
  const std::uint32_t index = index_of(cell);
  Node& node = nodes_[index];
  if (node.stamp == stamp_ + 1 || (node.stamp == stamp_ && node.cost <= cost)) {
    return;
  }
  node = {cost, stamp_, direction};
  open_.push_back({cost + estimate(cell, goal), cost, index});
  std::push_heap(open_.begin(), open_.end(), Later{});
}

void MapSearch::expand(const PassableMap& map, MapCell cell, MapCell goal) {
  const std::int64_t cost = nodes_[index_of(cell)].cost;
  for (unsigned moves = kMoves[map.around(cell)]; moves != 0; moves &= moves - 1) {
    const int direction = std::countr_zero(moves);
    const Step step = kSteps[static_cast<std::size_t>(direction)];
    reach({cell.column + step.column, cell.row + step.row}, goal,
          cost + (is_diagonal(direction) ? diagonal_ : straight_),
          static_cast<std::uint8_t>(direction));
  }
}

void MapSearch::trace(MapCell start, MapCell goal, MapSearchResult& result) const {
  MapCell cell = goal;
  result.path.push_back(cell);
  while (cell != start) {
    const std::uint8_t direction = nodes_[index_of(cell)].direction;
    ++(is_diagonal(direction) ? result.diagonal_steps : result.straight_steps);
    cell = {cell.column - kSteps[direction].column, cell.row - kSteps[direction].row};
    result.path.push_back(cell);
  }
  std::reverse(result.path.begin(), result.path.end());
}

}  // namespace lodesman
