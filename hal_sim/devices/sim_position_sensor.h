// SPDX-License-Identifier: Apache-2.0
// A simulated satellite receiver: a fix at 5 Hz with gaussian error, as coarse as NMEA text sends
// it. Polled by the one thread that owns it.
#pragma once

#include "drivers/hal/devices.h"
#include "hal_sim/devices/sample_feed.h"
#include "hal_sim/scenario/scenario.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/base/random_stream.h"

namespace lodesman {

class SimPositionSensor final : public PositionSensor {
 public:
  // The link must outlive the sensor.
  SimPositionSensor(const Scenario& scenario, SimLink& link);
  [[nodiscard]] Reading<PositionFix> poll(Time now) noexcept override;

 private:
  SampleFeed feed_;
  LocalFrame frame_;
  double sigma_m_;
  RandomStream noise_;
};

}  // namespace lodesman
