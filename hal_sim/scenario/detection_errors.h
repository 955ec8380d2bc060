// SPDX-License-Identifier: Apache-2.0
// What goes wrong with the returns of a simulated sonar that gives profiles, and how often: all
// nought where nobody says otherwise. Plain data, read by one thread at start-up, which throws
// StartupError; afterwards any thread may look at it.
#pragma once

#include "mid_level/config/toml_document.h"

namespace lodesman {

struct DetectionErrors {
  double missed = 0.0;          // [-] [0, 0.9] share of the pings in which an obstacle is absent
  double split = 0.0;           // [-] [0, 1] share of the pings in which it has a hole
  double displaced_m = 0.0;     // [m] [0, 5] standard deviation of all its returns of a ping
  double false_per_ping = 0.0;  // [-] [0, 10] clusters of returns of nothing, on average
  double noise_m = 0.0;         // [m] [0, 1] standard deviation of each return

  [[nodiscard]] bool any() const noexcept {
    return missed > 0.0 || split > 0.0 || displaced_m > 0.0 || false_per_ping > 0.0 ||
           noise_m > 0.0;
  }
};

// Keys that are left out are nought.
[[nodiscard]] DetectionErrors read_detection_errors(const TomlTable& table);

}  // namespace lodesman
