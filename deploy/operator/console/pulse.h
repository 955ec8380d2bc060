// SPDX-License-Identifier: Apache-2.0
// Whether the console itself was held up, as by a machine that slept: what was ordered meanwhile is
// of a time that has gone, and whoever ordered it saw no answer. The console's thread.
#pragma once

#include "mid_level/base/time.h"

namespace lodesman::console {

class Pulse {
 public:
  static constexpr Duration kHeldUp = std::chrono::seconds{1};
  // In which what came meanwhile is read.
  static constexpr Duration kCatchUp = std::chrono::milliseconds{500};

  // In each of the console's steps.
  void beat(Time now) noexcept {
    if (last_ != Time{} && now - last_ > kHeldUp) {
      caught_up_ = now + kCatchUp;
    }
    last_ = now;
  }
  [[nodiscard]] bool is_held_up(Time now) const noexcept {
    return now < caught_up_ || (last_ != Time{} && now - last_ > kHeldUp);
  }

 private:
  Time last_{};
  Time caught_up_{};
};

}  // namespace lodesman::console
