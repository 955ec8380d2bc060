// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/devices/sim_position_sensor.h"

#include <cmath>

namespace lodesman {
namespace {

// Ours: what small receivers do (1-10 Hz).
constexpr Duration kFixPeriod = std::chrono::milliseconds{200};
// NMEA's ddmm.mmmmm: 0.00001 minute, 2 cm of latitude.
constexpr double kCountsPerDegree = 60.0 * 1e5;

[[nodiscard]] double as_sent_deg(double deg) noexcept {
  return std::round(deg * kCountsPerDegree) / kCountsPerDegree;
}

}  // namespace

SimPositionSensor::SimPositionSensor(const Scenario& scenario, SimLink& link)
    : feed_{link, link.position_due, kFixPeriod,
            FaultSchedule{scenario.faults, FaultDevice::kPosition}},
      frame_{{scenario.environment.origin_latitude_deg, scenario.environment.origin_longitude_deg}},
      sigma_m_{scenario.position.gps_sigma_m},
      noise_{"position", scenario.seed} {}

Reading<PositionFix> SimPositionSensor::poll(Time now) noexcept {
  const SampleFeed::Due due = feed_.poll(now);
  if (due.status != ReadStatus::kFresh) {
    return {due.status, {}};
  }
  WorldPoint p_W{{due.sample.x_m, due.sample.y_m}};
  p_W.xy_m.x() += sigma_m_ * noise_.gaussian();
  p_W.xy_m.y() += sigma_m_ * noise_.gaussian();
  const GeoPoint point = frame_.to_geo(p_W);
  PositionFix fix;
  fix.measured = due.sample.stamp;
  fix.latitude_deg = as_sent_deg(point.latitude_deg);
  fix.longitude_deg = as_sent_deg(point.longitude_deg);
  fix.sigma_m = sigma_m_;
  fix.source = FixSource::kSimulated;
  return {ReadStatus::kFresh, fix};
}

}  // namespace lodesman
