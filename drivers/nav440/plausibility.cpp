// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/plausibility.h"

#include <algorithm>
#include <cmath>

#include "mid_level/base/heading.h"

namespace lodesman::nav440 {
namespace {

// Times come in whole milliseconds, from a crystal of the unit's or from the satellites.
constexpr Duration kTimeTolerance = std::chrono::milliseconds{1};
// Between the unit's clock and ours, at the most: 50 ppm of each.
constexpr std::int64_t kDriftPart = 10000;
// By how much a packet may seem to come before it was measured, until batches of the adapter (16
// ms) have shown how early one can come.
constexpr Duration kEarly = std::chrono::milliseconds{50};

constexpr double kYawNoise_deg = 0.5;
constexpr double kYawDrift_deg_s = 5.0;
constexpr double kYawCurve_deg_s2 = 10.0;
constexpr double kRateNoise_deg_s = 3.0;
constexpr double kRateChange_deg_s2 = 500.0;
constexpr double kMostRateChange_deg_s = 60.0;
constexpr double kLeastCosine = 0.5;  // a boat does not stand on its bow

// Of the heading, from the rates about the body's axes.
[[nodiscard]] double yaw_rate_rad_s(const HeadingPacket& packet) noexcept {
  const double cosine = std::max(std::cos(packet.angles.pitch_rad), kLeastCosine);
  return (packet.rate_rad_s[1] * std::sin(packet.angles.roll_rad) +
          packet.rate_rad_s[2] * std::cos(packet.angles.roll_rad)) /
         cosine;
}

[[nodiscard]] bool turned_as_it_says(const HeadingPacket& from, const HeadingPacket& to,
                                     double step_s) noexcept {
  if (std::abs(to.rate_rad_s[2] - from.rate_rad_s[2]) > Plausibility::rate_bound_rad_s(step_s)) {
    return false;
  }
  const double by_rate_rad = 0.5 * step_s * (yaw_rate_rad_s(from) + yaw_rate_rad_s(to));
  const double turned_rad = to.angles.yaw_rad - from.angles.yaw_rad;
  return std::abs(wrap_to_pi(turned_rad - by_rate_rad)) <= Plausibility::yaw_bound_rad(step_s);
}

}  // namespace

double Plausibility::yaw_bound_rad(double step_s) noexcept {
  return to_rad(kYawNoise_deg + step_s * (kYawDrift_deg_s + step_s * kYawCurve_deg_s2));
}

double Plausibility::rate_bound_rad_s(double step_s) noexcept {
  return to_rad(std::min(kRateNoise_deg_s + step_s * kRateChange_deg_s2, kMostRateChange_deg_s));
}

void Plausibility::restart() noexcept {
  believed_ = {};
  candidate_ = {};
  any_seen_ = stands_ = false;
  still_ = running_ = 0;
}

Plausibility::Judged Plausibility::judge(const HeadingPacket& packet, Time arrived) noexcept {
  watch_time(packet);
  if (follow(believed_, packet, arrived)) {
    candidate_ = {};
    return {Verdict::kBelieved, believed_.measured};
  }
  if (!follow(candidate_, packet, arrived)) {
    candidate_ = {1, packet, arrived, arrived};
  } else if (candidate_.length >= kConsistent) {
    believed_ = candidate_;
    candidate_ = {};
    return {Verdict::kBelieved, believed_.measured};
  }
  if (believed_.length > 0 && arrived - believed_.arrived > longest_step_) {
    believed_ = {};
  }
  return {believed_.length > 0 ? Verdict::kRefused : Verdict::kNotYet, {}};
}

bool Plausibility::follow(Chain& chain, const HeadingPacket& packet, Time arrived) noexcept {
  if (chain.length == 0) {
    return false;
  }
  const Duration step =
      stands_ ? step_by_arrival(chain, arrived) : step_by_time(chain, packet, arrived);
  if (step == Duration::zero() || !turned_as_it_says(chain.last, packet, to_seconds(step))) {
    return false;
  }
  chain.measured = stands_ ? arrived : std::min(chain.measured + step + step / kDriftPart, arrived);
  chain.length = std::min(chain.length + 1, kConsistent);
  chain.last = packet;
  chain.arrived = arrived;
  return true;
}

Duration Plausibility::step_of_time(const HeadingPacket& from,
                                    const HeadingPacket& to) const noexcept {
  const std::int64_t wraps_ms = to.time_wraps_ms;
  const std::int64_t passed_ms = std::int64_t{to.time_ms} - std::int64_t{from.time_ms} +
                                 (to.time_ms < from.time_ms ? wraps_ms : 0);
  const Duration passed = std::chrono::milliseconds{passed_ms};
  const Duration step = (passed + period_ / 2) / period_ * period_;
  const Duration off = std::chrono::abs(passed - step);
  return passed <= longest_step_ && off <= kTimeTolerance ? step : Duration::zero();
}

Duration Plausibility::step_by_time(const Chain& chain, const HeadingPacket& packet,
                                    Time arrived) const noexcept {
  const Duration step = step_of_time(chain.last, packet);
  return chain.measured + step <= arrived + kEarly ? step : Duration::zero();
}

Duration Plausibility::step_by_arrival(const Chain& chain, Time arrived) const noexcept {
  const Duration passed = arrived - chain.arrived;
  return passed > longest_step_ ? Duration::zero()
                                : std::max((passed + period_ / 2) / period_ * period_, period_);
}

void Plausibility::watch_time(const HeadingPacket& packet) noexcept {
  if (any_seen_) {
    const bool still = packet.time_ms == seen_.time_ms;
    const bool runs = !still && step_of_time(seen_, packet) != Duration::zero();
    still_ = still ? std::min(still_ + 1, still_needed_) : 0;
    running_ = runs ? std::min(running_ + 1, kConsistent) : 0;
    if (!stands_ && still_ >= still_needed_) {
      stands_ = true;
      candidate_ = {};
    } else if (stands_ && running_ >= kConsistent) {
      stands_ = false;
    }
  }
  seen_ = packet;
  any_seen_ = true;
}

}  // namespace lodesman::nav440
