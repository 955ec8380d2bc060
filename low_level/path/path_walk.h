// SPDX-License-Identifier: Apache-2.0
// Walks a cheapest path by the rule of tie_break.h, knowing only the jump points of a search and
// their costs. Owned by one thread; it allocates when made and never after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "low_level/path/grid.h"
#include "low_level/path/tie_break.h"
#include "mid_level/messages/path.h"

namespace lodesman {

class WalkLeg;

// A pixel from which a search ran out, or the goal.
struct JumpPoint {
  PathPixel pixel;
  std::int32_t cost = 0;  // to the goal
  // How far each of its diagonals has been found free, by direction / 2.
  std::array<std::int16_t, 4> reach{};
};

// A step lies on a cheapest path if from its end the goal costs just the step less. What it costs
// from there is not stored anywhere; but the search came past every pixel of every cheapest path,
// by a diagonal and then a straight run out from some jump point. So a step is good if its end
// looks along such a run, straight first and then diagonally, to a jump point whose own cost makes
// up the rest.
//
// Jump points that fit so far by their cost and place are "in sight", whether or not the run is
// free; those that would be too cheap wait, for something lies between. A waiting one can come into
// sight only where one that was in sight is reached, or comes to lie in a straight line: only there
// can a cheapest path begin to turn.
class PathWalk {
 public:
  // With room for so many jump points.
  explicit PathWalk(std::size_t capacity);

  void begin(PathPixel start, PathPixel goal, std::int32_t cost) noexcept;
  // Every jump point through which a path might cost no more.
  void add(const JumpPoint& point) noexcept;
  // The path, as long as it lasts; empty where it has more than kMaxPathPixels.
  [[nodiscard]] std::span<const PathPixel> walk(const PassableGrid& grid) noexcept;

 private:
  class Choices;

  void arrive(PathPixel pixel, std::int32_t left) noexcept;
  void stride(const TieBreak& rule) noexcept;
  void follow(const JumpPoint& guide, const TieBreak& rule, const Choices& choices) noexcept;
  void choose(const JumpPoint& guide, Choices& choices) noexcept;
  [[nodiscard]] const JumpPoint& find_guide() noexcept;
  [[nodiscard]] int steps_before(bool straight, const WalkLeg& leg) const noexcept;
  [[nodiscard]] bool leads_to(PathPixel from, const JumpPoint& point) const noexcept;
  [[nodiscard]] bool may_step(PathPixel from, int direction) const noexcept;
  [[nodiscard]] bool is_cheapest(PathPixel from, int direction, std::int32_t left) const noexcept;

  const PassableGrid* grid_ = nullptr;  // during a walk
  PathPixel start_;
  PathPixel goal_;
  PathPixel at_;
  std::int32_t left_ = 0;  // to pay from here
  std::vector<JumpPoint> in_sight_;
  std::vector<JumpPoint> waiting_;
  std::size_t in_sight_count_ = 0;
  std::size_t waiting_count_ = 0;
  std::vector<PathPixel> path_;
  std::size_t path_count_ = 0;
};

}  // namespace lodesman
