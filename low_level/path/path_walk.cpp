// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/path_walk.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

#include "low_level/path/pixel_steps.h"
#include "low_level/path/walk_leg.h"

namespace lodesman {

// The steps that the walk may choose from, and how often each may be taken before the nodes in
// sight must be looked at anew.
class PathWalk::Choices {
 public:
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): arrays are written as they are filled
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
  // One that is none of the choices is never spent.
  [[nodiscard]] int times(int direction) const noexcept {
    for (int i = 0; i < count_; ++i) {
      if (choices_.data()[i].direction == direction) {
        return choices_.data()[i].times;
      }
    }
    return kMaxPathPixels;
  }

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

PathWalk::PathWalk(std::size_t capacity)
    : in_sight_(capacity), waiting_(capacity), path_(kMaxPathPixels) {}

void PathWalk::begin(PathPixel start, PathPixel goal, std::int32_t cost) noexcept {
  start_ = start;
  goal_ = goal;
  at_ = start;
  left_ = cost;
  in_sight_count_ = 0;
  waiting_count_ = 0;
}

void PathWalk::add(const JumpPoint& point) noexcept { waiting_.data()[waiting_count_++] = point; }

std::span<const PathPixel> PathWalk::walk(const PassableGrid& grid) noexcept {
  grid_ = &grid;
  const TieBreak rule{start_, goal_};
  path_.data()[0] = at_;
  path_count_ = 1;
  arrive(start_, left_);
  while (!same(at_, goal_)) {
    if (path_count_ == path_.size()) {
      return {};
    }
    stride(rule);
  }
  return std::span<const PathPixel>{path_}.first(path_count_);
}

bool PathWalk::may_step(PathPixel from, int direction) const noexcept {
  const BitLines& rows = grid_->rows();
  const PathPixel to = moved(from, direction, 1);
  return rows.is_free(to.row, to.column) &&
         (!is_diagonal(direction) ||
          (rows.is_free(to.row, from.column) && rows.is_free(from.row, to.column)));
}

// Whether a run out from the node, diagonally and then straight, came past the pixel.
bool PathWalk::leads_to(PathPixel from, const JumpPoint& point) const noexcept {
  const int columns = point.pixel.column - from.column;
  const int rows = point.pixel.row - from.row;
  const int diagonal = std::min(std::abs(columns), std::abs(rows));
  if (diagonal > 0) {
    const int back = columns > 0 ? (rows > 0 ? 7 : 5) : (rows > 0 ? 1 : 3);
    if (diagonal > point.reach[static_cast<std::size_t>(back / 2)]) {
      return false;
    }
  }
  if (std::abs(columns) >= std::abs(rows)) {
    const int turn = point.pixel.column - (columns > 0 ? diagonal : -diagonal);
    return grid_->rows().blocked_between(from.row, from.column, turn) == BitLines::kNone;
  }
  const int turn = point.pixel.row - (rows > 0 ? diagonal : -diagonal);
  return grid_->columns().blocked_between(from.column, from.row, turn) == BitLines::kNone;
}

// Whether a step from a pixel may be taken and leads to a jump point in sight at the cost that is
// left before it.
bool PathWalk::is_cheapest(PathPixel from, int direction, std::int32_t left) const noexcept {
  if (!may_step(from, direction)) {
    return false;
  }
  const PathPixel end = moved(from, direction, 1);
  const JumpPoint* const sights = in_sight_.data();
  for (std::size_t i = 0; i < in_sight_count_; ++i) {
    if (octile(end, sights[i].pixel) + sights[i].cost == left - cost_of(direction) &&
        leads_to(end, sights[i])) {
      return true;
    }
  }
  return false;
}

// Sorts the jump points anew: those whose cost and way fit what is left are in sight; those that
// would be too cheap wait, for something lies between; those too dear are past, for good: a step
// on a cheapest path never brings one nearer by more than the step costs.
void PathWalk::arrive(PathPixel pixel, std::int32_t left) noexcept {
  at_ = pixel;
  left_ = left;
  JumpPoint* const sights = in_sight_.data();
  JumpPoint* const waiting = waiting_.data();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < in_sight_count_; ++i) {
    if (octile(at_, sights[i].pixel) + sights[i].cost == left_ && !same(at_, sights[i].pixel)) {
      sights[kept++] = sights[i];
    }
  }
  in_sight_count_ = kept;
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

// How many steps of the other kind must come before any jump point in sight allows one that none
// allows now.
int PathWalk::steps_before(bool straight, const WalkLeg& leg) const noexcept {
  if (in_sight_count_ == 1 && leg.is_line()) {
    return kMaxPathPixels;
  }
  if (!straight) {
    return leg.straights_before_diagonal();  // what blocks the line beside blocks it for all
  }
  // A diagonal that does not reach so far yet allows nothing.
  int steps = kMaxPathPixels;
  const JumpPoint* const sights = in_sight_.data();
  for (std::size_t i = 0; i < in_sight_count_; ++i) {
    const Way way{leg.at(), sights[i].pixel};
    if (way.straights > 0) {
      const int reach = sights[i].reach[static_cast<std::size_t>(opposite(way.diagonal) / 2)];
      steps = std::min(steps, std::max(way.diagonals - reach, 1));
    }
  }
  return steps;
}

// A jump point in sight that the pixel leads to. There is one: the last on the way by which the
// search came past the pixel. It is put first, where the next look finds it at once.
const JumpPoint& PathWalk::find_guide() noexcept {
  JumpPoint* sight = in_sight_.data();
  while (!leads_to(at_, *sight)) {
    ++sight;
  }
  std::swap(in_sight_.front(), *sight);
  return in_sight_.front();
}

// Takes steps as long as nothing can come into sight or get out of it.
void PathWalk::stride(const TieBreak& rule) noexcept {
  const JumpPoint& guide = find_guide();
  Choices choices{rule, at_};
  for (std::size_t i = 0; i < in_sight_count_; ++i) {
    choices.add(Way{at_, in_sight_.data()[i].pixel});
  }
  choices.close(in_sight_count_);
  if (choices.are_of(Way{at_, guide.pixel})) {
    follow(guide, rule, choices);
  } else {
    choose(guide, choices);
  }
}

// Where no directions lead anywhere but the guide's two.
void PathWalk::follow(const JumpPoint& guide, const TieBreak& rule,
                      const Choices& choices) noexcept {
  WalkLeg leg{*grid_, rule, at_, guide.pixel};
  WalkLeg::Times times{choices.times(leg.direction(false)), choices.times(leg.direction(true))};
  const bool is_alone = in_sight_count_ == 1;
  PathPixel* path = path_.data() + path_count_;
  PathPixel* const end = path_.data() + path_.size();
  std::int32_t left = 0;
  for (bool guided = true; guided;) {
    path = leg.go(path, end, times);
    left = octile(leg.at(), guide.pixel) + guide.cost;
    if (times[0] == 0 || times[1] == 0 || path == end) {
      break;
    }
    // The guide does not allow what the rule prefers. Another jump point in sight may; the guide
    // then guides no further.
    bool straight = leg.prefers_straight();
    int steps = 1;
    guided = is_alone || !is_cheapest(leg.at(), leg.direction(straight), left);
    if (guided) {
      steps = steps_before(straight, leg);
      straight = !straight;
    }
    int& rest = times[straight ? 1 : 0];
    steps = std::min({steps, rest, static_cast<int>(end - path)});
    rest -= steps;
    left -= steps * cost_of(leg.direction(straight));
    path = leg.go(straight, steps, path);
    guided = guided && rest > 0 && path != end;
  }
  path_count_ = static_cast<std::size_t>(path - path_.data());
  arrive(leg.at(), left);
}

// Where more directions lead somewhere. A step that follows the guide's way is on a cheapest path;
// any other asks the map.
void PathWalk::choose(const JumpPoint& guide, Choices& choices) noexcept {
  Way way{at_, guide.pixel};
  PathPixel at = at_;
  std::int32_t left = left_;
  for (bool guided = true; guided && path_count_ < path_.size() && !choices.spent();) {
    for (choices.weigh(at);; choices.refuse()) {
      const int direction = choices.best();
      guided = direction == way.straight
                   ? way.straights > 0
                   : direction == way.diagonal && way.diagonals > 0 && way.straights == 0;
      if (guided || is_cheapest(at, direction, left)) {
        choices.take();
        way.take(direction);
        left -= cost_of(direction);
        at = moved(at, direction, 1);
        break;
      }
    }
    path_.data()[path_count_++] = at;
  }
  arrive(at, left);
}

}  // namespace lodesman
