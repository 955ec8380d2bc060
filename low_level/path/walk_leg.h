// SPDX-License-Identifier: Apache-2.0
// A part of PathWalk: steps towards one jump point. Owned by one thread; it does not allocate.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>

#include "low_level/path/grid.h"
#include "low_level/path/pixel_steps.h"
#include "low_level/path/tie_break.h"
#include "mid_level/messages/path.h"

namespace lodesman {

// Steps in the two directions of a guide's way. The way is free straight first and then diagonally,
// and so is what a straight step leaves of it. A diagonal step before its time leaves a free way if
// the line beside is free as far as the way runs along it.
class WalkLeg {
 public:
  using Times = std::array<int, 2>;  // how often a diagonal and a straight step may be taken

  WalkLeg(const PassableGrid& grid, const TieBreak& rule, PathPixel at, PathPixel guide) noexcept
      : way_{at, guide},
        steps_{step_of(way_.diagonal), step_of(way_.straight)},
        changes_{rule.change_off(steps_[0].column, steps_[0].row),
                 rule.change_off(steps_[1].column, steps_[1].row)},
        lean_{2 * rule.off(at) + changes_[0] + changes_[1]},
        is_upright_{steps_[1].column == 0},
        lines_{is_upright_ ? grid.columns() : grid.rows()},
        rule_{rule},
        at_{at} {}

  [[nodiscard]] PathPixel at() const noexcept { return at_; }
  [[nodiscard]] int direction(bool straight) const noexcept {
    return straight ? way_.straight : way_.diagonal;
  }
  // The rule's first key, of two steps. It says that the one with the lesser change ends nearer to
  // the line if half way between both ends is to starboard of it.
  [[nodiscard]] bool prefers_straight() const noexcept {
    if (changes_[0] == changes_[1]) {
      return prefers_straight_by_what_is_left();
    }
    return (lean_ > 0) == (changes_[1] < changes_[0]);
  }
  // Whether the guide's way allows the step.
  [[nodiscard]] bool allows(bool straight) noexcept {
    if (straight || way_.straights == 0 || way_.diagonals == 0) {
      return (straight ? way_.straights : way_.diagonals) > 0;
    }
    if (refused_ == 0) {
      refused_ = look_beside();
    }
    return refused_ == 0;
  }
  // How many straight steps must come before the guide's way allows the diagonal one that it does
  // not allow now.
  [[nodiscard]] int straights_before_diagonal() const noexcept { return std::max(refused_, 1); }
  [[nodiscard]] bool is_line() const noexcept { return way_.straights == 0 || way_.diagonals == 0; }
  // Takes steps as the rule prefers them, while the guide's way allows them and until one of the
  // times is spent. Writes them to a path, and gives its end.
  [[nodiscard]] PathPixel* go(PathPixel* path, const PathPixel* end, Times& times) noexcept {
    while (path != end) {
      const bool straight = prefers_straight();
      if (!allows(straight)) {
        break;
      }
      take(straight, 1);
      *path++ = at_;
      if (--times.data()[straight ? 1 : 0] == 0) {
        break;
      }
    }
    return path;
  }
  // Takes so many of one kind.
  [[nodiscard]] PathPixel* go(bool straight, int steps, PathPixel* path) noexcept {
    const Step step = steps_.data()[straight ? 1 : 0];
    for (int i = 1; i <= steps; ++i) {
      *path++ = moved(at_, step, i);
    }
    take(straight, steps);
    return path;
  }

 private:
  [[nodiscard]] bool prefers_straight_by_what_is_left() const noexcept {
    const int diagonal = rule_.left(moved(at_, steps_[0], 1));
    const int straight = rule_.left(moved(at_, steps_[1], 1));
    return straight < diagonal || (straight == diagonal && way_.straight < way_.diagonal);
  }
  void take(bool straight, int steps) noexcept {
    at_ = moved(at_, steps_.data()[straight ? 1 : 0], steps);
    lean_ += 2 * steps * changes_.data()[straight ? 1 : 0];
    (straight ? way_.straights : way_.diagonals) -= steps;
    refused_ = straight ? std::max(refused_ - steps, 0) : 0;
  }
  // How many straight steps must come before a diagonal one.
  [[nodiscard]] int look_beside() const noexcept {
    const int line = is_upright_ ? at_.column + steps_[0].column : at_.row + steps_[0].row;
    const int place = is_upright_ ? at_.row : at_.column;
    if (!lines_.is_free(line, place)) {
      return 1;
    }
    const int way = is_upright_ ? steps_[1].row : steps_[1].column;
    const int blocked = lines_.blocked_between(line, place, place + way * (way_.straights + 1));
    return blocked == BitLines::kNone ? 0 : std::abs(blocked - place) + 1;
  }

  // Of pairs, the diagonal step is the first.
  Way way_;
  std::array<Step, 2> steps_;
  std::array<int, 2> changes_;
  int lean_;  // twice how far half way between both ends is to starboard of the line
  bool is_upright_;
  const BitLines& lines_;
  const TieBreak& rule_;
  PathPixel at_;
  int refused_ = 0;  // straight steps for which a diagonal one is known to be impossible
};

}  // namespace lodesman
