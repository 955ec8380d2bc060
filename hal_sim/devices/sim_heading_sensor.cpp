// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/devices/sim_heading_sensor.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

constexpr Duration kHeadingPeriod = std::chrono::milliseconds{20};
constexpr double kAngleCount_rad = to_rad(360.0 / 65536.0);
constexpr double kRateCount_rad_s = to_rad(1260.0 / 65536.0);
constexpr double kMaxRateCount = 32767.0;

[[nodiscard]] double as_sent_angle_rad(double rad) noexcept {
  const double count = std::round(rad / kAngleCount_rad);
  return (count >= 32768.0 ? count - 65536.0 : count) * kAngleCount_rad;
}
[[nodiscard]] double as_sent_rate_rad_s(double rad_s) noexcept {
  return std::clamp(std::round(rad_s / kRateCount_rad_s), -kMaxRateCount, kMaxRateCount) *
         kRateCount_rad_s;
}

}  // namespace

SimHeadingSensor::SimHeadingSensor(const Scenario& scenario, SimLink& link, bool like_nav440)
    : feed_{link, link.heading_due, kHeadingPeriod,
            FaultSchedule{scenario.faults, FaultDevice::kAhrs}},
      like_nav440_{like_nav440} {}

Reading<Attitude> SimHeadingSensor::poll(Time now) noexcept {
  const SampleFeed::Due due = feed_.poll(now);
  if (due.status != ReadStatus::kFresh) {
    return {due.status, {}};
  }
  Attitude attitude;
  attitude.measured = due.sample.stamp;
  const double heading_rad = due.sample.heading_rad;
  const double yaw_rate_rad_s = due.sample.yaw_rate_rad_s;
  attitude.heading_rad = like_nav440_ ? as_sent_angle_rad(heading_rad) : heading_rad;
  attitude.yaw_rate_rad_s = like_nav440_ ? as_sent_rate_rad_s(yaw_rate_rad_s) : yaw_rate_rad_s;
  return {ReadStatus::kFresh, attitude};
}

}  // namespace lodesman
