// SPDX-License-Identifier: Apache-2.0
// Walks a cheapest path by the rule of tie_break.h, knowing only the jump points of a search,
// their costs and from which of them it came to each. Owned by one thread; it allocates when made
// and never after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "low_level/path/grid.h"
#include "low_level/path/jump_points.h"
#include "low_level/path/tie_break.h"
#include "mid_level/messages/path.h"

namespace lodesman {

class WalkLeg;

// From where to where, and what the cheapest path costs.
struct WalkTask {
  PathPixel start;
  PathPixel goal;
  std::int32_t cost = 0;
};

// A step lies on a cheapest path if from its end the goal costs just the step less. What it costs
// from there is not stored anywhere; but the search came past every pixel of every cheapest path,
// by a diagonal and then a straight run out from some jump point. So a step is good if its end
// looks along such a run, straight first and then diagonally, to a jump point whose own cost makes
// up the rest: a guide.
//
// A jump point can become a guide only where one that is a guide is reached, or comes to lie in a
// straight line: only there can a cheapest path begin to turn. And then it is one from which the
// search came to that guide, or to another one in the same line.
class PathWalk {
 public:
  // With room for so many guides.
  explicit PathWalk(std::size_t capacity);

  // The path, valid until the next walk, over the points of a search just made; empty where it has
  // more than kMaxPathPixels. `arrival` is the first of the start's.
  [[nodiscard]] std::span<const PathPixel> walk(const PassableGrid& grid, JumpPoints& points,
                                                std::int32_t arrival,
                                                const WalkTask& task) noexcept;

 private:
  class Choices;

  void arrive(PathPixel pixel, std::int32_t left) noexcept;
  void look_along() noexcept;
  void look_back(std::int32_t arrival) noexcept;
  void consider(std::int32_t point) noexcept;
  void stride(const TieBreak& rule) noexcept;
  void follow(const TieBreak& rule, std::array<int, 2> times) noexcept;
  void choose(Choices& choices) noexcept;
  [[nodiscard]] int steps_before(bool straight, const WalkLeg& leg) const noexcept;
  [[nodiscard]] bool leads_to(PathPixel from, const JumpPoint& point) const noexcept;
  [[nodiscard]] bool may_step(PathPixel from, int direction) const noexcept;
  [[nodiscard]] bool is_cheapest(PathPixel from, int direction, std::int32_t left) const noexcept;
  [[nodiscard]] const JumpPoint& guide(std::size_t i) const noexcept {
    return (*points_)[guides_.data()[i]];
  }

  const PassableGrid* grid_ = nullptr;  // during a walk
  JumpPoints* points_ = nullptr;
  std::uint32_t look_ = 0;  // counts the pixels arrived at, from 1
  PathPixel at_;
  std::int32_t left_ = 0;             // to pay from here
  std::vector<std::int32_t> guides_;  // of here
  std::size_t guide_count_ = 0;
  std::vector<std::int32_t> before_;  // of where the last stride began
  std::vector<PathPixel> path_;
  std::size_t path_count_ = 0;
};

}  // namespace lodesman
