// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/surge.h"

#include <algorithm>

namespace lodesman {

void Surge::resume(Time then, double surge_m_s) noexcept {
  surge_m_s_ = surge_m_s;
  last_ = then;
  running_ = true;
}

double Surge::follow(Time now, int surge_ref) noexcept {
  if (running_) {
    const double since_s = std::max(0.0, to_seconds(now - last_));
    surge_m_s_ = model_.surge_carried_on(surge_m_s_, surge_ref, since_s);
  }
  running_ = true;
  last_ = now;
  return surge_m_s_;
}

}  // namespace lodesman
