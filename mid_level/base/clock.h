// SPDX-License-Identifier: Apache-2.0
// Where the time comes from: the machine's steady clock, or a clock that the lock-step runner
// moves. Only runners and main files hold a Clock; tasks are handed a Time.
#pragma once

#include "mid_level/base/time.h"

namespace lodesman {

class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;
  [[nodiscard]] virtual Time now() const noexcept = 0;
};

// CLOCK_MONOTONIC: one time line for every process on the machine. Any thread.
class SteadyClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override;
};

// Moved by its owner alone, never backwards. One thread.
class SimClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override { return now_; }
  void advance_to(Time t) noexcept;

 private:
  Time now_{};
};

}  // namespace lodesman
