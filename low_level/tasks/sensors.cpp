// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/sensors.h"

#include <bit>
#include <cstdlib>

#include "mid_level/base/heading.h"

namespace lodesman {
namespace {

// More samples than any device buffers between two steps; what is left comes with the next step.
constexpr int kMaxSamplesPerStep = 16;

// What is not sane, or not possible, is dropped, as if the device had been silent. `turned` makes
// of a sample that is the vehicle's.
template <class Sensor, class Sample, class Possible, class Turned>
void publish_all(Sensor& sensor, Writer<Sample>& writer, DeviceReport& device, Time now,
                 Possible possible, Turned turned) noexcept {
  for (int i = 0; i < kMaxSamplesPerStep; ++i) {
    const auto reading = sensor.poll(now);
    // The end of what there was says nothing of the device.
    if (reading.status == ReadStatus::kNothingNew && i > 0) {
      break;
    }
    const bool believed =
        reading.status == ReadStatus::kFresh && sane(reading.sample) && possible(reading.sample);
    device.keeper().polled(reading.status, believed, now);
    if (believed) {
      writer.publish(turned(reading.sample), now);
    }
    if (reading.status == ReadStatus::kNothingNew || reading.status == ReadStatus::kDisconnected) {
      break;
    }
  }
}

}  // namespace

void AhrsTask::step(Time now) noexcept {
  publish_all(
      sensor_, attitudes_, device_, now, [](const Attitude&) { return true; },
      [this](Attitude attitude) {
        attitude.heading_rad = wrap_to_pi(attitude.heading_rad - turn_rad_);
        return attitude;
      });
  device_.keeper().ails(sensor_.fault());
  device_.publish(now);
}

void PositionTask::step(Time now) noexcept {
  if (sensor_ == nullptr) {
    device_.keeper().absent(now);
    device_.publish(now);
    return;
  }
  // The antenna's place is moved to the vehicle's by the estimator, who knows the heading.
  publish_all(
      *sensor_, fixes_, device_, now, [this](const PositionFix& fix) { return is_near(fix); },
      [this, now](const PositionFix& fix) {
        look_for_frozen(fix, now);
        return fix;
      });
  const DeviceFault fault = sensor_->fault();
  const bool speaks = fault == DeviceFault::kNone || fault == DeviceFault::kWrongDate;
  device_.keeper().ails(speaks && is_far_      ? DeviceFault::kFarOff
                        : speaks && is_frozen_ ? DeviceFault::kFrozen
                                               : fault);
  device_.publish(now);
}

bool PositionTask::is_near(const PositionFix& fix) noexcept {
  std::optional<GeoPoint> origin = options_.origin;
  if (const auto* told = origin ? nullptr : origin_.latest();
      told != nullptr && told->value.source == OriginSource::kFirstFix) {
    origin = GeoPoint{told->value.latitude_deg, told->value.longitude_deg};
  }
  is_far_ = origin && !(rough_distance_m(*origin, {fix.latitude_deg, fix.longitude_deg}) <=
                        options_.far_max_m);
  return !is_far_;
}

void PositionTask::look_for_frozen(const PositionFix& fix, Time now) noexcept {
  const auto same_digits = [](double one, double other) {
    return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
  };
  const auto* thrust = thrust_.fresh(now, max_age::kThrustApplied);
  const bool drives = thrust != nullptr && std::abs(thrust->value.surge_ref) >= kDrivingSurgeRef;
  if (!drives || !same_digits(fix.latitude_deg, place_.latitude_deg) ||
      !same_digits(fix.longitude_deg, place_.longitude_deg)) {
    place_ = {fix.latitude_deg, fix.longitude_deg};
    same_since_ = fix.measured;
  }
  is_frozen_ = fix.measured - same_since_ >= kFrozenFor;
}

}  // namespace lodesman
