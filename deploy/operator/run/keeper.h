// SPDX-License-Identifier: Apache-2.0
// When a program that is to be kept running is started, and started again: by how it ended, with a
// pause that doubles while it does not run for long. What is due is data: it is handed the time and
// does nothing itself. One thread.
#pragma once

#include <cstdint>
#include <optional>

#include "mid_level/base/time.h"

namespace lodesman::cli {

class Keeper {
 public:
  enum class State : std::uint8_t {
    kWaiting,  // to be started once it is due
    kRunning,
    kOver,  // not to be started any more
  };
  enum class Event : std::uint8_t {
    kStarted,  // as it was due
    kNotYet,   // it ended: what it needs is not there yet
    kRefused,  // it ended: its configuration or a file is wrong, and will be the next time
    kFailed,   // it ended in any other way, a good one too, though nobody had asked it to
    kStop,     // nothing is to be kept any more
  };

  // Between an end and the next start: of what was not yet possible; at first, and at most, of what
  // failed. Up to some five failures at one stroke the boat is under control again before its
  // mission holds for the absence (docs/adr/0033).
  static constexpr Duration kSoon = std::chrono::milliseconds{250};
  static constexpr Duration kFirstPause = std::chrono::milliseconds{100};
  static constexpr Duration kLongestPause = std::chrono::seconds{10};
  // Who ran for so long has not failed at once.
  static constexpr Duration kSteady = std::chrono::seconds{10};

  // How a program's end counts: by its exit status, empty where a signal ended it.
  [[nodiscard]] static Event event_of(std::optional<int> exit_status) noexcept;

  // False where the state knows no such event: then nothing has changed.
  bool happen(Event event, Time now) noexcept;

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] bool is_due(Time now) const noexcept {
    return state_ == State::kWaiting && now >= due_;
  }
  [[nodiscard]] Time due() const noexcept { return due_; }
  // How often it was started again.
  [[nodiscard]] unsigned restarts() const noexcept { return starts_ > 0 ? starts_ - 1 : 0; }

 private:
  struct Row {
    State from;
    Event event;
    State to;
  };
  static const Row kTransitions[];

  [[nodiscard]] Duration pause_after(Event event, Time now) noexcept;

  State state_ = State::kWaiting;
  Time due_{};
  Time started_{};
  Duration pause_ = kFirstPause;  // after the next failure
  unsigned starts_ = 0;
};

}  // namespace lodesman::cli
