// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/knight_search.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>
#include <utility>

#include "low_level/path/moves.h"

namespace lodesman {
namespace {

// A step with what it costs and, as bits of the square of five by five round its start, the pixels
// that must be free for it.
struct Move {
  Step step{};
  std::int32_t cost = 0;
  std::uint32_t needs = 0;
};

constexpr std::uint32_t square_bit(int column, int row) noexcept {
  return 1U << ((row + 2) * 5 + column + 2);
}
constexpr int sign_of(int value) noexcept { return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0); }

constexpr Move move_of(Step step) noexcept {
  const auto [column, row] = step;
  const bool is_knight = column * column + row * row == 5;
  // Halfway along a knight's step lie the pixel beside along the longer axis, and the diagonal one.
  const Step beside = is_knight ? Step{column / 2, row / 2} : Step{column, 0};
  const Step other = is_knight ? Step{sign_of(column), sign_of(row)} : Step{0, row};
  const std::int32_t cost = is_knight                 ? kKnightCost
                            : column != 0 && row != 0 ? kDiagonalCost
                                                      : kStraightCost;
  return {step, cost,
          square_bit(column, row) | square_bit(beside.column, beside.row) |
              square_bit(other.column, other.row)};
}

// Clockwise from straight ahead.
constexpr std::array<Move, 16> kMoves16{
    {move_of({0, -1}), move_of({1, -2}), move_of({1, -1}), move_of({2, -1}), move_of({1, 0}),
     move_of({2, 1}), move_of({1, 1}), move_of({1, 2}), move_of({0, 1}), move_of({-1, 2}),
     move_of({-1, 1}), move_of({-2, 1}), move_of({-1, 0}), move_of({-2, -1}), move_of({-1, -1}),
     move_of({-1, -2})}};

std::uint32_t square_round(const PassableGrid& grid, PathPixel pixel) noexcept {
  std::uint32_t square = 0;
  for (int row = 0; row < 5; ++row) {
    const std::uint64_t five = grid.rows().window(pixel.row + row - 2, pixel.column - 2) & 31U;
    square |= static_cast<std::uint32_t>(five) << (5 * row);
  }
  return square;
}

PathPixel after(PathPixel pixel, const Move& move) noexcept {
  return {static_cast<std::int16_t>(pixel.column + move.step.column),
          static_cast<std::int16_t>(pixel.row + move.step.row)};
}

// H(n) of eq. (1): the cost on an empty map, in the two directions next to the straight line.
std::int32_t estimate(PathPixel a, PathPixel b) noexcept {
  const std::int32_t columns = std::abs(a.column - b.column);
  const std::int32_t rows = std::abs(a.row - b.row);
  const std::int32_t longer = std::max(columns, rows);
  const std::int32_t shorter = std::min(columns, rows);
  return 2 * shorter <= longer
             ? kKnightCost * shorter + kStraightCost * (longer - 2 * shorter)
             : kKnightCost * (longer - shorter) + kDiagonalCost * (2 * shorter - longer);
}

}  // namespace

KnightSearch::KnightSearch(const FanShape& fan, SearchLimits limits)
    : columns_{fan.columns},
      limits_{limits},
      nodes_(static_cast<std::size_t>(fan.columns) * static_cast<std::size_t>(fan.rows)),
      path_(kMaxPathPixels) {}

SearchResult KnightSearch::search(const PassableGrid& grid, PathPixel start,
                                  PathPixel goal) noexcept {
  begin(start);
  push(index_of(goal), goal, 0);
  SearchResult result;
  settle(grid, goal, result);
  if (result.reason == PathReason::kFound) {
    walk(grid, goal, result);
  }
  return result;
}

void KnightSearch::begin(PathPixel start) noexcept {
  if (open_stamp_ >= std::numeric_limits<std::uint32_t>::max() - 4) {
    std::fill(nodes_.begin(), nodes_.end(), Node{});  // once in years: all stamps are used up
    open_stamp_ = 0;
  }
  open_stamp_ += 2;
  heads_.fill(kNone);
  filled_ = 0;
  start_ = start;
}

void KnightSearch::push(std::int32_t index, PathPixel pixel, std::int32_t cost) noexcept {
  const auto bucket = static_cast<std::uint32_t>(cost + estimate(pixel, start_)) / 2 % kBuckets;
  const std::int32_t head = heads_[bucket];
  node(index) = {open_stamp_, cost, head, kNone};
  if (head != kNone) {
    node(head).previous = index;
  }
  heads_[bucket] = index;
  filled_ |= 1U << bucket;
}

void KnightSearch::remove(std::int32_t index, std::int32_t f) noexcept {
  const std::uint32_t bucket = static_cast<std::uint32_t>(f) / 2 % kBuckets;
  const Node& gone = node(index);
  if (gone.next != kNone) {
    node(gone.next).previous = gone.previous;
  }
  if (gone.previous != kNone) {
    node(gone.previous).next = gone.next;
    return;
  }
  heads_[bucket] = gone.next;
  if (gone.next == kNone) {
    filled_ &= ~(1U << bucket);
  }
}

void KnightSearch::reach(PathPixel pixel, std::int32_t cost) noexcept {
  const std::int32_t index = index_of(pixel);
  const Node& known = node(index);
  if (known.stamp == open_stamp_) {
    if (cost < known.cost) {
      remove(index, known.cost + estimate(pixel, start_));
      push(index, pixel, cost);
    }
  } else if (known.stamp != open_stamp_ + 1) {
    push(index, pixel, cost);
  }
}

void KnightSearch::expand(const PassableGrid& grid, std::int32_t index) noexcept {
  const PathPixel pixel = pixel_of(index);
  const std::int32_t cost = node(index).cost;
  const std::uint32_t free = square_round(grid, pixel);
  for (const Move& move : kMoves16) {
    if ((free & move.needs) == move.needs) {
      reach(after(pixel, move), cost + move.cost);
    }
  }
}

// Takes pixels in order of F until the start's cost to the goal is known and nothing in the open
// list could lie on another path of that cost.
void KnightSearch::settle(const PassableGrid& grid, PathPixel goal, SearchResult& result) noexcept {
  const std::int32_t start_index = index_of(start_);
  std::int32_t f = estimate(goal, start_);
  std::int32_t found_cost = std::numeric_limits<std::int32_t>::max();
  while (filled_ != 0) {
    const auto base = static_cast<std::uint32_t>(f) / 2 % kBuckets;
    f += 2 * std::countr_zero(std::rotr(filled_, static_cast<int>(base)));
    if (f > found_cost) {
      break;
    }
    if (result.expansions >= limits_.max_expansions) {
      result.reason = PathReason::kLimit;
      return;
    }
    const std::int32_t index = heads_[static_cast<std::uint32_t>(f) / 2 % kBuckets];
    remove(index, f);
    node(index).stamp = open_stamp_ + 1;
    ++result.expansions;
    if (index == start_index) {
      found_cost = node(index).cost;
    } else {
      expand(grid, index);
    }
  }
  if (found_cost != std::numeric_limits<std::int32_t>::max()) {
    result.reason = PathReason::kFound;
    result.cost_10_14 = found_cost;
  }
}

std::int32_t KnightSearch::cost_to_goal(PathPixel pixel) noexcept {
  const Node& known = node(index_of(pixel));
  return known.stamp >= open_stamp_ ? known.cost : kNone;
}

// The step of the tie-break: to a pixel from which the goal costs just that step less. There is
// one: the pixel's cost was reached from such a neighbour.
PathPixel KnightSearch::next_on_path(const PassableGrid& grid, const TieBreak& rule,
                                     PathPixel pixel) noexcept {
  const std::int32_t cost = cost_to_goal(pixel);
  const std::uint32_t free = square_round(grid, pixel);
  PathPixel best = pixel;
  auto least = std::pair{std::numeric_limits<int>::max(), 0};
  for (const Move& move : kMoves16) {
    const PathPixel next = after(pixel, move);
    if ((free & move.needs) != move.needs || cost_to_goal(next) != cost - move.cost) {
      continue;
    }
    const auto distance = std::pair{TieBreak::key(rule.off(next)), rule.left(next)};
    if (distance < least) {
      least = distance;
      best = next;
    }
  }
  return best;
}

void KnightSearch::walk(const PassableGrid& grid, PathPixel goal, SearchResult& result) noexcept {
  const TieBreak rule{start_, goal};
  PathPixel pixel = start_;
  std::size_t count = 0;
  path_[count++] = pixel;
  while (index_of(pixel) != index_of(goal)) {
    if (count == path_.size()) {
      result = {PathReason::kLimit, 0, result.expansions, {}};
      return;
    }
    pixel = next_on_path(grid, rule, pixel);
    path_[count++] = pixel;
  }
  result.path = std::span<const PathPixel>{path_}.first(count);
}

}  // namespace lodesman
