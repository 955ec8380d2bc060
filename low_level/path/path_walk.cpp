// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/path_walk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <utility>

#include "low_level/path/pixel_steps.h"
#include "low_level/path/walk_leg.h"
#include "mid_level/base/check.h"

namespace lodesman {

// The steps that the walk may choose from, and how often each may be taken before guides must be
// looked for anew.
class PathWalk::Choices {
 public:
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): choices are written as they are added
  Choices(const TieBreak& rule, PathPixel at) noexcept : rule_{rule}, off_{rule.off(at)} {
    times_.fill(kMaxPathPixels);
  }

  void add(const Way& way) noexcept {
    const unsigned leads = way.directions();
    directions_ |= leads;
    common_ &= leads;
    limit(way.straight, way.straights);
    limit(way.diagonal, way.diagonals);
  }
  // A step that does not lead to all of the guides loses one of them.
  void close() noexcept {
    for (unsigned rest = directions_; rest != 0; rest &= rest - 1) {
      const int direction = std::countr_zero(rest);
      Choice& choice = choices_.data()[count_++];
      choice.direction = direction;
      choice.change = rule_.change_off(step_of(direction).column, step_of(direction).row);
      choice.times = (common_ >> direction & 1U) != 0 ? times_.data()[direction] : 1;
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

  void limit(int direction, int times) noexcept {
    int& most = times_.data()[direction];
    most = std::min(most, times > 0 ? times : static_cast<int>(kMaxPathPixels));
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
  unsigned directions_ = 0;  // that lead to any guide
  unsigned common_ = ~0U;    // that lead to all of them
  std::array<int, kDirections> times_;
  std::array<Choice, kDirections> choices_;
  int count_ = 0;
  unsigned refused_ = 0;
  int best_ = 0;
  bool spent_ = false;
};

PathWalk::PathWalk(std::size_t capacity)
    : guides_(capacity), before_(capacity), path_(kMaxPathPixels) {}

std::span<const PathPixel> PathWalk::walk(const PassableGrid& grid, JumpPoints& points,
                                          std::int32_t arrival, const WalkTask& task) noexcept {
  grid_ = &grid;
  points_ = &points;
  look_ = 1;
  at_ = task.start;
  left_ = task.cost;
  guide_count_ = 0;
  look_back(arrival);
  look_along();
  const TieBreak rule{task.start, task.goal};
  path_.data()[0] = at_;
  path_count_ = 1;
  while (!same(at_, task.goal)) {
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

// Whether a run out from the jump point, diagonally and then straight, came past the pixel.
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

// Whether a step from a pixel may be taken and leads to one of the guides at the cost that is left
// before it.
bool PathWalk::is_cheapest(PathPixel from, int direction, std::int32_t left) const noexcept {
  if (!may_step(from, direction)) {
    return false;
  }
  const PathPixel end = moved(from, direction, 1);
  for (std::size_t i = 0; i < guide_count_; ++i) {
    if (octile(end, guide(i).pixel) + guide(i).cost == left - cost_of(direction) &&
        leads_to(end, guide(i))) {
      return true;
    }
  }
  return false;
}

// Moves on to a pixel, and finds its guides.
void PathWalk::arrive(PathPixel pixel, std::int32_t left) noexcept {
  at_ = pixel;
  left_ = left;
  ++look_;
  guides_.swap(before_);
  const std::size_t count = std::exchange(guide_count_, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t point = before_.data()[i];
    if (same(at_, (*points_)[point].pixel)) {
      look_back((*points_)[point].came_from);
    } else {
      consider(point);
    }
  }
  look_along();
}

// Considers those from which the search came to the guides that lie in a straight line, and to
// those that are found so.
void PathWalk::look_along() noexcept {
  for (std::size_t i = 0; i < guide_count_; ++i) {
    if (lodesman::is_line(at_, guide(i).pixel)) {
      look_back(guide(i).came_from);
    }
  }
}

// Considers those from which the search came to a jump point, or to the start.
void PathWalk::look_back(std::int32_t arrival) noexcept {
  while (arrival != JumpPoints::kNone) {
    consider(points_->arrival(arrival).from);
    arrival = points_->arrival(arrival).next;
  }
}

// Takes a jump point for a guide if it is one here.
void PathWalk::consider(std::int32_t point) noexcept {
  JumpPoint& own = (*points_)[point];
  if (std::exchange(own.looked, look_) != look_ && octile(at_, own.pixel) + own.cost == left_ &&
      leads_to(at_, own)) {
    guides_.data()[guide_count_++] = point;
  }
}

// How many steps of the other kind must come before any guide allows one that none allows now.
int PathWalk::steps_before(bool straight, const WalkLeg& leg) const noexcept {
  if (guide_count_ == 1 && leg.is_line()) {
    return kMaxPathPixels;
  }
  int steps = kMaxPathPixels;
  for (std::size_t i = 0; i < guide_count_; ++i) {
    const Way way{leg.at(), guide(i).pixel};
    if (!straight) {
      steps = std::min(steps, leg.straights_before_diagonal(way));
    } else if (way.straights > 0) {
      // A diagonal that does not reach so far yet allows nothing.
      const int reach = guide(i).reach[static_cast<std::size_t>(opposite(way.diagonal) / 2)];
      steps = std::min(steps, std::max(way.diagonals - reach, 1));
    }
  }
  return steps;
}

// Takes steps as long as nothing can become a guide.
void PathWalk::stride(const TieBreak& rule) noexcept {
  LODESMAN_CHECK(guide_count_ > 0);  // the search has passed every pixel of every cheapest path
  const Way way{at_, guide(0).pixel};
  const auto times_of = [](int steps) {
    return steps > 0 ? steps : static_cast<int>(kMaxPathPixels);
  };
  if (guide_count_ == 1) {
    follow(rule, {times_of(way.diagonals), times_of(way.straights)});
    return;
  }
  Choices choices{rule, at_};
  for (std::size_t i = 0; i < guide_count_; ++i) {
    choices.add(Way{at_, guide(i).pixel});
  }
  choices.close();
  if (choices.are_of(way)) {
    follow(rule, {choices.times(way.diagonal), choices.times(way.straight)});
  } else {
    choose(choices);
  }
}

// Where no directions lead anywhere but the first guide's two, each of which may be taken so often.
void PathWalk::follow(const TieBreak& rule, WalkLeg::Times times) noexcept {
  const JumpPoint& guide = this->guide(0);
  WalkLeg leg{*grid_, rule, at_, guide.pixel};
  const bool is_alone = guide_count_ == 1;
  PathPixel* path = path_.data() + path_count_;
  PathPixel* const end = path_.data() + path_.size();
  std::int32_t left = 0;
  for (bool guided = true; guided;) {
    path = leg.go(path, end, times);
    left = octile(leg.at(), guide.pixel) + guide.cost;
    if (times[0] == 0 || times[1] == 0 || path == end) {
      break;
    }
    // The guide does not allow what the rule prefers. Another guide may; this one then guides no
    // further.
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
void PathWalk::choose(Choices& choices) noexcept {
  Way way{at_, guide(0).pixel};
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
