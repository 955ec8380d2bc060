// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/sensors.h"

namespace lodesman {
namespace {

// More samples than any device buffers between two steps; what is left comes with the next step.
constexpr int kMaxSamplesPerStep = 16;

// Gives how many samples were not sane: they are dropped, as if the device had been silent.
template <class Sensor, class Sample>
[[nodiscard]] std::uint64_t publish_all(Sensor& sensor, Writer<Sample>& writer, Time now) noexcept {
  std::uint64_t refused = 0;
  for (int i = 0; i < kMaxSamplesPerStep; ++i) {
    const auto reading = sensor.poll(now);
    if (reading.status == ReadStatus::kNothingNew || reading.status == ReadStatus::kDisconnected) {
      break;
    }
    if (reading.status == ReadStatus::kFresh && sane(reading.sample)) {
      writer.publish(reading.sample, now);
    } else if (reading.status == ReadStatus::kFresh) {
      ++refused;
    }
  }
  return refused;
}

}  // namespace

void AhrsTask::step(Time now) noexcept { refused_ += publish_all(sensor_, attitudes_, now); }

void PositionTask::step(Time now) noexcept { refused_ += publish_all(sensor_, fixes_, now); }

}  // namespace lodesman
