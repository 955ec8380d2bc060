// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/mission.h"

#include <utility>

#include "mid_level/base/check.h"

namespace lodesman {

Mission::Mission(MissionOptions options) : options_{std::move(options)} {
  LODESMAN_CHECK(!options_.goals.empty());
  make_for(0);
}

void Mission::order(OperatorOrder order, const WorldPoint& position, Time now) noexcept {
  if (order == OperatorOrder::kStart && !under_way()) {
    make_for(0);
    status_.state = MissionState::kUnderWay;
    status_.started = now;
    status_.ended = Time{};
  } else if (order == OperatorOrder::kAbort && status_.state != MissionState::kAborted) {
    status_.state = MissionState::kAborted;
    status_.ended = now;
  } else if (order == OperatorOrder::kHold && under_way()) {
    status_.state = MissionState::kHolding;
    status_.goal_x_m = position.xy_m.x();
    status_.goal_y_m = position.xy_m.y();
  } else if (order == OperatorOrder::kResume && holding()) {
    status_.state = MissionState::kUnderWay;
    make_for(status_.goal_index);
  }
}

void Mission::advance(const WorldPoint& position, Time now) noexcept {
  if (!under_way()) {
    return;
  }
  const bool last = status_.goal_index + 1 == options_.goals.size();
  const double radius_m = last ? options_.goal_radius_m : options_.waypoint_radius_m;
  if ((position.xy_m - goal().xy_m).norm() > radius_m) {
    return;
  }
  if (last) {
    status_.state = MissionState::kReached;
    status_.ended = now;
  } else {
    make_for(status_.goal_index + 1);
  }
}

void Mission::make_for(std::uint32_t index) noexcept {
  status_.goal_index = index;
  status_.goal_x_m = options_.goals[index].xy_m.x();
  status_.goal_y_m = options_.goals[index].xy_m.y();
}

}  // namespace lodesman
