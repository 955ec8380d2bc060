// SPDX-License-Identifier: Apache-2.0
// The cheapest path of the paper's "8-geometry" (its future work): A* with 16 directions, pixel by
// pixel. Owned by one thread; it allocates when made and never after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "low_level/path/grid.h"
#include "low_level/path/search_result.h"
#include "low_level/path/tie_break.h"

namespace lodesman {

// A knight's step: two pixels along one axis and one along the other, for 22 tenths (2.2 for a
// length of 2.236). It passes between two pixels, those next to its start along the longer axis and
// diagonally, and needs both of them and its end free. The other steps are those of moves.h. With
// these, the 24 pixels of a square of five by five lie in the 16 directions that there are.
inline constexpr std::int32_t kKnightCost = 22;

// It starts from the goal and goes on until the open list holds nothing as cheap as the found
// cost; the cost of each pixel it reached is then its cost to the goal, and the path is walked
// forwards from the start by the rule of tie_break.h. The path names the pixels that steps end on,
// not those that a knight's step passes between.
class KnightSearch {
 public:
  // For grids of this shape.
  explicit KnightSearch(const FanShape& fan = {}, SearchLimits limits = {});

  // As JumpPointSearch::search(); every pixel is expanded once at most.
  [[nodiscard]] SearchResult search(const PassableGrid& grid, PathPixel start,
                                    PathPixel goal) noexcept;

 private:
  static constexpr std::int32_t kNone = -1;
  // All costs are even, F never falls, and a step raises it by no more than twice its cost: 32
  // buckets of F / 2, taken round, hold the whole open list.
  static constexpr std::uint32_t kBuckets = 32;
  static_assert(kKnightCost < static_cast<std::int32_t>(kBuckets));

  // A pixel's record is of this search only where its stamp is open_stamp_ or one more (closed).
  struct Node {
    std::uint32_t stamp = 0;
    std::int32_t cost = 0;      // to the goal
    std::int32_t next = kNone;  // in its bucket
    std::int32_t previous = kNone;
  };

  [[nodiscard]] std::int32_t index_of(PathPixel pixel) const noexcept {
    return pixel.row * columns_ + pixel.column;
  }
  [[nodiscard]] PathPixel pixel_of(std::int32_t index) const noexcept {
    return {static_cast<std::int16_t>(index % columns_),
            static_cast<std::int16_t>(index / columns_)};
  }
  [[nodiscard]] Node& node(std::int32_t index) noexcept { return nodes_.data()[index]; }

  void begin(PathPixel start) noexcept;
  void push(std::int32_t index, PathPixel pixel, std::int32_t cost) noexcept;
  void remove(std::int32_t index, std::int32_t f) noexcept;
  void reach(PathPixel pixel, std::int32_t cost) noexcept;
  void expand(const PassableGrid& grid, std::int32_t index) noexcept;
  void settle(const PassableGrid& grid, PathPixel goal, SearchResult& result) noexcept;
  // Of a pixel that this search has reached; kNone of any other.
  [[nodiscard]] std::int32_t cost_to_goal(PathPixel pixel) noexcept;
  [[nodiscard]] PathPixel next_on_path(const PassableGrid& grid, const TieBreak& rule,
                                       PathPixel pixel) noexcept;
  void walk(const PassableGrid& grid, PathPixel goal, SearchResult& result) noexcept;

  std::int32_t columns_;
  SearchLimits limits_;
  std::vector<Node> nodes_;
  std::vector<PathPixel> path_;
  std::array<std::int32_t, kBuckets> heads_{};
  std::uint32_t filled_ = 0;      // a bit a bucket that is not empty
  std::uint32_t open_stamp_ = 0;  // even
  PathPixel start_;
};

}  // namespace lodesman
