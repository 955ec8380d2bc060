// SPDX-License-Identifier: Apache-2.0
// Which of several cheapest paths is given. Pure functions; any thread.
//
//   1. From the start on, at every pixel, the step is taken that ends nearest to the straight line
//      from start to goal, among the steps that lie on any cheapest path.
//   2. Where two steps end equally near, it is the one that ends to starboard of the line; of two
//      on one side, the one that ends nearer to the goal.
//
// Why: a cheapest path of a few directions may lie anywhere in a wide parallelogram; this one keeps
// to the straight line and leaves it only where an obstacle makes it. A vehicle that follows it
// heads for the goal, turns for an obstacle as late as costs nothing, and turns back as soon as it
// is past, as the paper's does (section 4.4: at 26 s it is nearly at the protection circle and
// still takes a new side; 20.9 m in all for a goal 20 m away). Starboard is the side that boats
// meeting head-on take.
//
// The rule speaks of the map, start and goal alone, not of a search: every search that can tell
// whether a step lies on a cheapest path gives the same path.
#pragma once

#include <cstdlib>

#include "mid_level/messages/path.h"

namespace lodesman {

class TieBreak {
 public:
  TieBreak(PathPixel start, PathPixel goal) noexcept
      : start_{start},
        goal_{goal},
        across_{goal.column - start.column},
        ahead_{start.row - goal.row} {}

  // How far a step's end lies off the line, in units that grow with the line's length; positive to
  // starboard of it. A step of (columns, rows) changes it by change_off().
  [[nodiscard]] int off(PathPixel end) const noexcept {
    return (end.column - start_.column) * ahead_ - (start_.row - end.row) * across_;
  }
  [[nodiscard]] int change_off(int columns, int rows) const noexcept {
    return columns * ahead_ + rows * across_;
  }

  // The first key of the rule: doubled, so that of two equally near the one to starboard is a
  // little nearer.
  [[nodiscard]] static int key(int off) noexcept { return 2 * std::abs(off) - (off > 0 ? 1 : 0); }
  // The second.
  [[nodiscard]] int left(PathPixel end) const noexcept {
    const int columns = goal_.column - end.column;
    const int rows = goal_.row - end.row;
    return columns * columns + rows * rows;
  }

 private:
  PathPixel start_;
  PathPixel goal_;
  int across_;
  int ahead_;
};

}  // namespace lodesman
