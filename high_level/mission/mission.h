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

  // start: from the first goal on, unless under way. abort: latched until the next start.
  void order(OperatorOrder order, Time now) noexcept;
  // Progress by the estimated position, which the mission itself takes for true.
  void advance(const WorldPoint& position, Time now) noexcept;

  [[nodiscard]] const MissionStatus& status() const noexcept { return status_; }
  [[nodiscard]] WorldPoint goal() const noexcept { return options_.goals[status_.goal_index]; }
  [[nodiscard]] bool under_way() const noexcept { return status_.state == MissionState::kUnderWay; }

 private:
  void make_for(std::uint32_t index) noexcept;

  MissionOptions options_;
  MissionStatus status_;
};

}  // namespace lodesman
