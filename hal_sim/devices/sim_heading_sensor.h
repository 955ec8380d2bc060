// SPDX-License-Identifier: Apache-2.0
// A simulated AHRS: the true heading and yaw rate at 50 Hz, as coarse as the NAV440 sends them, or
// exact.
// Polled by the one thread that owns it.
#pragma once

#include "drivers/hal/devices.h"
#include "hal_sim/devices/sample_feed.h"
#include "hal_sim/scenario/scenario.h"

namespace lodesman {

class SimHeadingSensor final : public HeadingSensor {
 public:
  // The link must outlive the sensor.
  SimHeadingSensor(const Scenario& scenario, SimLink& link, bool like_nav440 = true);
  [[nodiscard]] Reading<Attitude> poll(Time now) noexcept override;

 private:
  SampleFeed feed_;
  bool like_nav440_;
};

}  // namespace lodesman
