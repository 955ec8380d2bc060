// SPDX-License-Identifier: Apache-2.0
// How often a vehicle changed its mind about the side on which to pass an obstacle: the paper's
// Fig. 5a-b, and a sign of a restless planner. Pure functions and a plain value; any one thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "deploy/operator/report/run_record.h"

namespace lodesman::cli {

inline constexpr double kSideFlipRange_m = 15.0;

enum class PassingSide : std::uint8_t {
  kNone,  // the path does not pass it, or it is not ahead, or too far
  kLeft,  // the path goes left of the obstacle, as seen along the path
  kRight,
};

// The obstacle is where it was when the plan's sonar frame was captured. kNone for a plan that
// found no path.
[[nodiscard]] PassingSide passing_side(const PlanRecord& plan, const Obstacle& obstacle);

struct SideFlips {
  std::uint64_t count = 0;
  std::optional<double> first_s;  // when the first plan on another side was published
};

// Counts while the plans come. Over consecutive found plans (those without a path between them do
// not separate them), each obstacle for itself: left to right or right to left counts where what
// lies between both paths holds some of the obstacle, from or to kNone does not. So nothing counts
// where a path stays and something crosses it, or where it leads through a gap of one wall.
class SideFlipCounter {
 public:
  explicit SideFlipCounter(std::vector<MovingObstacle> obstacles);

  // The plans in their order.
  void add(const PlanRecord& plan);
  [[nodiscard]] const SideFlips& flips() const noexcept { return flips_; }

 private:
  std::vector<MovingObstacle> obstacles_;
  std::vector<PassingSide> before_;
  std::vector<std::array<double, 2>> path_before_;
  SideFlips flips_;
};

[[nodiscard]] SideFlips side_flips(const std::vector<PlanRecord>& plans,
                                   const std::vector<MovingObstacle>& obstacles);

}  // namespace lodesman::cli
