// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/nmea_receiver.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

// What a fast line brings between two polls, and more.
constexpr std::size_t kMostBytesAPoll = 4096;

// Two sentences of one fix may differ by what one of them rounds: 0.001 minute, and as much again.
constexpr double kSamePlace_deg = 0.002 / 60.0;

// By GGA's quality; kUnknown where that is no fix to steer by.
[[nodiscard]] std::optional<FixQuality> quality_of(const nmea::Gga& gga) noexcept {
  switch (gga.quality) {
    case 1:
    case 3: return FixQuality::kSingle;
    case 2: return FixQuality::kDifferential;
    case 4: return FixQuality::kRtkFixed;
    case 5: return FixQuality::kRtkFloat;
    default: return std::nullopt;
  }
}

// By RMC's status and mode, which old receivers do not have.
[[nodiscard]] std::optional<FixQuality> quality_of(const nmea::Rmc& rmc) noexcept {
  if (!rmc.valid) {
    return std::nullopt;
  }
  switch (rmc.mode) {
    case '\0': return FixQuality::kUnknown;
    case 'A':
    case 'P': return FixQuality::kSingle;
    case 'D': return FixQuality::kDifferential;
    case 'F': return FixQuality::kRtkFloat;
    case 'R': return FixQuality::kRtkFixed;
    default: return std::nullopt;
  }
}

// None where one of the sentences says that there is no fix. GGA knows RTK where RMC, before NMEA
// 4.1, does not.
[[nodiscard]] std::optional<FixQuality> quality_of(const nmea::Epoch& epoch) noexcept {
  const std::optional<FixQuality> rmc = epoch.rmc ? quality_of(*epoch.rmc) : std::nullopt;
  const std::optional<FixQuality> gga = epoch.gga ? quality_of(*epoch.gga) : std::nullopt;
  if ((epoch.rmc && !rmc) || (epoch.gga && !gga)) {
    return std::nullopt;
  }
  return gga ? gga : rmc;
}

[[nodiscard]] bool same_place(const nmea::Place& one, const nmea::Place& other) noexcept {
  const double across = std::abs(one.longitude_deg - other.longitude_deg);
  return std::abs(one.latitude_deg - other.latitude_deg) <= kSamePlace_deg &&
         std::min(across, 360.0 - across) <= kSamePlace_deg;
}

}  // namespace

Reading<PositionFix> NmeaReceiver::poll(Time now) noexcept {
  look_at_connection(now);
  if (connection_ == 0) {
    return {
        stream_.fault() == DeviceFault::kNone ? ReadStatus::kNothingNew : ReadStatus::kDisconnected,
        {}};
  }
  if (!outlet_.has_fix()) {
    read_on(now);
    if (now - heard_ > kSilence) {
      outlet_.ails(DeviceFault::kNoAnswer);
    }
  }
  return outlet_.take();
}

void NmeaReceiver::look_at_connection(Time now) noexcept {
  const std::uint64_t connection = stream_.connection(now);
  if (connection == connection_) {
    return;
  }
  connection_ = connection;
  framing_.restart();
  epochs_.restart();
  chunk_size_ = chunk_at_ = 0;
  outlet_.restart();
  any_heard_ = false;
  heard_ = now;
}

bool NmeaReceiver::refill(Time now) noexcept {
  const Received received = stream_.read(std::span{chunk_}.first(std::min(kChunk, left_)), now);
  chunk_size_ = received.count;
  chunk_at_ = 0;
  left_ -= received.count;
  arrived_ = std::min(received.at, now);
  return received.count > 0;
}

void NmeaReceiver::read_on(Time now) noexcept {
  const std::uint64_t damaged_before = damaged();
  left_ = kMostBytesAPoll;
  while (!outlet_.has_fix() && (chunk_at_ < chunk_size_ || refill(now))) {
    const std::optional<std::string_view> sentence = framing_.push(chunk_[chunk_at_++]);
    if (framing_.pending() == 1) {
      begun_ = arrived_;
    }
    if (sentence) {
      hear(*sentence, now);
    }
  }
  if (!outlet_.has_fix()) {
    take_epoch(now);
  }
  if (any_heard_ && damaged() != damaged_before) {
    outlet_.damaged();
  }
}

void NmeaReceiver::hear(std::string_view sentence, Time now) noexcept {
  const nmea::Sentence said = nmea::decoded(sentence);
  if (std::holds_alternative<nmea::Malformed>(said)) {
    ++counts_.malformed;
  } else if (const auto* vtg = std::get_if<nmea::Vtg>(&said)) {
    epochs_.take(*vtg, begun_);
  } else if (const auto* rmc = std::get_if<nmea::Rmc>(&said)) {
    take_part(epochs_.take(*rmc, begun_), now);
  } else if (const auto* gga = std::get_if<nmea::Gga>(&said)) {
    take_part(epochs_.take(*gga, begun_), now);
  }
  take_epoch(now);
}

// Of a sentence that tells of a fix, and has one or not.
void NmeaReceiver::take_part(bool has_fix, Time now) noexcept {
  heard_ = now;
  any_heard_ = true;
  if (!has_fix) {
    outlet_.ails(DeviceFault::kNoFix);
  }
}

void NmeaReceiver::take_epoch(Time now) noexcept {
  if (const std::optional<nmea::Epoch> epoch = epochs_.next(now)) {
    judge(*epoch);
  }
}

void NmeaReceiver::judge(const nmea::Epoch& epoch) noexcept {
  const std::optional<FixQuality> quality = quality_of(epoch);
  const std::optional<nmea::Place> by_rmc = epoch.rmc ? epoch.rmc->place : std::nullopt;
  const std::optional<nmea::Place> by_gga = epoch.gga ? epoch.gga->place : std::nullopt;
  if (!quality || (!by_rmc && !by_gga)) {
    ++counts_.voids;
    outlet_.ails(DeviceFault::kNoFix);
    return;
  }
  const nmea::Place place = by_gga ? *by_gga : *by_rmc;
  if (is_nowhere(place.latitude_deg, place.longitude_deg) ||
      (by_rmc && by_gga && !same_place(*by_rmc, *by_gga))) {
    outlet_.refuse(counts_.nowhere, DeviceFault::kImplausible);
    return;
  }
  PositionFix fix;
  fix.latitude_deg = place.latitude_deg;
  fix.longitude_deg = place.longitude_deg;
  fix.quality = *quality;
  fix.sigma_m = fix_sigma_m(*quality, epoch.gga ? epoch.gga->hdop : std::nullopt);
  give(fix, epoch);
}

void NmeaReceiver::give(PositionFix fix, const nmea::Epoch& epoch) noexcept {
  const FixStamp::Judged judged = stamp_.judge(epoch.time_of_day, epoch.arrived - options_.latency);
  if (judged.verdict != FixStamp::Verdict::kNew) {
    ++counts_.repeated;
    return;
  }
  fix.measured = judged.measured;
  fix.source = FixSource::kNmea;
  const nmea::Vtg vtg = epoch.vtg.value_or(nmea::Vtg{});
  const nmea::Rmc rmc = epoch.rmc.value_or(nmea::Rmc{});
  const std::optional<double> speed_m_s = rmc.speed_m_s ? rmc.speed_m_s : vtg.speed_m_s;
  const std::optional<double> course_rad = rmc.course_rad ? rmc.course_rad : vtg.course_rad;
  fix.has_speed = speed_m_s.has_value();
  fix.speed_m_s = speed_m_s.value_or(0.0);
  fix.has_course = course_rad.has_value();
  fix.course_rad = course_rad.value_or(0.0);
  outlet_.offer(
      fix, rmc.date_ns ? std::optional{*rmc.date_ns + epoch.time_of_day.count()} : std::nullopt);
}

std::uint64_t NmeaReceiver::damaged() const noexcept {
  const NmeaFramingCounts& counts = framing_.counts();
  return counts.wrong_checksums + counts.without_checksum + counts.broken + counts.too_long +
         counts_.malformed;
}

DeviceFault NmeaReceiver::fault() const noexcept {
  if (connection_ == 0) {
    if (const DeviceFault fault = stream_.fault(); fault != DeviceFault::kNone) {
      return fault;
    }
  }
  return outlet_.fault();
}

NmeaCounts NmeaReceiver::counts() const noexcept {
  NmeaCounts counts = counts_;
  counts.framing = framing_.counts();
  counts.given = outlet_.counts();
  return counts;
}

}  // namespace lodesman
