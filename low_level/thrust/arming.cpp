// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/arming.h"

#include <algorithm>

namespace lodesman {

const Arming::Row Arming::kTransitions[] = {
    {ThrustState::kDisarmed, Event::kArm, ThrustState::kArmed},
    {ThrustState::kDisarmed, Event::kDisarm, ThrustState::kDisarmed},
    {ThrustState::kDisarmed, Event::kStop, ThrustState::kStopped},
    {ThrustState::kArmed, Event::kArm, ThrustState::kArmed},
    {ThrustState::kArmed, Event::kDisarm, ThrustState::kDisarmed},
    {ThrustState::kArmed, Event::kStop, ThrustState::kStopped},
    {ThrustState::kArmed, Event::kStick, ThrustState::kManual},
    {ThrustState::kArmed, Event::kToMission, ThrustState::kArmed},
    {ThrustState::kArmed, Event::kBoxLost, ThrustState::kDisarmed},
    {ThrustState::kManual, Event::kArm, ThrustState::kManual},
    {ThrustState::kManual, Event::kDisarm, ThrustState::kDisarmed},
    {ThrustState::kManual, Event::kStop, ThrustState::kStopped},
    {ThrustState::kManual, Event::kToMission, ThrustState::kArmed},
    {ThrustState::kManual, Event::kAbort, ThrustState::kArmed},
    {ThrustState::kManual, Event::kBoxLost, ThrustState::kDisarmed},
    {ThrustState::kStopped, Event::kStop, ThrustState::kStopped},
    {ThrustState::kStopped, Event::kDisarm, ThrustState::kStopped},
    {ThrustState::kStopped, Event::kRelease, ThrustState::kDisarmed},
};

bool Arming::happen(Event event, ThrustCause cause, Time now) noexcept {
  for (const Row& row : kTransitions) {
    if (row.from != status_.state || row.event != event) {
      continue;
    }
    if (row.to != row.from) {
      status_.state = row.to;
      status_.cause = cause;
      status_.since = now;
    }
    return true;
  }
  return false;
}

void Arming::remember(const ThrustStatus& before, std::uint64_t stops_ordered, Duration age,
                      Time now) noexcept {
  status_.stops = before.stops;
  status_.order = before.order;
  status_.answer = before.answer;
  const bool stopped = before.state == ThrustState::kStopped || stops_ordered > before.stops;
  const bool armed = before.state == ThrustState::kArmed || before.state == ThrustState::kManual;
  if (stopped) {
    status_.stops = std::max(before.stops, stops_ordered);
    status_.state = ThrustState::kStopped;
  } else if (armed && age <= kArmedMemory) {
    status_.state = before.state;
    status_.armed = before.armed;
    box_was_ready_ = now;
  } else {
    return;
  }
  status_.cause = ThrustCause::kRemembered;
  status_.since = now;
}

void Arming::latch(Time now) noexcept {
  status_.state = ThrustState::kStopped;
  status_.cause = ThrustCause::kLatch;
  status_.since = now;
}

void Arming::look(const ArmingView& view, Time now) noexcept {
  view_ = view;
  if (status_.since == Time{}) {
    status_.since = now;  // it has been so since it was first asked
  }
  const bool is_tried = view.box == ArmingView::Box::kNotReady;
  if (view.box == ArmingView::Box::kReady) {
    box_was_ready_ = now;
  } else if (now - box_was_ready_ > kArmedMemory + (is_tried ? kBoxTrial_max : Duration::zero())) {
    happen(Event::kBoxLost, ThrustCause::kBoxLost, now);
  }
  const bool abort_stands = view.aborted != Time{} && view.aborted >= status_.armed;
  if (abort_stands) {
    happen(Event::kAbort, ThrustCause::kAbort, now);
  } else if (view.stick != Time{} && view.stick > status_.armed && view.stick > status_.since) {
    happen(Event::kStick, ThrustCause::kOrder, now);
  }
  status_.objections = objections(now);
}

std::uint32_t Arming::objections(Time given) const noexcept {
  const auto when = [](bool is_so, ArmObjection objection) noexcept {
    return is_so ? bit(objection) : 0U;
  };
  return when(status_.state == ThrustState::kStopped, ArmObjection::kStopped) |
         when(view_.box == ArmingView::Box::kAbsent, ArmObjection::kNoThrusters) |
         when(view_.box == ArmingView::Box::kGone, ArmObjection::kBoxGone) |
         when(view_.box == ArmingView::Box::kNotReady, ArmObjection::kBoxNotReady) |
         when(!view_.high_is_heard, ArmObjection::kHighSilent) |
         when(view_.helm_asks != Time{} && view_.helm_asks <= given, ArmObjection::kHelmNotAtRest) |
         when(!view_.stick_is_at_rest, ArmObjection::kStickNotAtRest) |
         when(view_.battery_is_critical, ArmObjection::kBatteryCritical);
}

// A stop that another order knows nothing of came first, whichever was read first. A stop itself is
// obeyed by its number, so that it counts even if its own publication was overwritten.
void Arming::obey(const ThrustOrder& order, std::uint64_t sequence, Time given, Time now) noexcept {
  status_.order = sequence;
  status_.refused_for = 0;
  const bool stop_is_new = order.stops > status_.stops;
  if (stop_is_new) {
    status_.stops = order.stops;
    happen(Event::kStop, ThrustCause::kOrder, now);
  }
  if (order.order == ThrustOrderKind::kStop || order.order == ThrustOrderKind::kNone) {
    status_.answer = ThrustAnswer::kObeyed;
  } else if (stop_is_new || order.stops < status_.stops) {
    status_.answer = ThrustAnswer::kStopCame;
  } else if (now - given > kThrustOrderPatience && order.order != ThrustOrderKind::kDisarm) {
    status_.answer = ThrustAnswer::kTooOld;
  } else {
    status_.answer = answer_to(order.order, given, now);
  }
  status_.objections = objections(now);
}

ThrustAnswer Arming::answer_to(ThrustOrderKind order, Time given, Time now) noexcept {
  switch (order) {
    case ThrustOrderKind::kArm:
      status_.refused_for = objections(given);
      if (status_.refused_for != 0) {
        return ThrustAnswer::kRefused;
      }
      status_.armed = now;
      happen(Event::kArm, ThrustCause::kOrder, now);
      return ThrustAnswer::kObeyed;
    case ThrustOrderKind::kDisarm:
      happen(Event::kDisarm, ThrustCause::kOrder, now);
      return ThrustAnswer::kObeyed;
    case ThrustOrderKind::kRelease:
      return happen(Event::kRelease, ThrustCause::kOrder, now) ? ThrustAnswer::kObeyed
                                                               : ThrustAnswer::kNotStopped;
    case ThrustOrderKind::kToMission:
      return happen(Event::kToMission, ThrustCause::kOrder, now) ? ThrustAnswer::kObeyed
                                                                 : ThrustAnswer::kNotArmed;
    case ThrustOrderKind::kStop:
    case ThrustOrderKind::kNone: break;
  }
  return ThrustAnswer::kObeyed;
}

}  // namespace lodesman
