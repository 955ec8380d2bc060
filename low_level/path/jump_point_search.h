// SPDX-License-Identifier: Apache-2.0
// The cheapest path of the paper's "4-geometry" (moves.h) by jump point search: A* (the paper's
// section 3, eq. (1)) that looks at corners instead of pixels. Owned by one thread; it allocates
// when made and never after.
#pragma once

#include <cstdint>
#include <vector>

#include "low_level/path/bucket_queue.h"
#include "low_level/path/grid.h"
#include "low_level/path/joined.h"
#include "low_level/path/jump_points.h"
#include "low_level/path/path_walk.h"
#include "low_level/path/search_result.h"

namespace lodesman {

// In open water all orders of the same steps cost the same, so one order is enough: diagonal steps
// first, then straight ones. A path in that order changes its mind only where an obstacle's corner
// makes it, at a jump point: a pixel reached by a straight step, beside which a pixel is free and
// the one before that was blocked. The search goes from jump point to jump point. From one it runs
// out along the directions that can be of use; a run over 64 pixels is a few operations on words
// (BitLines). docs/search.md explains it with more room.
//
// The search starts from the goal and goes on until nothing in the open list is as cheap as the
// found cost. Then the cost to the goal of every pixel on any cheapest path is known from the jump
// points in view of it, and PathWalk follows the rule of tie_break.h from the start, exactly.
class JumpPointSearch {
 public:
  // For grids of this shape.
  explicit JumpPointSearch(const FanShape& fan = {}, SearchLimits limits = {});

  // Start and goal must be passable. Ends as kFound, kNoPath or kLimit: more expansions than
  // allowed, a path of more than kMaxPathPixels, or no room for what was reached. The path is valid
  // until the next search.
  [[nodiscard]] SearchResult search(const PassableGrid& grid, PathPixel start,
                                    PathPixel goal) noexcept;

  // Of the last search, for pictures.
  [[nodiscard]] const JumpPoints& jump_points() const noexcept { return points_; }

 private:
  using Directions = std::uint8_t;  // a bit a direction of kSteps

  // What the open list holds: a jump point to expand, or one of its diagonals to run further along.
  struct Open {
    std::int32_t point = 0;
    std::int32_t diagonal = -1;  // the direction; none: expand the point
  };
  void begin(const PassableGrid& grid, PathPixel start, PathPixel goal) noexcept;
  [[nodiscard]] PathReason settle(PathPixel goal, std::uint32_t& expansions) noexcept;
  void expand(std::int32_t point) noexcept;
  void run(std::int32_t point, int direction) noexcept;
  template <int kDirection>
  void run_straight(std::int32_t point, PathPixel from, std::int32_t cost) noexcept;
  template <int kDirection>
  void run_diagonal(std::int32_t point) noexcept;
  template <int kDirection>
  [[nodiscard]] int free_diagonal(PathPixel from) const noexcept;
  [[nodiscard]] int fan_diagonal(PathPixel from, int direction) const noexcept;
  void reach_start(std::int32_t from, std::int32_t cost) noexcept;
  void reach(std::int32_t from, PathPixel pixel, std::int32_t cost, Directions directions) noexcept;
  void push(PathPixel at, std::int32_t cost, Open open) noexcept;

  FanShape fan_;
  SearchLimits limits_;
  // The columns in which a diagonal lies in the fan with both its sides, less the last: of those
  // that rise by column + row, of those that fall by column - row + rows.
  std::vector<LineSpan> rising_;
  std::vector<LineSpan> falling_;

  const PassableGrid* grid_ = nullptr;  // during a search
  PathPixel start_;
  std::int32_t best_ = 0;                       // cost of the cheapest path so far
  std::int32_t came_from_ = JumpPoints::kNone;  // the first of the start's arrivals at that cost
  bool full_ = false;                           // something had no room
  BucketQueue<Open> open_;
  JumpPoints points_;
  Joined joined_;
  PathWalk walk_;
};

}  // namespace lodesman
