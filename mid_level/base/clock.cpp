// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/clock.h"

#include "mid_level/base/check.h"
#include "mid_level/base/stopwatch.h"

namespace lodesman {

Time SteadyClock::now() const noexcept {
  return Time{
      std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch())};
}

void SimClock::advance_to(Time t) noexcept {
  LODESMAN_CHECK(t >= now_);
  now_ = t;
}

Stopwatch::Stopwatch() noexcept : started_{SteadyClock{}.now()} {}

Duration Stopwatch::elapsed() const noexcept { return SteadyClock{}.now() - started_; }

}  // namespace lodesman
