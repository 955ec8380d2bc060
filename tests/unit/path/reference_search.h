// SPDX-License-Identifier: Apache-2.0
// What the tests of low_level/path hold its search against: a plain Dijkstra, the tie-break rule
// written out anew, and a walk over a path that trusts nothing. Test threads only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "low_level/path/grid.h"
#include "low_level/path/pixel_steps.h"
#include "mid_level/messages/path.h"

namespace lodesman::testing {

// A rectangle of the view, in which alone the reference looks.
struct Window {
  int column = 0;
  int row = 0;
  int columns = kViewColumns;
  int rows = kViewRows;

  [[nodiscard]] bool holds(PathPixel pixel) const {
    return pixel.column >= column && pixel.column < column + columns && pixel.row >= row &&
           pixel.row < row + rows;
  }
  [[nodiscard]] std::size_t index(PathPixel pixel) const {
    return static_cast<std::size_t>((pixel.row - row) * columns + pixel.column - column);
  }
};

inline constexpr int kUnreached = -1;

// The cost of each of the window's pixels to the goal; kUnreached where there is no way.
[[nodiscard]] std::vector<int> dijkstra(const PassableGrid& grid, const Window& window,
                                        PathPixel goal);

// The same with knight's steps (Geometry::k8), under its costs.
[[nodiscard]] std::vector<int> dijkstra_16(const PassableGrid& grid, const Window& window,
                                           PathPixel goal);

// The path that the rule in tie_break.h chooses, given the costs to the goal; empty where none.
[[nodiscard]] std::vector<PathPixel> path_by_rule(const PassableGrid& grid, const Window& window,
                                                  const std::vector<int>& cost_to_goal,
                                                  PathPixel start, PathPixel goal);

// Fails the running test unless the path leads from start to goal over passable pixels, step by
// neighbouring step, cutting no corner, at just this cost.
void require_walkable(const PassableGrid& grid, std::span<const PathPixel> path, PathPixel start,
                      PathPixel goal, std::int32_t cost);

[[nodiscard]] PathPixel pixel(int column, int row);
using lodesman::same;
[[nodiscard]] bool same(std::span<const PathPixel> l, std::span<const PathPixel> r);

}  // namespace lodesman::testing
