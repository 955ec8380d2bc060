// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/path/bucket_a_star.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>
#include <utility>

#include "low_level/path/moves.h"

namespace lodesman::testing {
namespace {

constexpr std::int32_t cost_of(int direction) noexcept {
  return is_diagonal(direction) ? kDiagonalCost : kStraightCost;
}

// How far a pixel lies off the line from start to goal, in units of that line's length in pixels;
// positive to starboard of it.
int off_line(PathPixel start, PathPixel goal, PathPixel pixel) noexcept {
  return (pixel.column - start.column) * (start.row - goal.row) -
         (start.row - pixel.row) * (goal.column - start.column);
}

unsigned moves_from(const PassableGrid& grid, PathPixel pixel) noexcept {
  return kMoves[grid.around(pixel.column, pixel.row)];
}

PathPixel after(PathPixel pixel, int direction) noexcept {
  const Step step = kSteps[static_cast<std::size_t>(direction)];
  return {static_cast<std::int16_t>(pixel.column + step.column),
          static_cast<std::int16_t>(pixel.row + step.row)};
}

}  // namespace

BucketAStar::BucketAStar(SearchLimits limits)
    : limits_{limits}, nodes_(std::size_t{kViewRows} << kRowShift), path_(kMaxPathPixels) {
  static_assert(kViewColumns <= 1 << kRowShift);
}

SearchResult BucketAStar::search(const PassableGrid& grid, PathPixel start,
                                 PathPixel goal) noexcept {
  begin_search(start);
  push(index_of(goal), 0);
  SearchResult result = settle(grid, start, goal);
  if (result.reason == PathReason::kFound) {
    walk(grid, goal, result);
  }
  return result;
}

void BucketAStar::begin_search(PathPixel start) noexcept {
  if (open_stamp_ >= std::numeric_limits<std::uint32_t>::max() - 4) {
    std::fill(nodes_.begin(), nodes_.end(), Node{});  // once in years: all stamps are used up
    open_stamp_ = 0;
  }
  open_stamp_ += 2;
  heads_.fill(kNone);
  filled_ = 0;
  start_ = start;
}

std::int32_t BucketAStar::estimate(std::int32_t index) const noexcept {
  const PathPixel pixel = pixel_of(index);
  const std::int32_t dx = std::abs(pixel.column - start_.column);
  const std::int32_t dy = std::abs(pixel.row - start_.row);
  return kStraightCost * std::max(dx, dy) + (kDiagonalCost - kStraightCost) * std::min(dx, dy);
}

void BucketAStar::push(std::int32_t index, std::int32_t cost) noexcept {
  const std::uint32_t bucket = static_cast<std::uint32_t>(cost + estimate(index)) % kBuckets;
  const std::int32_t head = heads_[bucket];
  node(index) = {open_stamp_, cost, head, kNone};
  if (head != kNone) {
    node(head).previous = index;
  }
  heads_[bucket] = index;
  filled_ |= 1U << bucket;
}

void BucketAStar::remove(std::int32_t index, std::int32_t f) noexcept {
  const std::uint32_t bucket = static_cast<std::uint32_t>(f) % kBuckets;
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

void BucketAStar::reach(std::int32_t index, std::int32_t cost) noexcept {
  const Node& known = node(index);
  if (known.stamp == open_stamp_) {
    if (cost < known.cost) {
      remove(index, known.cost + estimate(index));
      push(index, cost);
    }
  } else if (known.stamp != open_stamp_ + 1) {
    push(index, cost);
  }
}

void BucketAStar::expand(const PassableGrid& grid, std::int32_t index) noexcept {
  const PathPixel pixel = pixel_of(index);
  const std::int32_t cost = node(index).cost;
  for (unsigned moves = moves_from(grid, pixel); moves != 0; moves &= moves - 1) {
    const int direction = std::countr_zero(moves);
    reach(index_of(after(pixel, direction)), cost + cost_of(direction));
  }
}

// Takes pixels in order of f until the start's cost to the goal is known and nothing in the open
// list could lie on another path of that cost.
SearchResult BucketAStar::settle(const PassableGrid& grid, PathPixel start,
                                 PathPixel goal) noexcept {
  SearchResult result;
  const std::int32_t start_index = index_of(start);
  std::int32_t f = estimate(index_of(goal));
  std::int32_t found_cost = std::numeric_limits<std::int32_t>::max();
  while (filled_ != 0) {
    const auto base = static_cast<std::uint32_t>(f) % kBuckets;
    f += std::countr_zero(std::rotr(filled_, static_cast<int>(base)));
    if (f > found_cost) {
      break;
    }
    if (result.expansions >= limits_.max_expansions) {
      result.reason = PathReason::kLimit;
      return result;
    }
    const std::int32_t index = heads_[static_cast<std::uint32_t>(f) % kBuckets];
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
  return result;
}

std::int32_t BucketAStar::cost_to_goal(PathPixel pixel) const noexcept {
  const Node& known = nodes_[static_cast<std::size_t>(index_of(pixel))];
  return known.stamp >= open_stamp_ ? known.cost : kNone;
}

// The step of the tie-break: to a pixel from which the goal costs just that step less. There is
// one: the pixel's cost was reached from such a neighbour.
PathPixel BucketAStar::next_on_path(const PassableGrid& grid, PathPixel pixel,
                                    PathPixel goal) const noexcept {
  const unsigned moves = moves_from(grid, pixel);
  const std::int32_t cost = cost_to_goal(pixel);
  PathPixel best = pixel;
  auto least = std::pair{std::numeric_limits<int>::max(), 0};
  for (int direction = 0; direction < kDirections; ++direction) {
    const PathPixel next = after(pixel, direction);
    if ((moves >> direction & 1U) == 0 || cost_to_goal(next) != cost - cost_of(direction)) {
      continue;
    }
    const int off = off_line(start_, goal, next);
    // Doubled, so that of two equally near the one to starboard is a little nearer.
    const int columns = goal.column - next.column;
    const int rows = goal.row - next.row;
    const auto distance =
        std::pair{2 * std::abs(off) - (off > 0 ? 1 : 0), columns * columns + rows * rows};
    if (distance < least) {
      least = distance;
      best = next;
    }
  }
  return best;
}

void BucketAStar::walk(const PassableGrid& grid, PathPixel goal, SearchResult& result) noexcept {
  PathPixel pixel = start_;
  std::size_t count = 0;
  path_[count++] = pixel;
  while (index_of(pixel) != index_of(goal)) {
    if (count == path_.size()) {
      result = {PathReason::kLimit, 0, result.expansions, {}};
      return;
    }
    pixel = next_on_path(grid, pixel, goal);
    path_[count++] = pixel;
  }
  result.path = std::span<const PathPixel>{path_}.first(count);
}

}  // namespace lodesman::testing
