// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/sensors.h"

namespace lodesman {
namespace {

// More samples than any device buffers between two steps; what is left comes with the next step.
constexpr int kMaxSamplesPerStep = 16;

template <class Sensor, class Sample>
void publish_all(Sensor& sensor, Writer<Sample>& writer, Time now) noexcept {
  for (int i = 0; i < kMaxSamplesPerStep; ++i) {
    const auto reading = sensor.poll(now);
    if (reading.status == ReadStatus::kNothingNew || reading.status == ReadStatus::kDisconnected) {
      return;
    }
    if (reading.status == ReadStatus::kFresh) {
      writer.publish(reading.sample, now);
    }
  }
}

}  // namespace

void AhrsTask::step(Time now) noexcept { publish_all(sensor_, attitudes_, now); }

void PositionTask::step(Time now) noexcept { publish_all(sensor_, fixes_, now); }

}  // namespace lodesman
