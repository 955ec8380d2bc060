// SPDX-License-Identifier: Apache-2.0
// The moves of the paper's "4-geometry", said once for every search: 8 neighbours at 45 degrees, a
// diagonal step only where both places beside it are passable. Constants; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lodesman {

inline constexpr std::int32_t kStraightCost = 10;
inline constexpr std::int32_t kDiagonalCost = 14;

inline constexpr int kDirections = 8;

// Clockwise from straight ahead, so that odd directions are diagonals.
struct Step {
  int column;
  int row;
};
inline constexpr std::array<Step, kDirections> kSteps{
    {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};

[[nodiscard]] constexpr bool is_diagonal(int direction) noexcept { return direction % 2 != 0; }

[[nodiscard]] constexpr std::array<std::uint8_t, 512> make_moves() noexcept {
  std::array<std::uint8_t, 512> moves{};
  for (unsigned pattern = 0; pattern < moves.size(); ++pattern) {
    const auto free = [pattern](int column, int row) {
      return (pattern >> ((row + 1) * 3 + column + 1) & 1U) != 0;
    };
    unsigned allowed = 0;
    for (unsigned d = 0; d < kDirections; ++d) {
      const Step step = kSteps[d];
      if (free(step.column, step.row) && free(step.column, 0) && free(0, step.row)) {
        allowed |= 1U << d;
      }
    }
    moves[pattern] = static_cast<std::uint8_t>((pattern >> 4 & 1U) != 0 ? allowed : 0);
  }
  return moves;
}

// A bit a direction in which a step may be taken, for each pattern of the nine places round one:
// bits 0-2 the row above from left to right, 3-5 its own row (4: itself), 6-8 the row below.
inline constexpr std::array<std::uint8_t, 512> kMoves = make_moves();

}  // namespace lodesman
