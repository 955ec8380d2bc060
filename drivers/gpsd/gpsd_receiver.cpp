// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpsd/gpsd_receiver.h"

#include <algorithm>
#include <utility>

namespace lodesman {
namespace {

constexpr std::string_view kWatch = "?WATCH={\"enable\":true,\"json\":true};\n";
constexpr std::string_view kAskDevices = "?DEVICES;\n";

// Some reports of the longest kind.
constexpr std::size_t kMostBytesAPoll = 65536;

constexpr std::int64_t kDay_ns = Duration{std::chrono::hours{24}}.count();

// None where the position is not measured.
[[nodiscard]] std::optional<FixQuality> quality_of(const gpsd::Tpv& tpv) noexcept {
  constexpr int kFlat = 2;
  if (tpv.mode < kFlat) {
    return std::nullopt;
  }
  switch (tpv.status) {
    case 0: return FixQuality::kUnknown;  // an ordinary one, too
    case 2: return FixQuality::kDifferential;
    case 3: return FixQuality::kRtkFixed;
    case 4: return FixQuality::kRtkFloat;
    case 5:
    case 7:
    case 8: return std::nullopt;
    default: return FixQuality::kSingle;
  }
}

}  // namespace

GpsdReceiver::GpsdReceiver(ByteStream& stream, GpsdOptions options)
    : stream_{stream}, options_{std::move(options)} {}

Reading<PositionFix> GpsdReceiver::poll(Time now) noexcept {
  look_at_connection(now);
  if (connection_ == 0) {
    return {
        stream_.fault() == DeviceFault::kNone ? ReadStatus::kNothingNew : ReadStatus::kDisconnected,
        {}};
  }
  if (!outlet_.has_fix()) {
    read_on(now);
    keep_time(now);
    write_on(now);
  }
  return outlet_.take();
}

// Nothing of one connection is used on the next but the time of the last fix.
void GpsdReceiver::look_at_connection(Time now) noexcept {
  const std::uint64_t connection = stream_.connection(now);
  if (connection == connection_) {
    return;
  }
  connection_ = connection;
  chunk_size_ = chunk_at_ = line_size_ = 0;
  line_is_cut_ = false;
  outlet_.restart();
  hdop_.reset();
  path_ = {};
  receiver_ = DeviceFault::kNone;
  heard_ = tpv_heard_ = now;
  asked_ = {};
  saying_ = connection != 0 ? kWatch : std::string_view{};
}

// One that is half on its way is sent to its end.
void GpsdReceiver::say(std::string_view text) noexcept {
  saying_ = saying_.empty() ? text : saying_;
}

void GpsdReceiver::write_on(Time now) noexcept {
  if (saying_.empty()) {
    return;
  }
  std::array<std::uint8_t, 64> bytes{};
  static_assert(kWatch.size() <= bytes.size() && kAskDevices.size() <= bytes.size());
  std::transform(saying_.begin(), saying_.end(), bytes.begin(),
                 [](char letter) { return static_cast<std::uint8_t>(letter); });
  saying_.remove_prefix(stream_.write(std::span{bytes}.first(saying_.size()), now));
}

void GpsdReceiver::keep_time(Time now) noexcept {
  if (now - tpv_heard_ > kSilence) {
    outlet_.ails(receiver_ == DeviceFault::kNone ? DeviceFault::kNoAnswer : receiver_);
  }
  if (asked_ == Time{} && now - heard_ > kSilence) {
    asked_ = now;
    say(kAskDevices);
  } else if (asked_ != Time{} && now - asked_ > kSilence) {
    asked_ = now;
    ++counts_.given_up;
    stream_.reconnect(0);
  }
}

bool GpsdReceiver::refill(Time now) noexcept {
  const Received received =
      stream_.read(std::span{chunk_}.first(std::min(chunk_.size(), left_)), now);
  chunk_size_ = received.count;
  chunk_at_ = 0;
  left_ -= received.count;
  arrived_ = std::min(received.at, now);
  if (received.count > 0) {
    heard_ = now;
    asked_ = {};
  }
  return received.count > 0;
}

void GpsdReceiver::read_on(Time now) noexcept {
  left_ = kMostBytesAPoll;
  while (!outlet_.has_fix() && (chunk_at_ < chunk_size_ || refill(now))) {
    take_byte(static_cast<char>(chunk_[chunk_at_++]), now);
  }
}

void GpsdReceiver::take_byte(char byte, Time now) noexcept {
  if (byte == '\n') {
    const std::string_view line{line_.data(), line_size_};
    if (line_is_cut_) {
      ++counts_.broken;
    } else if (line.find_first_not_of("\r \t") != std::string_view::npos) {
      hear(line, now);
    }
    line_size_ = 0;
    line_is_cut_ = false;
    return;
  }
  if (line_size_ == 0) {
    begun_ = arrived_;
  }
  if (line_size_ == line_.size()) {
    line_is_cut_ = true;
    return;
  }
  line_[line_size_++] = byte;
}

void GpsdReceiver::hear(std::string_view line, Time now) noexcept {
  const gpsd::Report report = gpsd::decoded(line);
  if (std::holds_alternative<gpsd::Broken>(report)) {
    ++counts_.broken;
    outlet_.damaged();
    return;
  }
  ++counts_.reports;
  if (const auto* tpv = std::get_if<gpsd::Tpv>(&report)) {
    take(*tpv, now);
  } else if (const auto* sky = std::get_if<gpsd::Sky>(&report); sky != nullptr && sky->hdop) {
    hdop_ = sky->hdop;
    hdop_heard_ = now;
  } else if (const auto* devices = std::get_if<gpsd::Devices>(&report)) {
    // One that went is listed for as long as gpsd runs.
    receiver_ = !devices->any                       ? DeviceFault::kNoPort
                : receiver_ == DeviceFault::kNoPort ? DeviceFault::kNone
                                                    : receiver_;
  } else if (const auto* device = std::get_if<gpsd::Device>(&report)) {
    receiver_ = device->active ? DeviceFault::kNone : DeviceFault::kUnplugged;
  }
}

bool GpsdReceiver::is_ours(std::string_view device, Time now) noexcept {
  if (!options_.device.empty()) {
    return device == options_.device;
  }
  const std::string_view cut = device.substr(0, path_.size() - 1);
  if (std::string_view{path_.data()} == cut) {
    return true;
  }
  if (path_[0] != '\0' && now - tpv_heard_ <= kSilence) {
    return false;
  }
  path_ = {};
  std::copy(cut.begin(), cut.end(), path_.begin());
  return true;
}

void GpsdReceiver::take(const gpsd::Tpv& tpv, Time now) noexcept {
  if (!is_ours(tpv.device, now)) {
    ++counts_.of_others;
    return;
  }
  tpv_heard_ = now;
  if (!quality_of(tpv)) {
    ++counts_.voids;
    outlet_.ails(DeviceFault::kNoFix);
  } else if (!tpv.utc_ns || !tpv.latitude_deg || !tpv.longitude_deg) {
    ++counts_.without_time;
  } else if (is_nowhere(*tpv.latitude_deg, *tpv.longitude_deg)) {
    outlet_.refuse(counts_.nowhere, DeviceFault::kImplausible);
  } else {
    hdop_ = now - hdop_heard_ > kSkyLasts ? std::nullopt : hdop_;
    give(tpv);
  }
}

void GpsdReceiver::give(const gpsd::Tpv& tpv) noexcept {
  const FixStamp::Judged judged =
      stamp_.judge(Duration{*tpv.utc_ns % kDay_ns}, begun_ - options_.latency);
  if (judged.verdict != FixStamp::Verdict::kNew) {
    ++counts_.repeated;
    return;
  }
  PositionFix fix;
  fix.measured = judged.measured;
  fix.latitude_deg = *tpv.latitude_deg;
  fix.longitude_deg = *tpv.longitude_deg;
  fix.quality = quality_of(tpv).value_or(FixQuality::kUnknown);
  fix.sigma_m = fix_sigma_m(fix.quality, hdop_);
  fix.source = FixSource::kGpsd;
  fix.has_speed = tpv.speed_m_s.has_value();
  fix.speed_m_s = tpv.speed_m_s.value_or(0.0);
  fix.has_course = tpv.course_rad.has_value();
  fix.course_rad = tpv.course_rad.value_or(0.0);
  outlet_.offer(fix, tpv.utc_ns);
}

DeviceFault GpsdReceiver::fault() const noexcept {
  if (connection_ == 0) {
    if (const DeviceFault fault = stream_.fault(); fault != DeviceFault::kNone) {
      return fault;
    }
  }
  return outlet_.fault();
}

GpsdCounts GpsdReceiver::counts() const noexcept {
  GpsdCounts counts = counts_;
  counts.given = outlet_.counts();
  return counts;
}

}  // namespace lodesman
