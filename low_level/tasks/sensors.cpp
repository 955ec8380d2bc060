// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/sensors.h"

#include "mid_level/base/heading.h"

namespace lodesman {
namespace {

// More samples than any device buffers between two steps; what is left comes with the next step.
constexpr int kMaxSamplesPerStep = 16;

// What is not sane is dropped, as if the device had been silent. `turned` makes of a sample that is
// the vehicle's.
template <class Sensor, class Sample, class Turned>
void publish_all(Sensor& sensor, Writer<Sample>& writer, DeviceReport& device, Time now,
                 Turned turned) noexcept {
  for (int i = 0; i < kMaxSamplesPerStep; ++i) {
    const auto reading = sensor.poll(now);
    // The end of what there was says nothing of the device.
    if (reading.status == ReadStatus::kNothingNew && i > 0) {
      break;
    }
    const bool believed = reading.status == ReadStatus::kFresh && sane(reading.sample);
    device.keeper().polled(reading.status, believed, now);
    if (believed) {
      writer.publish(turned(reading.sample), now);
    }
    if (reading.status == ReadStatus::kNothingNew || reading.status == ReadStatus::kDisconnected) {
      break;
    }
  }
  device.keeper().ails(sensor.fault());
  device.publish(now);
}

}  // namespace

void AhrsTask::step(Time now) noexcept {
  publish_all(sensor_, attitudes_, device_, now, [this](Attitude attitude) {
    attitude.heading_rad = wrap_to_pi(attitude.heading_rad - turn_rad_);
    return attitude;
  });
}

void PositionTask::step(Time now) noexcept {
  if (sensor_ == nullptr) {
    device_.keeper().absent(now);
    device_.publish(now);
    return;
  }
  // The antenna's place is moved to the vehicle's by the estimator, who knows the heading.
  publish_all(*sensor_, fixes_, device_, now, [](const PositionFix& fix) { return fix; });
}

}  // namespace lodesman
