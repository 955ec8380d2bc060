// SPDX-License-Identifier: Apache-2.0
// A quantity that follows what is asked of it with a lag of the first order, as a hull's speed
// follows its thrust. One thread.
#pragma once

#include "mid_level/base/time.h"

namespace lodesman {

class Lag {
 public:
  // time: to come within 1/e of what is asked; 0: at once.
  explicit Lag(Duration time) noexcept : time_{time} {}

  // The value now, where `wanted` was asked for since the last call. The first call begins at 0.
  double follow(Time now, double wanted) noexcept;
  // Begins at that value instead, which it had then.
  void resume(Time then, double value) noexcept;

 private:
  Duration time_;
  double value_ = 0.0;
  Time last_{};
  bool running_ = false;
};

}  // namespace lodesman
