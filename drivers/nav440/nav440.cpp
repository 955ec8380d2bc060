// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/nav440.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mid_level/base/heading.h"

namespace lodesman {
namespace {

using nav440::HeadingPacket;
using nav440::Plausibility;

constexpr Duration kSilence = std::chrono::seconds{1};
constexpr int kPeriodsOfSilence = 3;
// What a line brings in a third of a second, far more than between two polls; the rest comes later.
constexpr std::size_t kMostBytesAPoll = 2048;
// Packets in a row that it was not asked for: it has been switched off and on.
constexpr int kOfAnotherStream = 3;
// One or two of these may be a step; a row of them is a fault.
constexpr int kImplausibleInARow = 5;
// A unit whose time stands still is known by then, and any other has been believed.
constexpr int kToBeginWith = 12;
// A packet that is refused weighs as much as so many that are believed.
constexpr int kImplausibleWeight = 4;

}  // namespace

Nav440::Nav440(ByteStream& stream, Nav440Options options, Nav440FixRelay* fixes)
    : stream_{stream},
      options_{(check_nav440_options(options), options)},
      start_up_{stream, options_},
      plausibility_{options_.rate_hz},
      frozen_watch_{options_.rate_hz},
      fix_maker_{fixes} {}

Reading<Attitude> Nav440::poll(Time now) noexcept {
  const Reading<Attitude> reading = poll_unit(now);
  fix_maker_.tell(connection_ != 0, fault());
  return reading;
}

Reading<Attitude> Nav440::poll_unit(Time now) noexcept {
  look_at_connection(now);
  if (connection_ == 0) {
    return {
        stream_.fault() == DeviceFault::kNone ? ReadStatus::kNothingNew : ReadStatus::kDisconnected,
        {}};
  }
  if (polled_ != Time{} && now - polled_ > silence_limit()) {
    start_up_.begin_again(DeviceFault::kNone, now);
  }
  polled_ = now;
  if (!ready_) {
    read_on(now);
    start_up_.step(now);
    if (streaming() && now - heard_ > silence_limit()) {
      start_up_.begin_again(DeviceFault::kNone, now);
    }
  }
  if (std::exchange(is_corrupt_, false)) {
    return {ReadStatus::kCorrupt, {}};  // it came first; the sample, if any, is given next
  }
  if (!ready_) {
    return {ReadStatus::kNothingNew, {}};
  }
  ++counts_.samples;
  return {ReadStatus::kFresh, *std::exchange(ready_, std::nullopt)};
}

void Nav440::look_at_connection(Time now) noexcept {
  const std::uint64_t connection = stream_.connection(now);
  if (connection == connection_) {
    return;
  }
  connection_ = connection;
  framing_.restart();
  ready_.reset();
  is_corrupt_ = false;
  if (connection != 0) {
    polled_ = now;
    start_up_.connected(now);
  }
}

// As many bytes at a time as the next frame needs at least, so that the time of the last of them is
// the time of the frame.
void Nav440::read_on(Time now) noexcept {
  std::array<std::uint8_t, Nav440Framing::kLongestFrame> bytes{};
  const std::uint64_t skipped = framing_.counts().skipped_bytes;
  for (std::size_t left = kMostBytesAPoll; !ready_ && !start_up_.awaits_connection();) {
    if (const std::optional<Nav440Frame> frame = framing_.next()) {
      hear(*frame, now);
      continue;
    }
    const std::size_t wanted = std::min(framing_.wanted(), left);
    const Received received = stream_.read(std::span{bytes}.first(wanted), now);
    if (received.count == 0) {
      break;
    }
    left -= received.count;
    arrived_ = std::min(received.at, now);
    static_cast<void>(framing_.push(std::span{bytes}.first(received.count)));
  }
  is_corrupt_ |= streaming() && framing_.counts().skipped_bytes != skipped;
}

void Nav440::hear(const Nav440Frame& frame, Time now) noexcept {
  start_up_.hear(frame, now);
  if (!streaming()) {
    return;
  }
  if (start_up_.streams() != stream_seen_) {
    begin_stream();
  }
  if (frame.type == start_up_.packet()) {
    of_another_stream_ = 0;
    heard_ = now;
    take(frame);
    // Of packets at another rate, one that follows from none comes again and again.
    if (implausible_weight_ > kImplausibleWeight * options_.rate_hz) {
      start_up_.begin_again(DeviceFault::kImplausible, now);
    }
  } else if (nav440::is_continuous(frame.type) && ++of_another_stream_ >= kOfAnotherStream) {
    start_up_.begin_again(DeviceFault::kNone, now);
  }
}

void Nav440::begin_stream() noexcept {
  stream_seen_ = start_up_.streams();
  plausibility_.restart();
  frozen_watch_.restart();
  ails_ = DeviceFault::kNone;
  implausible_in_a_row_ = implausible_weight_ = of_another_stream_ = 0;
}

void Nav440::refuse(std::uint64_t& count) noexcept {
  ++count;
  is_corrupt_ = true;
}

void Nav440::take(const Nav440Frame& frame) noexcept {
  const std::optional<HeadingPacket> packet = nav440::heading_packet(frame.type, frame.payload);
  if (!packet) {
    return;
  }
  const bool frozen = frozen_watch_.frozen(frame.type, frame.payload);
  if ((packet->bit & nav440::kMasterFail) != 0) {
    ails_ = DeviceFault::kSelfTestFailed;
    refuse(counts_.self_test_failed);
    return;
  }
  if (frozen) {
    ails_ = DeviceFault::kFrozen;
    refuse(counts_.frozen);
    return;
  }
  judge(frame, *packet, arrived_ - on_the_line(frame) - options_.latency);
}

void Nav440::judge(const Nav440Frame& frame, const HeadingPacket& packet, Time arrived) noexcept {
  const Plausibility::Judged judged = plausibility_.judge(packet, arrived);
  if (judged.verdict != Plausibility::Verdict::kBelieved) {
    ++implausible_in_a_row_;
    // The first ones have nothing to follow from.
    if (judged.verdict == Plausibility::Verdict::kNotYet && implausible_in_a_row_ < kToBeginWith) {
      return;
    }
    implausible_weight_ += kImplausibleWeight;
    if (implausible_in_a_row_ >= kImplausibleInARow) {
      ails_ = DeviceFault::kImplausible;
    }
    refuse(counts_.implausible);
    return;
  }
  implausible_in_a_row_ = 0;
  implausible_weight_ = std::max(implausible_weight_ - 1, 0);
  const bool warns = (packet.bit & (nav440::kMasterStatus | nav440::kErrors)) != 0;
  ails_ = warns ? DeviceFault::kSelfTestWarning : DeviceFault::kNone;
  if (judged.measured <= stamped_) {
    ++counts_.same_stamp;
    return;
  }
  stamped_ = judged.measured;
  fix_maker_.take(frame.type, frame.payload, packet.bit, judged.measured);
  const double declination_rad = packet.magnetic ? options_.declination_rad : 0.0;
  ready_ = Attitude{judged.measured, wrap_to_pi(packet.angles.yaw_rad + declination_rad),
                    packet.rate_rad_s[2]};
}

Duration Nav440::on_the_line(const Nav440Frame& frame) const noexcept {
  if (!options_.line_has_speed) {
    return Duration::zero();
  }
  const auto bytes = static_cast<std::int64_t>(frame.payload.size() + Nav440Framing::kOverhead);
  return Duration{std::chrono::seconds{bytes * Nav440Framing::kBitsOfByte}} / start_up_.baud();
}

Duration Nav440::silence_limit() const noexcept {
  return std::max(kSilence, kPeriodsOfSilence * kSilence / options_.rate_hz);
}

DeviceFault Nav440::fault() const noexcept {
  if (connection_ == 0) {
    if (const DeviceFault fault = stream_.fault(); fault != DeviceFault::kNone) {
      return fault;
    }
  }
  return streaming() ? ails_ : start_up_.fault();
}

Nav440Counts Nav440::counts() const noexcept {
  Nav440Counts counts = counts_;
  counts.framing = framing_.counts();
  counts.streams = start_up_.streams();
  return counts;
}

}  // namespace lodesman
