// SPDX-License-Identifier: Apache-2.0
// A* pixel by pixel, as plain as it can be while fast enough for thousands of maps: what the tests
// hold JumpPointSearch's costs and paths against. Owned by one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "low_level/path/grid.h"
#include "low_level/path/moves.h"
#include "low_level/path/search_result.h"

namespace lodesman::testing {

// It starts from the goal and goes on until the open list holds nothing as cheap as the found
// cost; the cost of each pixel it reached is then its cost to the goal, and the path is walked
// forwards by the rule of tie_break.h, said here in words of its own.
class BucketAStar {
 public:
  explicit BucketAStar(SearchLimits limits = {});

  // Start and goal must be passable. The path is valid until the next search.
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

}  // namespace lodesman::testing
