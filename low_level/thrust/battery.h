// SPDX-License-Identifier: Apache-2.0
// How full the battery is, from the volts that a thruster box tells: without the sag under load,
// filtered over seconds, and with a hysteresis, so that an alarm is given once. Pure; part of the
// thruster task and so of its thread.
#pragma once

#include "mid_level/base/time.h"
#include "mid_level/messages/arming.h"

namespace lodesman {

struct BatteryOptions {
  double low_V = 0.0;         // [V] at rest; 0: no limit, its level is then never told
  double critical_V = 0.0;    // [V] below low_V; 0: no limit
  double hysteresis_V = 0.5;  // [V] above a limit before the level is better again
  double sag_V = 1.5;         // [V] that full thrust of both sides takes away
};

class BatteryMonitor {
 public:
  static constexpr Duration kFilterTime = std::chrono::seconds{5};
  static constexpr Duration kSilence_max = std::chrono::seconds{5};

  explicit BatteryMonitor(const BatteryOptions& options) noexcept : options_{options} {}

  // `measured`: of the newest reading, 0 where there was none; `load`: share [0, 1] of the full
  // load of both thrusters when it was taken.
  void look(double volts, Time measured, double load, Time now) noexcept;
  [[nodiscard]] const BatteryStatus& status() const noexcept { return status_; }

 private:
  [[nodiscard]] BatteryLevel level_now() const noexcept;

  BatteryOptions options_;
  BatteryStatus status_;
  Time measured_{};
};

}  // namespace lodesman
