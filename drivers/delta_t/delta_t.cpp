// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/delta_t.h"

#include <algorithm>
#include <utility>

namespace lodesman {
namespace {

using delta_t::Header;
using delta_t::Parsed;
using delta_t::Refusal;

// Taken at one poll; a head sends 25 pings a second at the most, and the rest comes later.
constexpr int kMostDatagramsAPoll = 32;
constexpr int kPeriodsOfSilence = 3;
// One or two of these may be a step in its settings.
constexpr int kImplausibleInARow = 5;

}  // namespace

DeltaT::DeltaT(DatagramSocket& socket, const DeltaTSettings& settings)
    : socket_{socket}, settings_{settings}, frame_{delta_t::control_frame(settings.control)} {}

ReadStatus DeltaT::poll(Time now, SonarPing& out) noexcept {
  const bool is_first = started_ == Time{};
  const bool stalled = is_first || now - polled_ > kStall;
  started_ = is_first ? now : started_;
  polled_ = now_ = now;
  drain(now, stalled);
  if (now - asked_ >= kControlPeriod) {
    ask(now);
  }
  if (std::exchange(is_corrupt_, false)) {
    return ReadStatus::kCorrupt;  // it came first; the ping, if any, is given next
  }
  if (held_bytes_ > 0) {
    return give(out);
  }
  return socket_.fault() == DeviceFault::kNone ? ReadStatus::kNothingNew
                                               : ReadStatus::kDisconnected;
}

void DeltaT::drain(Time now, bool stalled) noexcept {
  for (int i = 0; i < kMostDatagramsAPoll; ++i) {
    const DatagramSocket::Received received = socket_.receive(*incoming_);
    if (!received.any) {
      return;
    }
    ++counts_.datagrams;
    if (stalled) {
      ++counts_.stale;
    } else {
      hear(received.size, now);
    }
  }
}

void DeltaT::hear(std::size_t size, Time now) noexcept {
  const Parsed parsed = delta_t::parse_record(std::span{*incoming_}.first(size));
  if (parsed.refusal != Refusal::kNone) {
    refuse(parsed.refusal);
    return;
  }
  const Header& header = parsed.record.header;
  look_at(header, now);
  const std::optional<std::uint64_t> number = order_.take(header.ping_number);
  if (!number) {
    return;
  }
  counts_.overtaken += held_bytes_ > 0 ? 1U : 0U;
  std::swap(incoming_, held_);
  held_bytes_ = size;
  held_arrival_ = now;
  held_number_ = *number;
}

void DeltaT::refuse(Refusal refusal) noexcept {
  if (refusal == Refusal::kUnknownTag) {
    ++counts_.unknown_tags;
    return;
  }
  ++(refusal == Refusal::kWrongLength ? counts_.wrong_lengths : counts_.implausible);
  ++implausible_in_a_row_;
  is_corrupt_ = true;
}

// Whatever becomes of the ping: what its header says of the program and its settings.
void DeltaT::look_at(const Header& header, Time now) noexcept {
  const bool is_first = heard_ == Time{};
  heard_ = now;
  silence_ = std::max(kSilence, kPeriodsOfSilence * from_seconds(header.repetition_s));
  implausible_in_a_row_ = 0;
  is_unusual_ = !header.fills_its_sector();
  counts_.unusual_beams += is_unusual_ ? 1U : 0U;
  counts_.centimetres += header.resolution_was_cm ? 1U : 0U;
  is_as_asked_ = delta_t::echoes(header, settings_.control);
  if (is_as_asked_ || is_first) {
    as_asked_at_ = now;
  }
  if (!is_as_asked_ || now - asked_ >= kControlPeriod) {
    ask(now);  // at once: the answer goes to whom this came from
  }
}

void DeltaT::ask(Time now) noexcept {
  if (settings_.controls && socket_.reply(frame_)) {
    ++counts_.control_frames;
  }
  asked_ = now;
}

ReadStatus DeltaT::give(SonarPing& out) noexcept {
  const Parsed parsed = delta_t::parse_record(std::span{*held_}.first(held_bytes_));
  held_bytes_ = 0;
  const Time stamp = captured(parsed.record.header);
  if (stamp <= stamped_) {
    ++counts_.overtaken;
    return ReadStatus::kNothingNew;
  }
  stamped_ = stamp;
  ++(parsed.record.header.kind == delta_t::RecordKind::kImage ? counts_.images : counts_.profiles);
  delta_t::fill_ping(parsed.record, settings_.beam_sign, out);
  out.number = held_number_;
  out.captured = stamp;
  return ReadStatus::kFresh;
}

// A played-back recording gives no data latency, and an image's header need not.
Time DeltaT::captured(const Header& header) noexcept {
  if (header.data_latency == Duration::zero()) {
    return held_arrival_;
  }
  const Duration age = header.age_at_arrival();
  counts_.future_stamps += age < Duration::zero() ? 1U : 0U;
  // Nothing was sent before the clock began.
  return held_arrival_ - std::clamp(age, Duration::zero(), held_arrival_ - Time{});
}

DeviceFault DeltaT::fault() const noexcept {
  if (const DeviceFault fault = socket_.fault(); fault != DeviceFault::kNone) {
    return fault;
  }
  if (now_ - (heard_ == Time{} ? started_ : heard_) > silence_) {
    return DeviceFault::kNoAnswer;
  }
  if (implausible_in_a_row_ >= kImplausibleInARow) {
    return DeviceFault::kImplausible;
  }
  if (heard_ == Time{}) {
    return DeviceFault::kNone;
  }
  if (settings_.controls && !is_as_asked_ && now_ - as_asked_at_ > kEchoPatience) {
    return DeviceFault::kSettingRefused;
  }
  return is_unusual_ ? DeviceFault::kUnusualBeams : DeviceFault::kNone;
}

DeltaTCounts DeltaT::counts() const noexcept {
  DeltaTCounts counts = counts_;
  counts.order = order_.counts();
  return counts;
}

}  // namespace lodesman
