// SPDX-License-Identifier: Apache-2.0
// All that a position sensor has now, as a task that is often enough there would get it.
#pragma once

#include <vector>

#include "drivers/hal/devices.h"

namespace lodesman::testing {

// `corrupt`: counts on; `last`: what it said when there was no more.
template <class Count>
[[nodiscard]] std::vector<PositionFix> fixes_now(PositionSensor& sensor, Time now, Count& corrupt,
                                                 ReadStatus& last) {
  constexpr int kMost = 64;
  std::vector<PositionFix> given;
  for (int i = 0; i < kMost; ++i) {
    const auto reading = sensor.poll(now);
    if (reading.status == ReadStatus::kFresh) {
      given.push_back(reading.sample);
    } else if (reading.status == ReadStatus::kCorrupt) {
      ++corrupt;
    } else {
      last = reading.status;
      break;
    }
  }
  return given;
}

}  // namespace lodesman::testing
