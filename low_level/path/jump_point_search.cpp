// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/jump_point_search.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>

#include "low_level/path/pixel_steps.h"

namespace lodesman {
namespace {

// A diagonal is run along so many pixels at a time: as many lines as a word has bits.
constexpr int kStretch = 64;
// Searches that end do so after about as many expansions; one that does not is worth asking
// whether there is a path at all.
constexpr std::uint32_t kExpansionsBeforeDoubt = 96;
constexpr std::int32_t kNoCost = std::numeric_limits<std::int32_t>::max();

constexpr std::uint8_t bit_of(int direction) noexcept {
  return static_cast<std::uint8_t>(1U << (direction & 7));
}
template <int kWay>
std::uint64_t only_first(std::uint64_t lines, int count) noexcept {
  return count >= 64
             ? lines
             : lines & (kWay > 0 ? ~(~std::uint64_t{0} << count) : ~(~std::uint64_t{0} >> count));
}
// How many lines away the nearest one is.
template <int kWay>
int nearest(std::uint64_t lines) noexcept {
  return 1 + (kWay > 0 ? std::countr_zero(lines) : std::countl_zero(lines));
}
template <int kWay>
std::uint64_t line_bit(int away) noexcept {
  return kWay > 0 ? std::uint64_t{1} << (away - 1) : ~(~std::uint64_t{0} >> 1) >> (away - 1);
}

}  // namespace

JumpPointSearch::JumpPointSearch(const FanShape& fan, SearchLimits limits)
    : fan_{fan},
      limits_{limits},
      rising_(static_cast<std::size_t>(fan.columns + fan.rows), {fan.columns, -1}),
      falling_(rising_),
      open_{static_cast<std::uint32_t>(kStraightCost * std::max(fan.columns, fan.rows) +
                                       kDiagonalCost * kStretch),
            static_cast<std::size_t>(fan.columns) * static_cast<std::size_t>(fan.rows)},
      points_{static_cast<std::size_t>(fan.columns) * static_cast<std::size_t>(fan.rows)},
      joined_{fan.rows, fan.columns},
      walk_{static_cast<std::size_t>(fan.columns) * static_cast<std::size_t>(fan.rows)} {
  for (int row = 0; row < fan.rows; ++row) {
    for (int column = 0; column + 1 < fan.columns; ++column) {
      const bool both = fan.holds(column, row) && fan.holds(column + 1, row);
      const auto widen = [column](LineSpan& span) {
        span = {std::min(span.first, column), std::max(span.last, column)};
      };
      if (both && fan.holds(column, row - 1) && fan.holds(column + 1, row - 1)) {
        widen(rising_[static_cast<std::size_t>(column + row)]);
      }
      if (both && fan.holds(column, row + 1) && fan.holds(column + 1, row + 1)) {
        widen(falling_[static_cast<std::size_t>(column - row + fan.rows)]);
      }
    }
  }
}

SearchResult JumpPointSearch::search(const PassableGrid& grid, PathPixel start,
                                     PathPixel goal) noexcept {
  begin(grid, start, goal);
  SearchResult result;
  result.reason = settle(goal, result.expansions);
  if (result.reason == PathReason::kFound) {
    result.path = walk_.walk(grid, points_, came_from_, {start, goal, best_});
    result.reason = result.path.empty() ? PathReason::kLimit : PathReason::kFound;
    result.cost_10_14 = result.path.empty() ? 0 : best_;
  }
  return result;
}

void JumpPointSearch::begin(const PassableGrid& grid, PathPixel start, PathPixel goal) noexcept {
  grid_ = &grid;
  start_ = start;
  best_ = same(start, goal) ? 0 : kNoCost;
  came_from_ = JumpPoints::kNone;
  full_ = false;
  open_.clear();
  points_.clear();
  reach(JumpPoints::kNone, goal, 0, 0xFF);
}

// Takes jump points in order of F until nothing in the open list could lie on a path as cheap as
// the one that is known.
PathReason JumpPointSearch::settle(PathPixel goal, std::uint32_t& expansions) noexcept {
  std::uint32_t key = static_cast<std::uint32_t>(octile(goal, start_)) / 2;
  Open next;
  while (open_.pop(key, key, next) && static_cast<std::int64_t>(key) * 2 <= best_) {
    if (next.diagonal >= 0) {
      run(next.point, next.diagonal);
      continue;
    }
    if (points_[next.point].todo == 0) {
      continue;  // expanded already, when it was reached more cheaply
    }
    if (expansions >= limits_.max_expansions) {
      return PathReason::kLimit;
    }
    if (++expansions == kExpansionsBeforeDoubt && best_ == kNoCost &&
        !joined_.joined(grid_->rows(), goal.row, goal.column, start_.row, start_.column)) {
      return PathReason::kNoPath;
    }
    expand(next.point);
  }
  if (full_) {
    return PathReason::kLimit;
  }
  return best_ == kNoCost ? PathReason::kNoPath : PathReason::kFound;
}

void JumpPointSearch::expand(std::int32_t point) noexcept {
  JumpPoint& own = points_[point];
  const Directions todo = own.todo;
  own.todo = 0;
  own.done |= todo;
  for (unsigned rest = todo; rest != 0; rest &= rest - 1) {
    run(point, std::countr_zero(rest));
  }
}

void JumpPointSearch::run(std::int32_t point, int direction) noexcept {
  const PathPixel from = points_[point].pixel;
  const std::int32_t cost = points_[point].cost;
  switch (direction) {
    case 0: return run_straight<0>(point, from, cost);
    case 1: return run_diagonal<1>(point);
    case 2: return run_straight<2>(point, from, cost);
    case 3: return run_diagonal<3>(point);
    case 4: return run_straight<4>(point, from, cost);
    case 5: return run_diagonal<5>(point);
    case 6: return run_straight<6>(point, from, cost);
    default: return run_diagonal<7>(point);
  }
}

template <int kDirection>
void JumpPointSearch::run_straight(std::int32_t point, PathPixel from, std::int32_t cost) noexcept {
  constexpr bool kAlongRow = kDirection == 2 || kDirection == 6;
  constexpr int kWay = kDirection == 2 || kDirection == 4 ? 1 : -1;
  const BitLines& lines = kAlongRow ? grid_->rows() : grid_->columns();
  const int line = kAlongRow ? from.row : from.column;
  const int place = kAlongRow ? from.column : from.row;
  const int stop = lines.next_stop<kWay>(line, place);
  const auto cost_at = [&](int to) { return cost + kStraightCost * std::abs(to - place); };

  const int start_place = kAlongRow ? start_.column : start_.row;
  if (line == (kAlongRow ? start_.row : start_.column) && kWay * (start_place - place) > 0 &&
      (stop == BitLines::kNone || kWay * (stop - start_place) >= 0)) {
    reach_start(point, cost_at(start_place));
    return;
  }
  if (stop == BitLines::kNone || !lines.is_free(line, stop)) {
    return;
  }
  const auto opens = [&](int side) {
    return lines.is_free(line + side, stop) && !lines.is_free(line + side, stop - kWay);
  };
  // The lines on one side and the other are the directions a quarter turn away.
  constexpr int kBefore = kAlongRow ? 0 : 6;
  constexpr int kAfter = kAlongRow ? 4 : 2;
  constexpr auto between = [](int side) {
    return (side + 2) % 8 == kDirection ? (side + 1) % 8 : (side + 7) % 8;
  };
  unsigned directions = bit_of(kDirection);
  directions |= opens(-1) ? bit_of(kBefore) | bit_of(between(kBefore)) : 0U;
  directions |= opens(1) ? bit_of(kAfter) | bit_of(between(kAfter)) : 0U;
  const PathPixel pixel = moved(from, kDirection, std::abs(stop - place));
  reach(point, pixel, cost_at(stop), static_cast<Directions>(directions));
}

// How many steps a diagonal stays in the fan.
int JumpPointSearch::fan_diagonal(PathPixel from, int direction) const noexcept {
  const bool rises = direction == 1 || direction == 5;
  const LineSpan steps = rises ? rising_.data()[from.column + from.row]
                               : falling_.data()[from.column - from.row + fan_.rows];
  if (step_of(direction).column > 0) {
    return from.column < steps.first || from.column > steps.last ? 0 : steps.last + 1 - from.column;
  }
  const int last = from.column - 1;
  return last < steps.first || last > steps.last ? 0 : from.column - steps.first;
}

// How many steps from a pixel along a diagonal are free, up to kStretch.
template <int kDirection>
int JumpPointSearch::free_diagonal(PathPixel from) const noexcept {
  constexpr int kAcross = step_of(kDirection).column;
  constexpr int kDown = step_of(kDirection).row;
  const BitLines& rows = grid_->rows();
  const int count = std::min(kStretch, fan_diagonal(from, kDirection));
  // Of the row that a step ends in: the pixel that it ends at and the one beside it; and the one
  // beside the next step.
  constexpr int kNext = kAcross > 0 ? 2 : 0;
  constexpr unsigned kHere = kAcross > 0 ? 3U : 6U;
  const auto around = [&](int steps) {
    return rows.window(from.row + kDown * steps, from.column + kAcross * steps - 1);
  };
  if ((around(0) >> kNext & 1U) == 0) {
    return 0;
  }
  const int word = from.column >> 6;
  const int other = (from.column + kAcross * count) >> 6;
  std::uint64_t crowded = only_first<kDown>(
      rows.crowd<kDown>(from.row, word) | rows.crowd<kDown>(from.row, other), count);
  while (crowded != 0) {
    const int steps = nearest<kDown>(crowded);
    crowded &= ~line_bit<kDown>(steps);
    const std::uint64_t free = around(steps);
    if ((free & 7U) != 7U) {
      return (free & kHere) != kHere ? steps - 1 : steps;
    }
  }
  return count;
}

template <int kDirection>
void JumpPointSearch::run_diagonal(std::int32_t point) noexcept {
  constexpr int kAcross = step_of(kDirection).column;
  constexpr int kDown = step_of(kDirection).row;
  constexpr int kSideways = kAcross > 0 ? 2 : 6;
  constexpr int kUpright = kDown > 0 ? 4 : 0;
  JumpPoint& own = points_[point];
  const int before = own.reach[kDirection / 2];
  const PathPixel begin = moved(own.pixel, kDirection, before);
  const std::int32_t cost = own.cost + kDiagonalCost * before;
  const int count = free_diagonal<kDirection>(begin);
  own.reach[kDirection / 2] = static_cast<std::int16_t>(before + count);

  if (count == 0) {
    return;
  }
  // Beside every pixel but the last all is free, or the diagonal could not go on: straight runs
  // from there are only of use where they turn at something further off, or come to the start.
  const BitLines& rows = grid_->rows();
  const PathPixel last = moved(begin, kDirection, count);
  std::uint64_t sideways = rows.turning<kDown, kAcross>(begin.row, begin.column >> 6);
  sideways |= rows.is_free(last.row + kDown, last.column) ? 0 : line_bit<kDown>(count);
  if (const int away = kDown * (start_.row - begin.row); away > 0 && away <= count) {
    sideways |= line_bit<kDown>(away);
  }
  for (sideways = only_first<kDown>(sideways, count); sideways != 0;) {
    const int away = nearest<kDown>(sideways);
    sideways &= ~line_bit<kDown>(away);
    run_straight<kSideways>(point, moved(begin, kDirection, away), cost + kDiagonalCost * away);
  }
  std::uint64_t upright = grid_->columns().turning<kAcross, kDown>(begin.column, begin.row >> 6);
  upright |= rows.is_free(last.row, last.column + kAcross) ? 0 : line_bit<kAcross>(count);
  if (const int away = kAcross * (start_.column - begin.column); away > 0 && away <= count) {
    upright |= line_bit<kAcross>(away);
    if (const PathPixel there = moved(begin, kDirection, away); same(there, start_)) {
      reach_start(point, cost + kDiagonalCost * away);
    }
  }
  for (upright = only_first<kAcross>(upright, count); upright != 0;) {
    const int away = nearest<kAcross>(upright);
    upright &= ~line_bit<kAcross>(away);
    run_straight<kUpright>(point, moved(begin, kDirection, away), cost + kDiagonalCost * away);
  }
  if (count == kStretch) {
    push(moved(begin, kDirection, count), cost + kDiagonalCost * count, {point, kDirection});
  }
}

void JumpPointSearch::reach_start(std::int32_t from, std::int32_t cost) noexcept {
  if (cost > best_) {
    return;
  }
  came_from_ = cost < best_ ? JumpPoints::kNone : came_from_;
  best_ = cost;
  full_ |= !points_.arrive(from, came_from_);
}

void JumpPointSearch::reach(std::int32_t from, PathPixel pixel, std::int32_t cost,
                            Directions directions) noexcept {
  if (cost + octile(pixel, start_) > best_) {
    return;
  }
  const std::int32_t place = points_.at(pixel);
  JumpPoint& point = points_[place];
  if (cost > point.cost) {
    return;
  }
  if (cost < point.cost) {
    const std::int32_t next = point.next;
    point = {};
    point.pixel = pixel;
    point.cost = cost;
    point.next = next;
  }
  if (from != JumpPoints::kNone) {
    full_ |= !points_.arrive(from, point.came_from);
  }
  const unsigned fresh = directions & ~(point.todo | point.done);
  if (fresh != 0) {
    point.todo = static_cast<Directions>(point.todo | fresh);
    push(pixel, cost, {place, -1});
  }
}

void JumpPointSearch::push(PathPixel at, std::int32_t cost, Open open) noexcept {
  const std::int32_t f = cost + octile(at, start_);
  if (f <= best_ && !open_.push(static_cast<std::uint32_t>(f) / 2, open)) {
    full_ = true;
  }
}

}  // namespace lodesman
