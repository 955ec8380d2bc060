// SPDX-License-Identifier: Apache-2.0
// What a NAV440 feels, and what it makes of it.
#include <algorithm>
#include <cmath>

#include "hal_sim/emulators/nav440_unit.h"
#include "mid_level/base/heading.h"

namespace lodesman {

using emulated::Nav440BuiltInTest;
using emulated::Nav440Values;
using emulated::uu_type;

namespace {

constexpr Duration kTick = std::chrono::milliseconds{10};
constexpr std::uint64_t kWeek_ms = 604'800'000;
constexpr double kMetresADegree = 111'320.0;  // of latitude; good enough for a few milliseconds
constexpr double kTurnForCalibration_rad = to_rad(380.0);
// For how long an overflow is told of (ours).
constexpr Duration kOverflowShown = std::chrono::seconds{1};

// A count of each, as the packets have them.
constexpr double kRateCount_deg_s = 1260.0 / 65536.0;
constexpr double kAccelerationCount_g = 20.0 / 65536.0;
constexpr double kFieldCount_gauss = 2.0 / 65536.0;

// The ends of what the packets can say.
constexpr double kAngleLeast_deg = -180.0;
constexpr double kRateLeast_deg_s = -630.0;
constexpr double kAccelerationLeast_g = -10.0;

constexpr std::uint16_t kMasterFail = 1U << 0U;
constexpr std::uint16_t kComError = 1U << 2U;
constexpr std::uint16_t kMasterStatus = 1U << 8U;
constexpr std::uint16_t kSoftwareStatus = 1U << 11U;
constexpr std::uint16_t kComBitSerialA = 1U << 0U;
constexpr std::uint16_t kSerialSendOverflow = 1U << 0U;
constexpr std::uint16_t kAlgorithmInitialising = 1U << 0U;

// What points north, east and down, in the axes of a body that is yawed, then pitched, then rolled.
[[nodiscard]] std::array<double, 3> to_body(const std::array<double, 3>& ned, double roll_rad,
                                            double pitch_rad, double yaw_rad) noexcept {
  const double ahead = ned[0] * std::cos(yaw_rad) + ned[1] * std::sin(yaw_rad);
  const double aside = ned[1] * std::cos(yaw_rad) - ned[0] * std::sin(yaw_rad);
  const double x = ahead * std::cos(pitch_rad) - ned[2] * std::sin(pitch_rad);
  const double down = ahead * std::sin(pitch_rad) + ned[2] * std::cos(pitch_rad);
  return {x, aside * std::cos(roll_rad) + down * std::sin(roll_rad),
          down * std::cos(roll_rad) - aside * std::sin(roll_rad)};
}

void tremble(std::array<double, 3>& values, double count, RandomStream& stream) noexcept {
  for (double& value : values) {
    value += count * (2.0 * stream.uniform() - 1.0);
  }
}

}  // namespace

Time Nav440Unit::time_of_tick(std::int64_t tick) const noexcept {
  return power_on_ + from_seconds(to_seconds(kTick) * static_cast<double>(tick) /
                                  (1.0 + options_.clock_drift_ppm * 1e-6));
}

double Nav440Unit::unit_time_s(Time at) const noexcept {
  return to_seconds(at - power_on_) * (1.0 + options_.clock_drift_ppm * 1e-6);
}

std::uint32_t Nav440Unit::itow_ms(Time at) const noexcept {
  // A hair is added: a tick is not to fall before its own millisecond.
  const auto ms =
      options_.constant_itow
          ? std::uint64_t{0}
          : static_cast<std::uint64_t>(std::floor(std::max(0.0, unit_time_s(at) * 1e3 + 1e-3)));
  return static_cast<std::uint32_t>((options_.itow_offset_ms + ms) % kWeek_ms);
}

double Nav440Unit::heading_true_rad(Time at) const noexcept {
  const double gone_s = motion_.measured == Time{} ? 0.0 : to_seconds(at - motion_.measured);
  return motion_.heading_true_rad + motion_.yaw_rate_rad_s * gone_s;
}

Nav440BuiltInTest Nav440Unit::built_in_test(Time at) const noexcept {
  Nav440BuiltInTest test;
  if (at < settling_since_ + options_.initialising) {
    test.software_status = kAlgorithmInitialising;
  }
  if ((test.software_status & live_.at(emulated::kFieldSoftwareStatusMask)) != 0) {
    test.bit_status |= kMasterStatus | kSoftwareStatus;
  }
  if (overflowed_ && at < *overflowed_ + kOverflowShown) {
    test.com_serial_a = kSerialSendOverflow;
    test.com_bit = kComBitSerialA;
    test.bit_status |= kMasterFail | kComError;
  }
  if (const Running* told = running(FaultKind::kBit)) {
    test.bit_status =
        static_cast<std::uint16_t>(test.bit_status | static_cast<unsigned>(told->fault.value));
  }
  return test;
}

// True yaw; the rest of what does not depend on the packet.
Nav440Values Nav440Unit::measure(Time at) {
  Nav440Values v;
  const double gone_s = motion_.measured == Time{} ? 0.0 : to_seconds(at - motion_.measured);
  const double heading_rad = heading_true_rad(at);
  v.roll_deg = to_deg(motion_.roll_rad);
  v.pitch_deg = to_deg(motion_.pitch_rad);
  v.yaw_deg = to_deg(heading_rad);
  v.rate_deg_s = {0.0, 0.0, to_deg(motion_.yaw_rate_rad_s)};
  v.acceleration_g = to_body({0.0, 0.0, -1.0}, motion_.roll_rad, motion_.pitch_rad, heading_rad);
  v.field_gauss =
      to_body({options_.field_horizontal_gauss, 0.0, options_.field_down_gauss}, motion_.roll_rad,
              motion_.pitch_rad, heading_rad - to_rad(options_.declination_deg));
  v.velocity_m_s = {motion_.north_m_s, motion_.east_m_s, 0.0};
  v.latitude_deg = motion_.latitude_deg + motion_.north_m_s * gone_s / kMetresADegree;
  v.longitude_deg =
      motion_.longitude_deg +
      motion_.east_m_s * gone_s / (kMetresADegree * std::cos(to_rad(motion_.latitude_deg)));
  v.altitude_m = options_.altitude_m;
  v.rate_sensor_temperature_c.fill(options_.temperature_c);
  v.board_temperature_c = options_.temperature_c;
  if (options_.flicker) {
    tremble(v.rate_deg_s, kRateCount_deg_s, flicker_);
    tremble(v.acceleration_g, kAccelerationCount_g, flicker_);
    tremble(v.field_gauss, kFieldCount_gauss, flicker_);
  }
  return v;
}

double Nav440Unit::yaw_error_deg(Time at) {
  double error_deg = 0.0;
  if (const Running* step = running(FaultKind::kStep)) {
    error_deg += step->fault.value;
  }
  if (const Running* drift = running(FaultKind::kDrift)) {
    error_deg += drift->fault.value * to_seconds(at - drift->since);
  }
  if (const Running* magnetic = running(FaultKind::kMagnetic)) {
    error_deg += magnetic->fault.value * thrust_share_;
  }
  if (const Running* spike = running(FaultKind::kSpike);
      spike != nullptr && spikes_.uniform() < spike->fault.rate) {
    note(FaultKind::kSpike, at);
    error_deg += spike->fault.value;
  }
  return error_deg;
}

Nav440Values Nav440Unit::values_for(std::uint16_t type, Time at) {
  Nav440Values v = measure(at);
  if (running(FaultKind::kFrozen) == nullptr) {
    frozen_.reset();
  } else if (frozen_) {
    v = *frozen_;
  } else {
    frozen_ = v;
  }
  if (type == uu_type('A', '0') || type == uu_type('A', '1')) {
    v.yaw_deg -= options_.declination_deg;
  } else if (type == uu_type('A', '2')) {
    v.yaw_deg -= to_deg(yaw_at_power_on_rad_);
  }
  v.yaw_deg += yaw_error_deg(at);
  if (running(FaultKind::kInvalid) != nullptr) {
    v.roll_deg = v.pitch_deg = v.yaw_deg = kAngleLeast_deg;
    v.rate_deg_s.fill(kRateLeast_deg_s);
    v.acceleration_g.fill(kAccelerationLeast_g);
  }
  v.itow_ms = itow_ms(at);
  v.counter = counter_;
  v.bit_status = built_in_test(at).bit_status;
  return v;
}

// A calibration that ends by itself does so after more than a whole turn.
void Nav440Unit::watch_turn(Time at, std::vector<Utterance>& said) {
  if (calibration_ != Calibration::kUntilTurned) {
    return;
  }
  const double heading_rad = heading_true_rad(at);
  turned_rad_ += wrap_to_pi(heading_rad - turned_heading_rad_);
  turned_heading_rad_ = heading_rad;
  if (std::abs(turned_rad_) >= kTurnForCalibration_rad) {
    calibration_ = Calibration::kNone;
    // What was asked for, no hard iron in x and y, and a ratio of 1 for the soft iron.
    emulated::Bytes result;
    for (const std::uint16_t word : std::array<std::uint16_t, 4>{0x000C, 0x0000, 0x0000, 0x8000}) {
      emulated::put_u16(result, word);
    }
    say(uu_type('C', 'C'), result, at, said);
  }
}

}  // namespace lodesman
