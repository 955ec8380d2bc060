// SPDX-License-Identifier: Apache-2.0
// The speed that follows SurgeRef as the vehicle model says, on a straight way. For the sources of
// position that estimate none. One thread.
#pragma once

#include "high_level/estimate/vehicle_model.h"
#include "mid_level/base/time.h"

namespace lodesman {

class Surge {
 public:
  explicit Surge(const VehicleModel& model) noexcept : model_{model} {}

  // [m/s] through the water now, where that SurgeRef was applied since the last call. The first
  // call begins at rest.
  double follow(Time now, int surge_ref) noexcept;
  // Begins at that speed [m/s] instead, which it had then.
  void resume(Time then, double surge_m_s) noexcept;

 private:
  VehicleModel model_;
  double surge_m_s_ = 0.0;
  Time last_{};
  bool running_ = false;
};

}  // namespace lodesman
