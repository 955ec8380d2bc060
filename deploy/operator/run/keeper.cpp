// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/keeper.h"

#include <algorithm>

#include "deploy/boat/exit_status.h"

namespace lodesman::cli {

const Keeper::Row Keeper::kTransitions[] = {
    {State::kWaiting, Event::kStarted, State::kRunning},
    {State::kWaiting, Event::kStop, State::kOver},
    {State::kRunning, Event::kNotYet, State::kWaiting},
    {State::kRunning, Event::kFailed, State::kWaiting},
    {State::kRunning, Event::kRefused, State::kOver},
    {State::kRunning, Event::kStop, State::kOver},
};

Keeper::Event Keeper::event_of(std::optional<int> exit_status) noexcept {
  return exit_status == kExitNotYet    ? Event::kNotYet
         : exit_status == kExitRefused ? Event::kRefused
                                       : Event::kFailed;
}

bool Keeper::happen(Event event, Time now) noexcept {
  for (const Row& row : kTransitions) {
    if (row.from != state_ || row.event != event) {
      continue;
    }
    state_ = row.to;
    if (row.to == State::kRunning) {
      started_ = now;
      ++starts_;
    } else if (row.to == State::kWaiting) {
      due_ = now + pause_after(event, now);
    }
    return true;
  }
  return false;
}

Duration Keeper::pause_after(Event event, Time now) noexcept {
  if (event == Event::kNotYet) {
    return kSoon;
  }
  if (now - started_ >= kSteady) {
    pause_ = kFirstPause;
  }
  const Duration pause = pause_;
  pause_ = std::min(2 * pause_, kLongestPause);
  return pause;
}

}  // namespace lodesman::cli
