// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/battery.h"

#include <cmath>

namespace lodesman {

void BatteryMonitor::look(double volts, Time measured, double load, Time now) noexcept {
  const bool is_new = measured > measured_ && std::isfinite(volts) && volts > 0.0;
  if (is_new) {
    const double at_rest = volts + options_.sag_V * load;
    const bool begins = status_.rest_volts <= 0.0;
    const double dt_s = begins ? 0.0 : to_seconds(measured - measured_);
    const double share = begins ? 1.0 : 1.0 - std::exp(-dt_s / to_seconds(kFilterTime));
    status_.rest_volts += share * (at_rest - status_.rest_volts);
    status_.volts = volts;
    measured_ = measured;
  }
  const bool critical = status_.level == BatteryLevel::kCritical;
  if (measured_ == Time{} || now - measured_ > kSilence_max) {
    status_.rest_volts = 0.0;
    status_.level = critical ? BatteryLevel::kCritical : BatteryLevel::kUnknown;
  } else {
    status_.level = level_now();
  }
}

BatteryLevel BatteryMonitor::level_now() const noexcept {
  const double volts = status_.rest_volts;
  if (status_.level == BatteryLevel::kCritical ||
      (options_.critical_V > 0.0 && volts < options_.critical_V)) {
    return BatteryLevel::kCritical;
  }
  const bool was_low = status_.level == BatteryLevel::kLow;
  if (options_.low_V > 0.0 && volts < options_.low_V + (was_low ? options_.hysteresis_V : 0.0)) {
    return BatteryLevel::kLow;
  }
  return options_.low_V > 0.0 || options_.critical_V > 0.0 ? BatteryLevel::kGood
                                                           : BatteryLevel::kUnknown;
}

}  // namespace lodesman
