// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/mission.h"

#include <algorithm>
#include <cmath>

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

namespace {

// One goal, and no link that could be lost again.
[[nodiscard]] MissionDefinition way_to(const WorldPoint& goal,
                                       const MissionDefinition& mission) noexcept {
  MissionDefinition way = mission;
  way.goal_count = 1;
  way.goals[0] = {goal.xy_m.x(), goal.xy_m.y()};
  way.link_lost = LinkLost::kGoOn;
  way.legs = Legs::kFree;
  return way;
}

// The status bears a copy of the goal: where they differ it is no goal of that mission.
[[nodiscard]] bool makes_for_a_goal(const MissionStatus& status,
                                    const MissionDefinition& mission) noexcept {
  constexpr double kSame_m = 1e-6;
  if (status.goal_index >= mission.goal_count) {
    return false;
  }
  const Goal& goal = mission.goals[status.goal_index];
  return std::abs(goal.x_m - status.goal_x_m) < kSame_m &&
         std::abs(goal.y_m - status.goal_y_m) < kSame_m;
}

}  // namespace

Mission::Mission(const MissionOptions& options) : options_{options} {}

void Mission::take(const GivenOrder& given, const WorldPoint& position, Time now) noexcept {
  const OperatorCommand& command = given.command;
  if (command.order == OperatorOrder::kAbort || command.aborts > status_.aborts) {
    if (status_.state != MissionState::kAborted) {
      status_.ended = now;
    }
    abort(command.aborts, MissionCause::kOrder);
    aborted_ = now;
  }
  if (command.order != OperatorOrder::kAbort && command.order != OperatorOrder::kNone) {
    status_.answer = obey(given, position, now);
    status_.order = given.sequence;
  }
}

bool Mission::inherit(const MissionStatus& before, std::uint64_t aborts) noexcept {
  status_.first_started = before.first_started;
  if (before.state != MissionState::kAborted && aborts <= before.aborts) {
    status_.aborts = before.aborts;
    return false;
  }
  status_.started = before.started;
  status_.ended = before.ended;
  abort(std::max(aborts, before.aborts), before.cause);
  return true;
}

// A mission whose goals do not say where it was making for was on its way back.
void Mission::take_up(const MissionStatus& before, const MissionDefinition& definition,
                      const Succession& succession, Time now) noexcept {
  status_ = before;
  status_.state = succession.state;
  status_.cause = succession.cause;
  definition_ = definition;
  if (before.state == MissionState::kUnderWay && !makes_for_a_goal(before, definition)) {
    definition_ = way_to(goal(), definition);
    status_.goal_index = 0;
    status_.cause = succession.state == MissionState::kUnderWay ? before.cause : succession.cause;
  }
  status_.goal_index = std::min(status_.goal_index, definition_.goal_count - 1);
  if (succession.state == MissionState::kAborted) {
    status_.ended = now;
  }
  hold_speed();
}

void Mission::start(const MissionDefinition& definition, const WorldPoint& position,
                    Time now) noexcept {
  definition_ = definition;
  status_.home_x_m = position.xy_m.x();
  status_.home_y_m = position.xy_m.y();
  status_.state = MissionState::kUnderWay;
  status_.cause = MissionCause::kOrder;
  status_.mission = definition.id;
  status_.started = now;
  status_.ended = Time{};
  status_.skipped = 0;
  if (status_.first_started == Time{}) {
    status_.first_started = now;
  }
  hold_speed();
  make_for(0);
}

void Mission::hold_speed() noexcept {
  HeldSpeed held = options_.speeds.held(definition_.speed_m_s);
  if (held.speed_m_s > speed_limit_m_s_) {
    held = options_.speeds.held_at_most(speed_limit_m_s_);
  }
  status_.speed_m_s = held.speed_m_s;
  status_.surge_ref = held.surge_ref;
}

void Mission::limit_speed(double speed_m_s) noexcept {
  speed_limit_m_s_ = speed_m_s;
  if (definition_.goal_count > 0) {
    hold_speed();
  }
}

void Mission::hold(const WorldPoint& position, MissionCause cause) noexcept {
  status_.state = MissionState::kHolding;
  status_.blocked_since = Time{};
  status_.cause = cause;
  status_.goal_x_m = position.xy_m.x();
  status_.goal_y_m = position.xy_m.y();
}

void Mission::abort(std::uint64_t count, MissionCause cause) noexcept {
  status_.state = MissionState::kAborted;
  status_.cause = cause;
  status_.aborts = std::max(status_.aborts, count);
}

void Mission::watch_link(const CommandLink& link, const WorldPoint& position, Time now) noexcept {
  // A session that has let go of the command, or never had it, is no link that could be lost.
  const bool heard = now - link.heard <= definition_.link_lost_after;
  if (heard && link.session == link_lost_of_) {
    link_lost_of_ = 0;  // it is back, and may be lost again
  }
  if (!under_way() || link.session == 0 || heard || link.session == link_lost_of_) {
    return;
  }
  link_lost_of_ = link.session;
  switch (definition_.link_lost) {
    case LinkLost::kGoOn: break;
    case LinkLost::kHold: hold(position, MissionCause::kLinkLost); break;
    case LinkLost::kReturn: go_back(position, now); break;
    case LinkLost::kAbort:
      status_.ended = now;
      abort(status_.aborts, MissionCause::kLinkLost);
      break;
  }
}

void Mission::watch_blocked(GoalOutlook outlook, const WorldPoint& position, Time now) noexcept {
  if (!under_way() || outlook == GoalOutlook::kOpen) {
    status_.blocked_since = Time{};
    return;
  }
  if (status_.blocked_since == Time{}) {
    status_.blocked_since = outlook == GoalOutlook::kAwaited ? now : Time{};
    return;
  }
  if (is_last_goal() || now - status_.blocked_since < definition_.blocked_patience) {
    return;
  }
  if (definition_.blocked == Blocked::kSkip) {
    ++status_.skipped;
    make_for(status_.goal_index + 1);
  } else {
    hold(position, MissionCause::kBlocked);
  }
}

std::optional<WorldPoint> Mission::line_begin() const noexcept {
  if (!under_way() || definition_.legs == Legs::kFree) {
    return std::nullopt;
  }
  if (status_.goal_index == 0) {
    return home();
  }
  const Goal& last = definition_.goals[status_.goal_index - 1];
  return WorldPoint{{last.x_m, last.y_m}};
}

bool Mission::is_last_goal() const noexcept {
  return status_.goal_index + 1 >= definition_.goal_count;
}

void Mission::end_disarmed(Time now) noexcept {
  if (under_way() || holding()) {
    status_.ended = now;
    abort(status_.aborts, MissionCause::kDisarmed);
  }
}

// To where it set out from, as a mission of its own.
void Mission::go_back(const WorldPoint& position, Time now) noexcept {
  const WorldPoint from = home();
  start(way_to(from, definition_), position, now);
  status_.home_x_m = from.xy_m.x();
  status_.home_y_m = from.xy_m.y();
  status_.cause = MissionCause::kLinkLost;
}

OrderAnswer Mission::obey(const GivenOrder& given, const WorldPoint& position, Time now) noexcept {
  const OperatorCommand& command = given.command;
  if (aborted_ == now || command.aborts < status_.aborts) {
    return OrderAnswer::kAborted;
  }
  if (given.given < now - kOrderPatience) {
    return OrderAnswer::kTooOld;
  }
  // What disarmed the boat came after it.
  if (status_.cause == MissionCause::kDisarmed && given.given <= status_.ended) {
    return OrderAnswer::kAborted;
  }
  const bool starts = command.order == OperatorOrder::kStart;
  const bool known =
      at_hand_.goal_count > 0 && (command.mission == 0 || command.mission == at_hand_.id);
  if (starts && !known) {
    return OrderAnswer::kNoMission;
  }
  const Ruling ruling = ruling_on(command.order, status_.state);
  const bool another = starts && at_hand_.id != status_.mission;
  if (ruling.answer != OrderAnswer::kObeyed || (ruling.state == status_.state && !another)) {
    return ruling.answer;
  }
  if (starts) {
    start(at_hand_, position, now);
  } else if (command.order == OperatorOrder::kResume) {
    status_.state = ruling.state;
    status_.cause = MissionCause::kOrder;
    make_for(status_.goal_index);
  } else {
    hold(position, MissionCause::kOrder);
  }
  return OrderAnswer::kObeyed;
}

void Mission::advance(const WorldPoint& position, Time now) noexcept {
  if (!under_way()) {
    return;
  }
  const bool last = is_last_goal();
  const double radius_m = last ? definition_.goal_radius_m : options_.waypoint_radius_m;
  // Nor is it reached where the distance is no number.
  if (!((position.xy_m - goal().xy_m).norm() <= radius_m)) {
    return;
  }
  if (last) {
    status_.state = MissionState::kReached;
    status_.cause = MissionCause::kOrder;
    status_.ended = now;
  } else {
    make_for(status_.goal_index + 1);
  }
}

void Mission::make_for(std::uint32_t index) noexcept {
  status_.goal_index = index;
  status_.blocked_since = Time{};
  status_.goal_x_m = definition_.goals[index].x_m;
  status_.goal_y_m = definition_.goals[index].y_m;
}

}  // namespace lodesman
