// SPDX-License-Identifier: Apache-2.0
// The paper's A* (section 3, eq. (1)) over the pixels of the sonar view, giving a cheapest path and
// always the same one of them. Owned by one thread; it allocates when made and never after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "low_level/path/grid.h"
#include "low_level/path/moves.h"
#include "mid_level/messages/path.h"

namespace lodesman {

struct SearchLimits {
  // Every pixel of the view is taken from the open list once at most, so this default never ends
  // a search.
  std::uint32_t max_expansions = kViewColumns * kViewRows;  // [-]
};

struct SearchResult {
  PathReason reason = PathReason::kNoPath;
  std::int32_t cost_10_14 = 0;      // [-] 0 where not found
  std::uint32_t expansions = 0;     // [-] pixels taken from the open list
  std::span<const PathPixel> path;  // start to goal; empty where not found
};

// Moves are the paper's "4-geometry": 8 neighbours at 45 degrees, 10 straight and 14 diagonal, a
// diagonal step only where both pixels beside it are passable. The cost is the least there is.
//
// Which of several cheapest paths is given (the tie-break):
//   1. From the start on, at every pixel, the step is taken that ends nearest to the straight line
//      from start to goal, among the steps that lie on any cheapest path.
//   2. Where two steps end equally near, it is the one that ends to starboard of the line; of two
//      on one side, the one that ends nearer to the goal.
//
// Why: a cheapest path of eight directions may lie anywhere in a wide parallelogram; this one keeps
// to the straight line and leaves it only where an obstacle makes it. A vehicle that follows it
// heads for the goal, turns for an obstacle as late as costs nothing, and turns back as soon as it
// is past, as the paper's does (section 4.4: at 26 s it is nearly at the protection circle and
// still takes a new side; 20.9 m in all for a goal 20 m away). Starboard is the side that boats
// meeting head-on take.
//
// The rule speaks of the map, start and goal alone, not of a search: any search that knows the
// exact cost to the goal of the pixels on cheapest paths can follow it. This one starts from the
// goal and goes on until the open list holds nothing as cheap as the found cost; the cost of each
// pixel it reached is then its cost to the goal, and the path is walked forwards from the start.
class AStar {
 public:
  explicit AStar(SearchLimits limits = {});

  // Checked in this order: kStartBlocked (also where the start is not in the fan), kGoalOutOfView,
  // kGoalBlocked, kLimit, kNoPath. The result's path is valid until the next search.
  [[nodiscard]] SearchResult search(const PassableGrid& grid, PathPixel start,
                                    PathPixel goal) noexcept;

 private:
  // Pixels are numbered row * 1024 + column.
  static constexpr int kRowShift = 10;
  static constexpr std::int32_t kNone = -1;
  // f never falls and rises by at most two diagonals a step: 32 buckets, taken round, hold the
  // whole open list.
  static constexpr std::uint32_t kBuckets = 32;
  static_assert(2 * kDiagonalCost < static_cast<std::int32_t>(kBuckets));

  // A pixel's record is of this search only where its stamp is open_stamp_ or one more (closed).
  struct Node {
    std::uint32_t stamp = 0;
    std::int32_t cost = 0;      // to the goal
    std::int32_t next = kNone;  // in its bucket
    std::int32_t previous = kNone;
  };

  [[nodiscard]] static std::int32_t index_of(PathPixel pixel) noexcept {
    return (std::int32_t{pixel.row} << kRowShift) + pixel.column;
  }
  [[nodiscard]] static PathPixel pixel_of(std::int32_t index) noexcept {
    return {static_cast<std::int16_t>(index & ((1 << kRowShift) - 1)),
            static_cast<std::int16_t>(index >> kRowShift)};
  }
  [[nodiscard]] Node& node(std::int32_t index) noexcept {
    return nodes_[static_cast<std::size_t>(index)];
  }

  void begin_search(PathPixel start) noexcept;
  // H(n) of eq. (1): the cost to the start on an empty map.
  [[nodiscard]] std::int32_t estimate(std::int32_t index) const noexcept;
  void push(std::int32_t index, std::int32_t cost) noexcept;
  void remove(std::int32_t index, std::int32_t f) noexcept;
  void reach(std::int32_t index, std::int32_t cost) noexcept;
  void expand(const PassableGrid& grid, std::int32_t index) noexcept;
  [[nodiscard]] SearchResult settle(const PassableGrid& grid, PathPixel start,
                                    PathPixel goal) noexcept;
  // Of a pixel that this search has reached; kNone of any other.
  [[nodiscard]] std::int32_t cost_to_goal(PathPixel pixel) const noexcept;
  [[nodiscard]] PathPixel next_on_path(const PassableGrid& grid, PathPixel pixel,
                                       PathPixel goal) const noexcept;
  void walk(const PassableGrid& grid, PathPixel goal, SearchResult& result) noexcept;

  SearchLimits limits_;
  std::vector<Node> nodes_;
  std::vector<PathPixel> path_;
  std::array<std::int32_t, kBuckets> heads_{};
  std::uint32_t filled_ = 0;      // a bit a bucket that is not empty
  std::uint32_t open_stamp_ = 0;  // even
  PathPixel start_;
};

}  // namespace lodesman
