// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/jump_point_search.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>

#include "low_level/path/moves.h"
#include "mid_level/base/check.h"

namespace lodesman {
namespace {

// A diagonal is run along so many pixels at a time: as many lines as a word has bits.
constexpr int kStretch = 64;
// Searches that end do so after about as many expansions; one that does not is worth asking
// whether there is a path at all.
constexpr std::uint32_t kExpansionsBeforeDoubt = 96;
// Nodes are few and pixels many: a hash keeps what a search touches within a cache.
constexpr std::size_t kHashes = 8192;
constexpr std::size_t hash_of(PathPixel pixel) noexcept {
  const auto column = static_cast<std::uint32_t>(pixel.column);
  const auto row = static_cast<std::uint32_t>(pixel.row);
  return (row * 40503U ^ column * 61U) % kHashes;
}
constexpr std::int32_t kNoCost = std::numeric_limits<std::int32_t>::max();

constexpr Step step_of(int direction) noexcept {
  return kSteps[static_cast<std::size_t>(direction)];
}
constexpr PathPixel moved(PathPixel from, int direction, int steps) noexcept {
  const Step step = step_of(direction);
  return {static_cast<std::int16_t>(from.column + step.column * steps),
          static_cast<std::int16_t>(from.row + step.row * steps)};
}
constexpr std::uint8_t bit_of(int direction) noexcept {
  return static_cast<std::uint8_t>(1U << (direction & 7));
}
constexpr bool same(PathPixel a, PathPixel b) noexcept {
  return a.column == b.column && a.row == b.row;
}

// H(n) of eq. (1): the cost between two pixels on an empty map.
std::int32_t octile(PathPixel a, PathPixel b) noexcept {
  const std::int32_t columns = std::abs(a.column - b.column);
  const std::int32_t rows = std::abs(a.row - b.row);
  return kStraightCost * std::max(columns, rows) +
         (kDiagonalCost - kStraightCost) * std::min(columns, rows);
}

// On a straight line of one of the eight directions, or on each other.
bool aligned(PathPixel a, PathPixel b) noexcept {
  const int columns = std::abs(a.column - b.column);
  const int rows = std::abs(a.row - b.row);
  return columns == 0 || rows == 0 || columns == rows;
}

constexpr std::int32_t cost_of(int direction) noexcept {
  return is_diagonal(direction) ? kDiagonalCost : kStraightCost;
}

// The next 64 lines up or down from a line, out of a bitmap of lines: the nearest is the lowest bit
// going up, the highest going down.
template <int kWay>
std::uint64_t lines_ahead(const std::uint64_t* bitmap, int line) noexcept {
  const int from = kWay > 0 ? line + 1 + 64 : line;
  const int shift = from & 63;
  const std::uint64_t* const words = bitmap + (from >> 6);
  return words[0] >> shift | words[1] << 1 << (63 - shift);
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

// The steps by which an empty map is crossed from one pixel to another.
struct JumpPointSearch::Way {
  int straight;  // the direction; of no meaning where there are none
  int straights;
  int diagonal;
  int diagonals;

  Way(PathPixel from, PathPixel to) noexcept {
    const int columns = to.column - from.column;
    const int rows = to.row - from.row;
    diagonals = std::min(std::abs(columns), std::abs(rows));
    straights = std::max(std::abs(columns), std::abs(rows)) - diagonals;
    diagonal = columns > 0 ? (rows < 0 ? 1 : 3) : (rows > 0 ? 5 : 7);
    straight = std::abs(columns) > std::abs(rows) ? (columns > 0 ? 2 : 6) : (rows > 0 ? 4 : 0);
  }
  void take(int direction) noexcept {
    straights -= direction == straight ? 1 : 0;
    diagonals -= direction == diagonal ? 1 : 0;
  }
};

// The steps that the walk may choose from, and how often each may be taken before the nodes in
// sight must be looked at anew.
class JumpPointSearch::Choices {
 public:
  Choices(const TieBreak& rule, PathPixel at) noexcept : rule_{rule}, off_{rule.off(at)} {}

  void add(const Way& way) noexcept {
    if (way.straights > 0) {
      allow(way.straight, way.straights);
    }
    if (way.diagonals > 0) {
      allow(way.diagonal, way.diagonals);
    }
  }
  // A step that does not lead to all of the nodes in sight loses one of them.
  void close(std::size_t nodes) noexcept {
    for (unsigned rest = directions_; rest != 0; rest &= rest - 1) {
      const int direction = std::countr_zero(rest);
      Choice& choice = choices_.data()[count_++];
      const auto d = static_cast<std::size_t>(direction);
      choice.direction = direction;
      choice.change = rule_.change_off(step_of(direction).column, step_of(direction).row);
      choice.times = leading_.data()[d] == nodes ? times_.data()[d] : 1;
    }
  }
  [[nodiscard]] bool spent() const noexcept { return spent_; }
  // Whether there is no other than the steps of one way.
  [[nodiscard]] bool are_of(const Way& way) const noexcept {
    return (directions_ & ~(1U << way.straight | 1U << way.diagonal)) == 0;
  }
  [[nodiscard]] int times(int direction) const noexcept {
    for (int i = 0; i < count_; ++i) {
      if (choices_.data()[i].direction == direction) {
        return choices_.data()[i].times;
      }
    }
    return 0;
  }
  [[nodiscard]] const TieBreak& rule() const noexcept { return rule_; }

  // Orders the choices at a pixel; then best() is the one that the rule takes of those that have
  // not been refused.
  void weigh(PathPixel at) noexcept {
    at_ = at;
    refused_ = 0;
    for (int i = 0; i < count_; ++i) {
      Choice& choice = choices_.data()[i];
      choice.key = TieBreak::key(off_ + choice.change);
    }
    find_best();
  }
  [[nodiscard]] int best() const noexcept { return choices_.data()[best_].direction; }
  void refuse() noexcept {
    refused_ |= 1U << best_;
    find_best();
  }
  void take() noexcept {
    Choice& choice = choices_.data()[best_];
    off_ += choice.change;
    spent_ = --choice.times == 0;
  }

 private:
  struct Choice {
    int direction;
    int change;
    int times;
    int key;
  };

  void allow(int direction, int times) noexcept {
    const auto d = static_cast<std::size_t>(direction);
    const bool is_new = (directions_ >> direction & 1U) == 0;
    directions_ |= 1U << direction;
    times_.data()[d] = is_new ? times : std::min(times, times_.data()[d]);
    leading_.data()[d] = is_new ? 1 : leading_.data()[d] + 1;
  }
  void find_best() noexcept {
    best_ = -1;
    for (int i = 0; i < count_; ++i) {
      if ((refused_ >> i & 1U) == 0 && (best_ < 0 || is_before(i, best_))) {
        best_ = i;
      }
    }
  }
  [[nodiscard]] bool is_before(int i, int j) const noexcept {
    const Choice& a = choices_.data()[i];
    const Choice& b = choices_.data()[j];
    return a.key < b.key || (a.key == b.key && rule_.left(moved(at_, a.direction, 1)) <
                                                   rule_.left(moved(at_, b.direction, 1)));
  }

  const TieBreak& rule_;
  int off_;
  PathPixel at_;
  unsigned directions_ = 0;
  std::array<int, kDirections> times_;
  std::array<std::size_t, kDirections> leading_;
  std::array<Choice, kDirections> choices_;
  int count_ = 0;
  unsigned refused_ = 0;
  int best_ = 0;
  bool spent_ = false;
};

JumpPointSearch::Outlook::Outlook(const BitLines& lines)
    : stride{lines.crowd_words()},
      up(static_cast<std::size_t>(lines.words_per_line()) * stride),
      down(up.size()) {}

void JumpPointSearch::Outlook::look(const BitLines& lines) noexcept {
  const int words = lines.words_per_line();
  const auto add = [this](std::uint64_t* own, const std::uint64_t* nearer,
                          const std::uint64_t* crowd) {
    for (std::size_t i = 0; i < stride; ++i) {
      own[i] = nearer[i] | crowd[i];
    }
  };
  std::copy_n(lines.crowd(words - 1), stride,
              up.data() + static_cast<std::size_t>(words - 1) * stride);
  for (int word = words - 2; word >= 0; --word) {
    std::uint64_t* const own = up.data() + static_cast<std::size_t>(word) * stride;
    add(own, own + stride, lines.crowd(word));
  }
  std::copy_n(lines.crowd(0), stride, down.data());
  for (int word = 1; word < words; ++word) {
    std::uint64_t* const own = down.data() + static_cast<std::size_t>(word) * stride;
    add(own, own - stride, lines.crowd(word));
  }
}

JumpPointSearch::JumpPointSearch(const FanShape& fan, SearchLimits limits)
    : fan_{fan},
      limits_{limits},
      rising_(static_cast<std::size_t>(fan.columns + fan.rows), {fan.columns, -1}),
      falling_(rising_),
      rows_ahead_{PassableGrid{fan}.rows()},
      columns_ahead_{PassableGrid{fan}.columns()},
      open_{static_cast<std::uint32_t>(kStraightCost * std::max(fan.columns, fan.rows) +
                                       kDiagonalCost * kStretch),
            static_cast<std::size_t>(fan.columns) * static_cast<std::size_t>(fan.rows)},
      nodes_(static_cast<std::size_t>(fan.columns) * static_cast<std::size_t>(fan.rows)),
      hash_heads_(kHashes, kNone),
      joined_{fan.rows, fan.columns},
      in_sight_(nodes_.size()),
      waiting_(nodes_.size()),
      path_(kMaxPathPixels) {
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
    if (walk(goal)) {
      result.cost_10_14 = best_;
      result.path = std::span<const PathPixel>{path_}.first(path_count_);
    } else {
      result.reason = PathReason::kLimit;
    }
  }
  return result;
}

void JumpPointSearch::begin(const PassableGrid& grid, PathPixel start, PathPixel goal) noexcept {
  grid_ = &grid;
  start_ = start;
  best_ = same(start, goal) ? 0 : kNoCost;
  full_ = false;
  open_.clear();
  node_count_ = 0;
  rows_ahead_.look(grid.rows());
  columns_ahead_.look(grid.columns());
  reach(goal, 0, 0xFF);
}

// Takes nodes in order of F until nothing in the open list could lie on a path as cheap as the one
// that is known.
PathReason JumpPointSearch::settle(PathPixel goal, std::uint32_t& expansions) noexcept {
  std::uint32_t key = static_cast<std::uint32_t>(octile(goal, start_)) / 2;
  Open next;
  while (open_.pop(key, key, next) && static_cast<std::int64_t>(key) * 2 <= best_) {
    if (next.diagonal >= 0) {
      run(next.node, next.diagonal);
      continue;
    }
    if (nodes_.data()[next.node].todo == 0) {
      continue;  // expanded already, when it was reached more cheaply
    }
    if (expansions >= limits_.max_expansions) {
      return PathReason::kLimit;
    }
    if (++expansions == kExpansionsBeforeDoubt && best_ == kNoCost &&
        !joined_.joined(grid_->rows(), goal.row, goal.column, start_.row, start_.column)) {
      return PathReason::kNoPath;
    }
    expand(next.node);
  }
  if (full_) {
    return PathReason::kLimit;
  }
  return best_ == kNoCost ? PathReason::kNoPath : PathReason::kFound;
}

void JumpPointSearch::expand(std::int32_t node) noexcept {
  Node& own = nodes_.data()[node];
  const Directions todo = own.todo;
  own.todo = 0;
  own.done |= todo;
  for (unsigned rest = todo; rest != 0; rest &= rest - 1) {
    run(node, std::countr_zero(rest));
  }
}

void JumpPointSearch::run(std::int32_t node, int direction) noexcept {
  const Node own = nodes_.data()[node];
  switch (direction) {
    case 0: return run_straight<0>(own.pixel, own.cost);
    case 1: return run_diagonal<1>(node);
    case 2: return run_straight<2>(own.pixel, own.cost);
    case 3: return run_diagonal<3>(node);
    case 4: return run_straight<4>(own.pixel, own.cost);
    case 5: return run_diagonal<5>(node);
    case 6: return run_straight<6>(own.pixel, own.cost);
    default: return run_diagonal<7>(node);
  }
}

template <int kDirection>
void JumpPointSearch::run_straight(PathPixel from, std::int32_t cost) noexcept {
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
    best_ = std::min(best_, cost_at(start_place));
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
  reach(pixel, cost_at(stop), static_cast<Directions>(directions));
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
  const int word = from.column >> 6;
  const int other = (from.column + kAcross * count) >> 6;
  std::uint64_t crowded = only_first<kDown>(lines_ahead<kDown>(rows.crowd(word), from.row) |
                                                lines_ahead<kDown>(rows.crowd(other), from.row),
                                            count);
  for (; crowded != 0;) {
    const int away = nearest<kDown>(crowded);
    crowded &= ~line_bit<kDown>(away);
    const int row = from.row + kDown * away;
    const int column = from.column + kAcross * (away - (kAcross > 0 ? 1 : 0));
    // The pixel itself and the one beside it, in its row and in the row before.
    if ((rows.window(row, column) & rows.window(row - kDown, column) & 3U) != 3U) {
      return away - 1;
    }
  }
  return count;
}

template <int kDirection>
void JumpPointSearch::run_diagonal(std::int32_t node) noexcept {
  constexpr int kAcross = step_of(kDirection).column;
  constexpr int kDown = step_of(kDirection).row;
  constexpr int kSideways = kAcross > 0 ? 2 : 6;
  constexpr int kUpright = kDown > 0 ? 4 : 0;
  const PathPixel from = nodes_.data()[node].pixel;
  const int before = nodes_.data()[node].reach[kDirection / 2];
  const PathPixel begin = moved(from, kDirection, before);
  const std::int32_t cost = nodes_.data()[node].cost + kDiagonalCost * before;
  const int count = free_diagonal<kDirection>(begin);
  nodes_.data()[node].reach[kDirection / 2] = static_cast<std::int16_t>(before + count);

  std::uint64_t rows =
      lines_ahead<kDown>(rows_ahead_.ahead<kAcross>(begin.column >> 6), begin.row) |
      lines_ahead<kDown>(grid_->rows().ragged<kAcross>(begin.column >> 6), begin.row);
  if (const int away = kDown * (start_.row - begin.row); away > 0 && away <= count) {
    rows |= line_bit<kDown>(away);
  }
  for (rows = only_first<kDown>(rows, count); rows != 0;) {
    const int away = nearest<kDown>(rows);
    rows &= ~line_bit<kDown>(away);
    run_straight<kSideways>(moved(begin, kDirection, away), cost + kDiagonalCost * away);
  }
  std::uint64_t columns =
      lines_ahead<kAcross>(columns_ahead_.ahead<kDown>(begin.row >> 6), begin.column) |
      lines_ahead<kAcross>(grid_->columns().ragged<kDown>(begin.row >> 6), begin.column);
  if (const int away = kAcross * (start_.column - begin.column); away > 0 && away <= count) {
    columns |= line_bit<kAcross>(away);
    if (const PathPixel there = moved(begin, kDirection, away); same(there, start_)) {
      best_ = std::min(best_, cost + kDiagonalCost * away);
    }
  }
  for (columns = only_first<kAcross>(columns, count); columns != 0;) {
    const int away = nearest<kAcross>(columns);
    columns &= ~line_bit<kAcross>(away);
    run_straight<kUpright>(moved(begin, kDirection, away), cost + kDiagonalCost * away);
  }
  if (count == kStretch) {
    push(moved(begin, kDirection, count), cost + kDiagonalCost * count, {node, kDirection});
  }
}

// The node of a pixel, which is made where there is none: then it has nothing to do yet.
std::int32_t JumpPointSearch::node_at(PathPixel pixel) noexcept {
  const std::size_t hash = hash_of(pixel);
  std::int32_t& head = hash_heads_.data()[hash];
  Node* const nodes = nodes_.data();
  // What other searches left behind in the heads is told by its not fitting.
  const bool is_own = head >= 0 && head < node_count_ && hash_of(nodes[head].pixel) == hash;
  const std::int32_t first = is_own ? head : kNone;
  for (std::int32_t i = first; i != kNone; i = nodes[i].next) {
    if (same(nodes[i].pixel, pixel)) {
      return i;
    }
  }
  head = node_count_++;
  nodes[head] = {pixel, kNoCost, 0, 0, {}, first};
  return head;
}

void JumpPointSearch::reach(PathPixel pixel, std::int32_t cost, Directions directions) noexcept {
  if (cost + octile(pixel, start_) > best_) {
    return;
  }
  const std::int32_t place = node_at(pixel);
  Node& node = nodes_.data()[place];
  if (cost > node.cost || (cost == node.cost && (directions & ~(node.todo | node.done)) == 0)) {
    return;
  }
  if (cost < node.cost) {
    node = {pixel, cost, 0, 0, {}, node.next};
  }
  node.todo = static_cast<Directions>(node.todo | (directions & ~node.done));
  push(pixel, cost, {place, -1});
}

void JumpPointSearch::push(PathPixel at, std::int32_t cost, Open open) noexcept {
  const std::int32_t f = cost + octile(at, start_);
  if (f <= best_ && !open_.push(static_cast<std::uint32_t>(f) / 2, open)) {
    full_ = true;
  }
}

bool JumpPointSearch::may_step(PathPixel from, int direction) const noexcept {
  const BitLines& rows = grid_->rows();
  const PathPixel to = moved(from, direction, 1);
  return rows.is_free(to.row, to.column) &&
         (!is_diagonal(direction) ||
          (rows.is_free(to.row, from.column) && rows.is_free(from.row, to.column)));
}

// Whether a run out from the node, diagonally and then straight, came past the pixel.
bool JumpPointSearch::leads_to(PathPixel from, const Sight& sight) const noexcept {
  const int columns = sight.pixel.column - from.column;
  const int rows = sight.pixel.row - from.row;
  const int diagonal = std::min(std::abs(columns), std::abs(rows));
  if (diagonal > 0) {
    const int back = columns > 0 ? (rows > 0 ? 7 : 5) : (rows > 0 ? 1 : 3);
    if (diagonal > sight.reach[static_cast<std::size_t>(back / 2)]) {
      return false;
    }
  }
  if (std::abs(columns) >= std::abs(rows)) {
    const int turn = sight.pixel.column - (columns > 0 ? diagonal : -diagonal);
    return grid_->rows().blocked_between(from.row, from.column, turn) == BitLines::kNone;
  }
  const int turn = sight.pixel.row - (rows > 0 ? diagonal : -diagonal);
  return grid_->columns().blocked_between(from.column, from.row, turn) == BitLines::kNone;
}

bool JumpPointSearch::on_cheapest(PathPixel pixel, std::int32_t left) const noexcept {
  const Sight* const sights = in_sight_.data();
  for (std::size_t i = 0; i < in_sight_count_; ++i) {
    if (octile(pixel, sights[i].pixel) + sights[i].cost == left && leads_to(pixel, sights[i])) {
      return true;
    }
  }
  return false;
}

// Sorts the nodes anew: those whose cost and way fit what is left are in sight; those that would
// be too cheap wait, for something lies between; those too dear are past. Where nothing can have
// come into sight, the waiting ones are let be.
void JumpPointSearch::look_round(bool may_turn) noexcept {
  Sight* const sights = in_sight_.data();
  Sight* const waiting = waiting_.data();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < in_sight_count_; ++i) {
    if (octile(at_, sights[i].pixel) + sights[i].cost == left_ && !same(at_, sights[i].pixel)) {
      sights[kept++] = sights[i];
    }
  }
  in_sight_count_ = kept;
  if (!may_turn) {
    return;
  }
  kept = 0;
  for (std::size_t i = 0; i < waiting_count_; ++i) {
    const std::int32_t cost = octile(at_, waiting[i].pixel) + waiting[i].cost;
    if (cost < left_) {
      waiting[kept++] = waiting[i];
    } else if (cost == left_ && !same(at_, waiting[i].pixel)) {
      sights[in_sight_count_++] = waiting[i];
    }
  }
  waiting_count_ = kept;
}

// New nodes can come into sight only where a node that was in sight is reached, or where the way
// to one becomes a straight line: there a cheapest path may begin to turn.
void JumpPointSearch::arrive(PathPixel pixel, std::int32_t left) noexcept {
  bool may_turn = false;
  const Sight* const sights = in_sight_.data();
  for (std::size_t i = 0; i < in_sight_count_; ++i) {
    may_turn = may_turn || same(pixel, sights[i].pixel) ||
               (aligned(pixel, sights[i].pixel) && !aligned(at_, sights[i].pixel));
  }
  at_ = pixel;
  left_ = left;
  look_round(may_turn);
}

// A node in sight that the pixel leads to. There is one: the last node on the way by which the
// search came past the pixel.
const JumpPointSearch::Sight& JumpPointSearch::find_guide() const noexcept {
  const Sight* sight = in_sight_.data();
  while (!leads_to(at_, *sight)) {
    ++sight;
  }
  return *sight;
}

// Takes steps of the walk as long as nothing can come into sight or get out of it.
void JumpPointSearch::stride(const TieBreak& rule) noexcept {
  const Sight& guide = find_guide();
  Choices choices{rule, at_};
  for (std::size_t i = 0; i < in_sight_count_; ++i) {
    choices.add(Way{at_, in_sight_.data()[i].pixel});
  }
  choices.close(in_sight_count_);
  if (choices.are_of(Way{at_, guide.pixel})) {
    follow(guide, choices);
  } else {
    choose(guide, choices);
  }
}

// Where no directions lead anywhere but the guide's two. Its way is free straight first and then
// diagonally, and so is what a straight step leaves of it. A diagonal step before its time leaves a
// free way if the line beside is free as far as the way runs along it.
void JumpPointSearch::follow(const Sight& guide, Choices& choices) noexcept {
  Way way{at_, guide.pixel};
  const TieBreak& rule = choices.rule();
  const Step step_s = step_of(way.straight);
  const Step step_d = step_of(way.diagonal);
  const int off_s = rule.change_off(step_s.column, step_s.row);
  const int off_d = rule.change_off(step_d.column, step_d.row);
  const bool upright = step_s.column == 0;
  const BitLines& lines = upright ? grid_->columns() : grid_->rows();
  const int sideways = upright ? step_d.column : step_d.row;
  const int along = upright ? step_s.row : step_s.column;
  const bool alone = in_sight_count_ == 1;
  int times_s = choices.times(way.straight);
  int times_d = choices.times(way.diagonal);
  int refused = 0;  // straight steps to come before the guide allows a diagonal one
  int off = rule.off(at_);
  PathPixel at = at_;
  std::int32_t left = left_;
  PathPixel* path = path_.data() + path_count_;
  PathPixel* const end = path_.data() + path_.size();
  for (bool guided = true, spent = false; guided && !spent && path != end;) {
    const int key_s = TieBreak::key(off + off_s);
    const int key_d = TieBreak::key(off + off_d);
    bool straight = key_s < key_d;
    if (key_s == key_d) {
      const int left_s = rule.left(moved(at, way.straight, 1));
      const int left_d = rule.left(moved(at, way.diagonal, 1));
      straight = left_s < left_d || (left_s == left_d && way.straight < way.diagonal);
    }
    if (straight ? way.straights == 0 : way.diagonals == 0) {
      const int direction = straight ? way.straight : way.diagonal;
      const bool taken = !alone && may_step(at, direction) &&
                         on_cheapest(moved(at, direction, 1), left - cost_of(direction));
      guided = !taken;
      straight = straight == taken;
    } else if (!straight && way.straights > 0) {
      if (refused == 0) {
        const int line = (upright ? at.column : at.row) + sideways;
        const int place = upright ? at.row : at.column;
        const int turn = place + along * (way.straights + 1);
        const int blocked =
            lines.is_free(line, place) ? lines.blocked_between(line, place, turn) : place;
        refused = blocked == BitLines::kNone ? 0 : std::abs(blocked - place) + 1;
      }
      if (refused > 0) {
        guided = alone || !may_step(at, way.diagonal) ||
                 !on_cheapest(moved(at, way.diagonal, 1), left - kDiagonalCost);
        straight = guided;
      }
    }
    if (straight) {
      at.column = static_cast<std::int16_t>(at.column + step_s.column);
      at.row = static_cast<std::int16_t>(at.row + step_s.row);
      off += off_s;
      left -= kStraightCost;
      --way.straights;
      refused -= refused > 0 ? 1 : 0;
      spent = --times_s == 0;
    } else {
      at.column = static_cast<std::int16_t>(at.column + step_d.column);
      at.row = static_cast<std::int16_t>(at.row + step_d.row);
      off += off_d;
      left -= kDiagonalCost;
      --way.diagonals;
      refused = 0;
      spent = --times_d == 0;
    }
    *path++ = at;
  }
  path_count_ = static_cast<std::size_t>(path - path_.data());
  arrive(at, left);
}

// Where more directions lead somewhere. A step that follows the guide's way is on a cheapest path;
// any other asks the map.
void JumpPointSearch::choose(const Sight& guide, Choices& choices) noexcept {
  Way way{at_, guide.pixel};
  PathPixel at = at_;
  std::int32_t left = left_;
  for (bool guided = true; guided && path_count_ < path_.size() && !choices.spent();) {
    for (choices.weigh(at);; choices.refuse()) {
      const int direction = choices.best();
      const PathPixel next = moved(at, direction, 1);
      const std::int32_t left_then = left - cost_of(direction);
      const bool follows = direction == way.straight ? way.straights > 0
                                                     : direction == way.diagonal &&
                                                           way.diagonals > 0 && way.straights == 0;
      if (!follows && !(may_step(at, direction) && on_cheapest(next, left_then))) {
        continue;
      }
      guided = follows;
      choices.take();
      way.take(direction);
      at = next;
      left = left_then;
      break;
    }
    path_.data()[path_count_++] = at;
  }
  arrive(at, left);
}

bool JumpPointSearch::walk(PathPixel goal) noexcept {
  const TieBreak rule{start_, goal};
  at_ = start_;
  left_ = best_;
  in_sight_count_ = 0;
  waiting_count_ = 0;
  for (std::int32_t i = 0; i < node_count_; ++i) {
    const Node& node = nodes_.data()[i];
    waiting_.data()[waiting_count_] = {node.pixel, node.cost, node.reach};
    waiting_count_ += node.cost + octile(start_, node.pixel) <= best_ ? 1U : 0U;
  }
  path_.data()[0] = at_;
  path_count_ = 1;
  look_round(true);
  while (!same(at_, goal)) {
    if (path_count_ == path_.size()) {
      return false;
    }
    stride(rule);
  }
  return true;
}

}  // namespace lodesman
