// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/lag.h"

#include <cmath>

namespace lodesman {

void Lag::resume(Time then, double value) noexcept {
  value_ = value;
  last_ = then;
  running_ = true;
}

double Lag::follow(Time now, double wanted) noexcept {
  if (time_ <= Duration::zero()) {
    return wanted;
  }
  if (running_) {
    value_ += (wanted - value_) * -std::expm1(-to_seconds(now - last_) / to_seconds(time_));
  }
  running_ = true;
  last_ = now;
  return value_;
}

}  // namespace lodesman
