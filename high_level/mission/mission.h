// SPDX-License-Identifier: Apache-2.0
// The mission: goals in order, and the states that an operator's word and the vehicle's progress
// lead through. One thread.
#pragma once

#include <cstdint>
#include <vector>

#include "mid_level/base/frames.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/command.h"

namespace lodesman {

struct MissionOptions {
  std::vector<WorldPoint> goals;   // waypoints in order, the goal last; at least one
  double waypoint_radius_m = 0.0;  // [m] a waypoint counts as visited within this
  double goal_radius_m = 0.0;      // [m] the goal counts as reached within this
};

class Mission {
 public:
  explicit Mission(MissionOptions options);

  // start: from the first goal on, unless under way. abort: latched until the next start. hold:
  // stays at `position`, the vehicle's own, if under way; resume: goes on from there.
  void order(OperatorOrder order, const WorldPoint& position, Time now) noexcept;
  // Progress by the estimated position, which the mission itself takes for true.
  void advance(const WorldPoint& position, Time now) noexcept;

  [[nodiscard]] const MissionStatus& status() const noexcept { return status_; }
  // What is made for now; while holding the place held.
  [[nodiscard]] WorldPoint goal() const noexcept { return {{status_.goal_x_m, status_.goal_y_m}}; }
  [[nodiscard]] bool under_way() const noexcept { return status_.state == MissionState::kUnderWay; }
  [[nodiscard]] bool holding() const noexcept { return status_.state == MissionState::kHolding; }

 private:
  void make_for(std::uint32_t index) noexcept;

  MissionOptions options_;
  MissionStatus status_;
};

}  // namespace lodesman
