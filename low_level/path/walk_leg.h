// SPDX-License-Identifier: Apache-2.0
// A part of PathWalk: steps towards one jump point. Owned by one thread; it does not allocate.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
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
  [[nodiscard]] bool prefers_straight() const noexcept { return preference() >= 0; }
  // How many straight steps must come before a way from here allows the diagonal one that it does
  // not allow now. One without diagonals never does.
  [[nodiscard]] int straights_before_diagonal(const Way& way) const noexcept {
    if (way.diagonals == 0) {
      return static_cast<int>(kMaxPathPixels);
    }
    return way.straight == way_.straight && way.diagonal == way_.diagonal
               ? std::max(look_beside(1, 0, way.straights + 1), 1)
               : 1;
  }
  [[nodiscard]] bool is_line() const noexcept { return way_.straights == 0 || way_.diagonals == 0; }
  // Takes steps as the rule prefers them, while the guide's way allows them and until one of the
  // times is spent. Writes them to a path, and gives its end.
  [[nodiscard]] PathPixel* go(PathPixel* path, const PathPixel* end, Times& times) noexcept {
    // Where only what is left decides, the preference must be asked at each step.
    const int longest = changes_[0] == changes_[1] ? 1 : kLongStretch;
    for (bool more = true; more && path != end && times[0] > 0 && times[1] > 0;) {
      const int most =
          static_cast<int>(std::min<std::ptrdiff_t>(end - path, std::min(stretch_, longest)));
      const int diagonals = std::min({most, times[0], way_.diagonals});
      const int straights = std::min({most, times[1], way_.straights});
      const Way before = way_;
      int steps = 0;
      if (straights > 0 && diagonals > 0 && refused_ == 0) {
        steps = go_both_ways(most, diagonals, straights, path);
        more = refused_ == 0;
      } else {
        const int asked = straights == 0 ? diagonals
                          : refused_ > 0 ? std::min(straights, refused_)
                                         : straights;
        steps = go_one_way(straights > 0, asked, path);
        more = steps > 0 && steps == asked;
      }
      times[0] -= before.diagonals - way_.diagonals;
      times[1] -= before.straights - way_.straights;
      path += steps;
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
  // So many steps are written before the map is asked: few where it has just refused one.
  static constexpr int kShortStretch = 4;
  static constexpr int kFirstStretch = 16;
  static constexpr int kLongStretch = 64;

  // Below zero where the rule prefers the diagonal step. Its first key says that of two steps the
  // one with the lesser change ends nearer to the line if half way between both ends is to
  // starboard of it.
  [[nodiscard]] int preference() const noexcept {
    return changes_[0] == changes_[1]  ? (prefers_straight_by_what_is_left() ? 0 : -1)
           : changes_[1] < changes_[0] ? lean_ - 1
                                       : -lean_;
  }
  [[nodiscard]] bool prefers_straight_by_what_is_left() const noexcept {
    const int diagonal = rule_.left(moved(at_, steps_[0], 1));
    const int straight = rule_.left(moved(at_, steps_[1], 1));
    return straight < diagonal || (straight == diagonal && way_.straight < way_.diagonal);
  }
  // How far a preference moves with a diagonal and a straight step.
  [[nodiscard]] std::array<int, 2> preference_changes() const noexcept {
    const int sense = changes_[1] < changes_[0] ? 2 : -2;
    return {sense * changes_[0], sense * changes_[1]};
  }

  // Of one kind, where the guide's way allows no other: as long as the rule prefers it.
  [[nodiscard]] int go_one_way(bool straight, int most, PathPixel* path) noexcept {
    const int preferred = preference();
    if ((preferred >= 0) != straight) {
      return 0;
    }
    // How fast the preference fades.
    const int fades = straight ? -preference_changes()[1] : preference_changes()[0];
    const int steps =
        fades > 0 ? std::min(most, (straight ? preferred : -preferred - 1) / fades + 1) : most;
    static_cast<void>(go(straight, steps, path));
    return steps;
  }
  // Of both kinds, some at a time: written as if nothing were in the way, after which those are
  // taken back that the map refuses. Which of two steps it is makes no branch: no machine could
  // foresee it.
  [[nodiscard]] int go_both_ways(int most, int most_diagonals, int most_straights,
                                 PathPixel* path) noexcept {
    const Step straight = steps_[1];
    const Step beside{steps_[0].column - straight.column, steps_[0].row - straight.row};
    const auto [by_diagonal, by_straight] = preference_changes();
    const int by_beside = by_diagonal - by_straight;
    // After how many steps in all each diagonal one was taken.
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): written before it is read
    std::array<int, kLongStretch> entered;
    int preference = this->preference();
    int column = at_.column;
    int row = at_.row;
    int steps = 0;
    int diagonals = 0;
    while (steps < most && diagonals < most_diagonals && steps - diagonals < most_straights) {
      entered.data()[diagonals] = steps;
      const int diagonal = preference >> 31;  // all ones or none
      diagonals -= diagonal;
      column += straight.column + (beside.column & diagonal);
      row += straight.row + (beside.row & diagonal);
      preference += by_straight + (by_beside & diagonal);
      path[steps++] = {static_cast<std::int16_t>(column), static_cast<std::int16_t>(row)};
    }
    const Refusal refusal = first_refusal(entered.data(), diagonals);
    if (refusal.straights > 0) {
      diagonals = refusal.diagonal;
      steps = entered.data()[diagonals];
      stretch_ = kShortStretch;
    } else {
      stretch_ = std::min(2 * stretch_, kLongStretch);
    }
    take(false, diagonals);
    take(true, steps - diagonals);
    refused_ = refusal.straights;
    return steps;
  }
  // Which of some diagonal steps the map refuses first, and for how many straight ones; for none
  // where it allows them all.
  struct Refusal {
    int diagonal = 0;
    int straights = 0;
  };
  // Of diagonal steps that are each taken after so many steps in all.
  [[nodiscard]] Refusal first_refusal(const int* entered, int diagonals) const noexcept {
    for (int i = 0; i < diagonals; ++i) {
      const int straights = look_beside(i + 1, entered[i], way_.straights + i + 1);
      if (straights > 0) {
        return {i, straights};
      }
    }
    return {};
  }
  void take(bool straight, int steps) noexcept {
    at_ = moved(at_, steps_.data()[straight ? 1 : 0], steps);
    lean_ += 2 * steps * changes_.data()[straight ? 1 : 0];
    (straight ? way_.straights : way_.diagonals) -= steps;
    refused_ = straight ? std::max(refused_ - steps, 0) : 0;
  }
  // How many straight steps must come before a diagonal one, on to a line so many lines beside,
  // whose way on that line goes from one place to another, counted along from here.
  [[nodiscard]] int look_beside(int lines, int from, int to) const noexcept {
    const Step straight = steps_[1];
    const Step beside{steps_[0].column - straight.column, steps_[0].row - straight.row};
    const int line =
        is_upright_ ? at_.column + lines * beside.column : at_.row + lines * beside.row;
    const int here = is_upright_ ? at_.row : at_.column;
    const int way = is_upright_ ? straight.row : straight.column;
    if (!lines_.is_free(line, here + way * from)) {
      return 1;
    }
    const int blocked = lines_.blocked_between(line, here + way * from, here + way * to);
    return blocked == BitLines::kNone ? 0 : std::abs(blocked - here) - from + 1;
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
  int stretch_ = kFirstStretch;
  int refused_ = 0;  // straight steps for which a diagonal one is known to be impossible
};

}  // namespace lodesman
