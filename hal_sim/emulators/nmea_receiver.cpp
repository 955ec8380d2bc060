// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/nmea_receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal_sim/emulators/chance.h"

namespace lodesman {

using emulated::NmeaFix;
using emulated::NmeaQuality;

namespace {

// At less than this a receiver tells no course.
constexpr double kCourseLeast_m_s = 0.05;
// Ours: the error of a range, which the geometry of the satellites makes that of a position.
constexpr double kRangeSigma_m = 1.1;
constexpr int kSatellites = 9;

// The first epoch of UTC after a time.
[[nodiscard]] Time epoch_after(Time at, const NmeaReceiverOptions& options) noexcept {
  const Duration since = options.epoch + at.time_since_epoch();
  return at + (options.period - since % options.period);
}

}  // namespace

// The error is the same, draw by draw, as that of a simulated receiver.
EmulatedNmeaReceiver::EmulatedNmeaReceiver(const NmeaReceiverOptions& options, Time now)
    : options_{options},
      frame_{options.origin},
      noise_{"position", options.seed},
      spikes_{"nmea spike", options.seed},
      qualities_{"nmea quality", options.seed},
      sums_{"nmea sums", options.seed},
      next_{epoch_after(now - Duration{1}, options)},
      first_fix_{now} {}

void EmulatedNmeaReceiver::power_cycle(Time now) {
  next_ = epoch_after(now, options_);
  first_fix_ = now + kFirstFixAfter;
  quality_ = NmeaQuality::kOrdinary;
  frozen_.reset();
}

bool EmulatedNmeaReceiver::has_fault(FaultKind kind) const noexcept {
  switch (kind) {
    case FaultKind::kPower:
    case FaultKind::kFrozen:
    case FaultKind::kStep:
    case FaultKind::kDrift:
    case FaultKind::kSpike:
    case FaultKind::kInvalid:
    case FaultKind::kVoid:
    case FaultKind::kWeek:
    case FaultKind::kBadChecksum:
    case FaultKind::kNoChecksum:
    case FaultKind::kQuality: return true;
    default: return false;
  }
}

double EmulatedNmeaReceiver::sigma_m() const noexcept {
  switch (quality_) {
    case NmeaQuality::kRtkFixed: return options_.rtk_fixed_sigma_m;
    case NmeaQuality::kRtkFloat: return options_.rtk_float_sigma_m;
    default: return options_.sigma_m;
  }
}

// From an ordinary fix to RTK float, fixed, float again and back to the ordinary.
void EmulatedNmeaReceiver::change_quality(Time at) {
  const Running* fault = running(FaultKind::kQuality);
  if (fault == nullptr) {
    quality_ = NmeaQuality::kOrdinary;
    return;
  }
  const double chance = fault->fault.rate * to_seconds(options_.period);
  const bool changes = emulated::happens(qualities_, chance);
  const bool upwards = emulated::happens(qualities_, 0.5);
  if (!changes) {
    return;
  }
  note(FaultKind::kQuality, at);
  if (quality_ == NmeaQuality::kRtkFloat) {
    quality_ = upwards ? NmeaQuality::kRtkFixed : NmeaQuality::kOrdinary;
  } else {
    quality_ = NmeaQuality::kRtkFloat;
  }
}

void EmulatedNmeaReceiver::put_place(Time at, NmeaFix& fix) {
  const double passed_s = to_seconds(at - motion_->measured);
  WorldPoint p_W{
      {motion_->x_m + motion_->east_m_s * passed_s, motion_->y_m + motion_->north_m_s * passed_s}};
  p_W.xy_m.x() += sigma_m() * noise_.gaussian();
  p_W.xy_m.y() += sigma_m() * noise_.gaussian();
  if (const Running* step = running(FaultKind::kStep)) {
    p_W.xy_m.x() += step->fault.value;
  }
  if (const Running* drift = running(FaultKind::kDrift)) {
    p_W.xy_m.x() += drift->fault.value * to_seconds(at - drift->since);
  }
  if (const Running* spike = running(FaultKind::kSpike)) {
    const bool hits = emulated::happens(spikes_, spike->fault.rate);
    const double way_rad = 2.0 * std::numbers::pi * spikes_.uniform();
    if (hits) {
      note(FaultKind::kSpike, at);
      p_W.xy_m += spike->fault.value * Eigen::Vector2d{std::sin(way_rad), std::cos(way_rad)};
    }
  }
  GeoPoint place = frame_.to_geo(p_W);
  if (running(FaultKind::kFrozen) != nullptr) {
    frozen_ = frozen_.value_or(place);
    place = *frozen_;
  } else {
    frozen_.reset();
  }
  if (running(FaultKind::kInvalid) != nullptr) {
    place = {0.0, 0.0};
  }
  fix.latitude_deg = place.latitude_deg;
  fix.longitude_deg = place.longitude_deg;
}

NmeaFix EmulatedNmeaReceiver::fix_at(Time at) {
  NmeaFix fix;
  Duration utc = options_.epoch + at.time_since_epoch();
  if (running(FaultKind::kWeek) != nullptr) {
    utc -= emulated::kWeekRollover;
  }
  fix.time = emulated::civil_time(utc);
  change_quality(at);
  put_place(at, fix);
  fix.quality = quality_;
  if (running(FaultKind::kVoid) != nullptr || at < first_fix_) {
    fix.quality = NmeaQuality::kNone;
  }
  fix.satellites = kSatellites;
  fix.hdop = std::clamp(sigma_m() / kRangeSigma_m, 0.5, 50.0);
  fix.altitude_m = options_.altitude_m;
  fix.geoid_m = options_.geoid_m;
  const double course_rad = std::atan2(motion_->east_m_s, motion_->north_m_s);
  fix.speed_m_s = std::hypot(motion_->east_m_s, motion_->north_m_s);
  if (fix.speed_m_s >= kCourseLeast_m_s) {
    fix.course_deg = compass_deg(course_rad);
  }
  fix.variation_deg = options_.variation_deg;
  fix.heading_deg = compass_deg(motion_->heading_true_rad);
  return fix;
}

void EmulatedNmeaReceiver::say(std::string sentence, Time at, std::vector<Utterance>& said) {
  if (const Running* bad = running(FaultKind::kBadChecksum);
      bad != nullptr && emulated::happens(sums_, bad->fault.rate)) {
    char& digit = sentence[emulated::sum_at(sentence) + 1];
    digit = digit == '0' ? '1' : '0';
    note(FaultKind::kBadChecksum, at);
  }
  if (const Running* none = running(FaultKind::kNoChecksum);
      none != nullptr && emulated::happens(sums_, none->fault.rate)) {
    sentence.erase(emulated::sum_at(sentence), 3);
    note(FaultKind::kNoChecksum, at);
  }
  said.push_back({at + options_.latency, {sentence.begin(), sentence.end()}});
}

void EmulatedNmeaReceiver::step(Time now, std::vector<Utterance>& said) {
  for (; next_ <= now; next_ += options_.period) {
    if (is_off() || !motion_) {
      continue;
    }
    const NmeaFix fix = fix_at(next_);
    const emulated::NmeaManner manner{options_.talker, options_.minute_decimals};
    say(emulated::gga(fix, manner), next_, said);
    say(emulated::rmc(fix, manner), next_, said);
    say(emulated::vtg(fix, manner), next_, said);
    if (options_.says_heading) {
      say(emulated::hdt(fix, manner), next_, said);
    }
  }
}

void EmulatedNmeaReceiver::receive(std::span<const std::uint8_t> /*bytes*/, Time /*at*/,
                                   std::vector<Utterance>& /*said*/) {}

}  // namespace lodesman
