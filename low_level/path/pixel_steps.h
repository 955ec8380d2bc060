// SPDX-License-Identifier: Apache-2.0
// Steps between pixels, and what an empty map would make of the way between two. Pure functions;
// any thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "low_level/path/moves.h"
#include "mid_level/messages/path.h"

namespace lodesman {

[[nodiscard]] constexpr bool same(PathPixel a, PathPixel b) noexcept {
  return a.column == b.column && a.row == b.row;
}
[[nodiscard]] constexpr Step step_of(int direction) noexcept {
  return kSteps[static_cast<std::size_t>(direction)];
}
[[nodiscard]] constexpr std::int32_t cost_of(int direction) noexcept {
  return is_diagonal(direction) ? kDiagonalCost : kStraightCost;
}
[[nodiscard]] constexpr PathPixel moved(PathPixel from, Step step, int steps) noexcept {
  return {static_cast<std::int16_t>(from.column + step.column * steps),
          static_cast<std::int16_t>(from.row + step.row * steps)};
}
[[nodiscard]] constexpr PathPixel moved(PathPixel from, int direction, int steps) noexcept {
  return moved(from, step_of(direction), steps);
}

// H(n) of eq. (1): the cost between two pixels on an empty map.
[[nodiscard]] inline std::int32_t octile(PathPixel a, PathPixel b) noexcept {
  const std::int32_t columns = std::abs(a.column - b.column);
  const std::int32_t rows = std::abs(a.row - b.row);
  return kStraightCost * std::max(columns, rows) +
         (kDiagonalCost - kStraightCost) * std::min(columns, rows);
}

// In one direction, or the same.
[[nodiscard]] constexpr bool is_line(PathPixel a, PathPixel b) noexcept {
  const int columns = a.column - b.column;
  const int rows = a.row - b.row;
  return columns == 0 || rows == 0 || columns == rows || columns == -rows;
}
[[nodiscard]] constexpr int opposite(int direction) noexcept { return (direction + 4) % 8; }

// The steps by which an empty map is crossed from one pixel to another at that cost.
struct Way {
  int straight;  // the direction; one of the two beside the diagonal where there are no straights
  int straights;
  int diagonal;  // the direction; one of the two beside the straight where there are no diagonals
  int diagonals;

  Way(PathPixel from, PathPixel to) noexcept {
    const int columns = to.column - from.column;
    const int rows = to.row - from.row;
    diagonals = std::min(std::abs(columns), std::abs(rows));
    straights = std::max(std::abs(columns), std::abs(rows)) - diagonals;
    diagonal =
        columns > 0 ? 3 - 2 * static_cast<int>(rows < 0) : 7 - 2 * static_cast<int>(rows > 0);
    straight = std::abs(columns) > std::abs(rows) ? 6 - 4 * static_cast<int>(columns > 0)
                                                  : 4 * static_cast<int>(rows > 0);
  }
  // A bit a direction that is of use.
  [[nodiscard]] unsigned directions() const noexcept {
    return static_cast<unsigned>(straights > 0) << straight | static_cast<unsigned>(diagonals > 0)
                                                                  << diagonal;
  }
  void take(int direction) noexcept {
    straights -= direction == straight ? 1 : 0;
    diagonals -= direction == diagonal ? 1 : 0;
  }
};

}  // namespace lodesman
