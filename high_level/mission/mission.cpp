// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/mission.h"

#include <algorithm>
#include <utility>

#include "mid_level/base/check.h"

namespace lodesman {

Ruling ruling_on(OperatorOrder order, MissionState state) noexcept {
  const bool under_way = state == MissionState::kUnderWay;
  const bool holding = state == MissionState::kHolding;
  switch (order) {
    case OperatorOrder::kNone: return {OrderAnswer::kNone, state};
    case OperatorOrder::kStart: return {OrderAnswer::kObeyed, MissionState::kUnderWay};
    case OperatorOrder::kAbort: return {OrderAnswer::kObeyed, MissionState::kAborted};
    case OperatorOrder::kHold:
      return under_way || holding ? Ruling{OrderAnswer::kObeyed, MissionState::kHolding}
                                  : Ruling{OrderAnswer::kNotUnderWay, state};
    case OperatorOrder::kResume:
      return holding ? Ruling{OrderAnswer::kObeyed, MissionState::kUnderWay}
                     : Ruling{OrderAnswer::kNotHolding, state};
  }
  return {OrderAnswer::kNone, state};
}

Mission::Mission(MissionOptions options) : options_{std::move(options)} {
  LODESMAN_CHECK(!options_.goals.empty());
  make_for(0);
}

void Mission::take(const GivenOrder& given, const WorldPoint& position, Time now) noexcept {
  const OperatorCommand& command = given.command;
  if (command.order == OperatorOrder::kAbort || command.aborts > status_.aborts) {
    if (status_.state != MissionState::kAborted) {
      status_.ended = now;
    }
    abort(command.aborts);
    aborted_ = now;
  }
  if (command.order != OperatorOrder::kAbort && command.order != OperatorOrder::kNone) {
    status_.answer = obey(given, position, now);
    status_.order = given.sequence;
  }
}

bool Mission::inherit(const MissionStatus& before, std::uint64_t aborts) noexcept {
  if (before.state != MissionState::kAborted && aborts <= before.aborts) {
    status_.aborts = before.aborts;
    return false;
  }
  status_.started = before.started;
  status_.ended = before.ended;
  abort(std::max(aborts, before.aborts));
  return true;
}

void Mission::start(Time now) noexcept {
  status_.state = MissionState::kUnderWay;
  status_.started = now;
  status_.ended = Time{};
  make_for(0);
}

void Mission::hold(const WorldPoint& position) noexcept {
  status_.state = MissionState::kHolding;
  status_.goal_x_m = position.xy_m.x();
  status_.goal_y_m = position.xy_m.y();
}

void Mission::abort(std::uint64_t count) noexcept {
  status_.state = MissionState::kAborted;
  status_.aborts = std::max(status_.aborts, count);
}

OrderAnswer Mission::obey(const GivenOrder& given, const WorldPoint& position, Time now) noexcept {
  if (aborted_ == now || given.command.aborts < status_.aborts) {
    return OrderAnswer::kAborted;
  }
  if (given.given < now - kOrderPatience) {
    return OrderAnswer::kTooOld;
  }
  const Ruling ruling = ruling_on(given.command.order, status_.state);
  if (ruling.answer != OrderAnswer::kObeyed || ruling.state == status_.state) {
    return ruling.answer;
  }
  status_.state = ruling.state;
  if (given.command.order == OperatorOrder::kStart) {
    start(now);
  } else if (given.command.order == OperatorOrder::kResume) {
    make_for(status_.goal_index);
  } else {
    hold(position);
  }
  return OrderAnswer::kObeyed;
}

void Mission::advance(const WorldPoint& position, Time now) noexcept {
  if (!under_way()) {
    return;
  }
  const bool last = status_.goal_index + 1 == options_.goals.size();
  const double radius_m = last ? options_.goal_radius_m : options_.waypoint_radius_m;
  // Nor is it reached where the distance is no number.
  if (!((position.xy_m - goal().xy_m).norm() <= radius_m)) {
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
