// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/delta_t_record.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace lodesman::emulated {
namespace {

constexpr std::uint16_t kValid = 0x8000;

class Bytes256 {
 public:
  void u8(std::size_t at, unsigned value) noexcept {
    bytes_[at] = static_cast<std::uint8_t>(value & 0xFFU);
  }
  void u16(std::size_t at, unsigned value) noexcept {
    u8(at, value >> 8U);
    u8(at + 1, value);
  }
  void u32(std::size_t at, std::uint32_t value) noexcept {
    u16(at, value >> 16U);
    u16(at + 2, value & 0xFFFFU);
  }
  void f32(std::size_t at, double value, bool high_byte_first) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (std::size_t i = 0; i < 4; ++i) {
      u8(at + (high_byte_first ? i : 3 - i), bits >> (8U * (3 - static_cast<unsigned>(i))));
    }
  }
  void text(std::size_t at, std::string_view value) noexcept {
    std::copy(value.begin(), value.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  [[nodiscard]] const std::array<std::uint8_t, kDeltaTHeaderSize>& bytes() const noexcept {
    return bytes_;
  }

 private:
  std::array<std::uint8_t, kDeltaTHeaderSize> bytes_{};
};

[[nodiscard]] unsigned rounded(double value, double most) noexcept {
  return static_cast<unsigned>(std::lround(std::clamp(value, 0.0, most)));
}

template <class... Values>
[[nodiscard]] std::string printed(const char* format, Values... values) {
  std::array<char, 64> text{};
  const int size = std::snprintf(text.data(), text.size(), format, values...);
  return {text.data(), static_cast<std::size_t>(std::clamp(size, 0, 63))};
}

[[nodiscard]] double circle_deg(double deg) noexcept {
  const double within = std::fmod(deg, 360.0);
  return within < 0.0 ? within + 360.0 : within;
}

[[nodiscard]] unsigned tilted(const MaybeDegrees& angle) noexcept {
  return rounded(angle.deg * 10.0 + 900.0, 1800.0) | (angle.is_valid ? kValid : 0U);
}

void put_time(Bytes256& out, const CivilTime& time) {
  static constexpr std::array<std::string_view, 12> kMonths{
      "JAN", "FEB", "MAR", "APR", "MAY", "JUN", "JUL", "AUG", "SEP", "OCT", "NOV", "DEC"};
  const std::string month{kMonths[static_cast<std::size_t>(time.month - 1)]};
  out.text(8, printed("%02d-%s-%04d", time.day, month.c_str(), time.year));
  out.text(20, printed("%02d:%02d:%02d", time.hour, time.minute, time.second));
  out.text(29, printed(".%02d", time.millisecond / 10));
  out.text(112, printed(".%03d", time.millisecond));
}

void put_navigation(Bytes256& out, const DeltaTHeader& header) {
  if (header.has_position) {
    out.text(33, delta_t_latitude(header.latitude_deg));
    out.text(47, delta_t_longitude(header.longitude_deg));
  }
  out.u8(61, rounded(header.speed_kn * 10.0, 255.0));
  out.u16(62, rounded(header.course_deg * 10.0, 3600.0));
  out.u16(64, tilted(header.pitch));
  out.u16(66, tilted(header.roll));
  out.u16(68, rounded(circle_deg(header.heading.deg) * 10.0, 3600.0) |
                  (header.heading.is_valid ? kValid : 0U));
}

void put_geometry(Bytes256& out, const DeltaTHeader& header) {
  out.u16(70, header.beams);
  out.u16(72, header.samples);
  out.u16(74, header.sector_deg);
  out.u16(76, rounded((header.start_deg + 180.0) * 100.0, 65535.0));
  out.u8(78, rounded(header.increment_deg * 100.0, 255.0));
  out.u16(79, header.range_m);
  out.u16(81, header.frequency_khz);
  out.u16(83, rounded(header.sound_speed_m_s * 10.0, 32767.0) |
                  (header.sound_speed_is_valid ? kValid : 0U));
  out.u16(85, header.resolution_mm);
  out.u16(87, header.pulse_us);
  out.u16(89, static_cast<unsigned>(header.tilt_deg + 180));
  out.u16(91, header.repetition_ms);
  out.u32(93, header.ping);
}

void put_rest(Bytes256& out, const DeltaTHeader& header) {
  for (std::size_t i = 0; i < header.offset_m.size(); ++i) {
    out.f32(100 + 4 * i, static_cast<double>(header.offset_m[i]), true);
  }
  out.u8(117, header.has_intensity ? 1 : 0);
  out.u16(118, header.ping_latency_100us);
  out.u16(120, header.data_latency_100us);
  out.u8(122, header.fine_ranges ? 1 : 0);
  out.u8(123, header.flags);
  out.u8(125, header.averaged);
  out.u16(126, header.centre_ping_100us);
  if (header.external != ExternalAttitude::kNone) {
    const bool high_first = header.external == ExternalAttitude::kHighByteFirst;
    out.u8(137, 0b0111);  // heading, roll, pitch
    out.f32(138, header.pitch.deg, high_first);
    out.f32(142, header.roll.deg, high_first);
    out.f32(146, circle_deg(header.heading.deg), high_first);
  }
}

struct DegreesMinutes {
  int degrees = 0;
  int minutes = 0;
  int hundred_thousandths = 0;  // of a minute
};

[[nodiscard]] DegreesMinutes split(double deg) noexcept {
  constexpr std::int64_t kAMinute = 100'000;
  const std::int64_t count = std::llround(std::abs(deg) * 60.0 * static_cast<double>(kAMinute));
  return {static_cast<int>(count / (60 * kAMinute)), static_cast<int>(count / kAMinute % 60),
          static_cast<int>(count % kAMinute)};
}

}  // namespace

std::string delta_t_latitude(double deg) {
  const DegreesMinutes at = split(deg);
  return printed(" %02d.%02d.%05d %c", at.degrees, at.minutes, at.hundred_thousandths,
                 deg < 0.0 ? 'S' : 'N');
}

std::string delta_t_longitude(double deg) {
  const DegreesMinutes at = split(deg);
  return printed("%03d.%02d.%05d %c", at.degrees, at.minutes, at.hundred_thousandths,
                 deg < 0.0 ? 'W' : 'E');
}

std::array<std::uint8_t, kDeltaTHeaderSize> delta_t_header(const DeltaTHeader& header,
                                                           std::size_t total) {
  Bytes256 out;
  const bool is_image = header.record == DeltaTRecord::k83B;
  if (header.whole_image_header || !is_image) {
    put_rest(out, header);
  }
  put_time(out, header.time);
  if (is_image && !header.whole_image_header) {
    out.u32(112, 0);
  }
  out.text(0, is_image ? "83B" : "83P");
  out.u8(3, header.version);
  if (is_image) {  // the only reading that holds more than 64 KiB
    out.u8(4, static_cast<unsigned>(total >> 16U));
    out.u16(5, static_cast<unsigned>(total & 0xFFFFU));
  } else {
    out.u16(4, static_cast<unsigned>(total));
  }
  put_navigation(out, header);
  put_geometry(out, header);
  return out.bytes();
}

std::vector<std::uint8_t> profile_record(const DeltaTHeader& header,
                                         std::span<const std::uint16_t> ranges,
                                         std::span<const std::uint16_t> intensities) {
  const std::size_t total = kDeltaTHeaderSize + 2 * (ranges.size() + intensities.size());
  const auto head = delta_t_header(header, total);
  std::vector<std::uint8_t> record{head.begin(), head.end()};
  record.reserve(total);
  for (const auto values : {ranges, intensities}) {
    for (const std::uint16_t value : values) {
      record.push_back(static_cast<std::uint8_t>(value >> 8U));
      record.push_back(static_cast<std::uint8_t>(value & 0xFFU));
    }
  }
  return record;
}

std::vector<std::uint8_t> image_record(const DeltaTHeader& header,
                                       std::span<const std::uint8_t> image) {
  const auto head = delta_t_header(header, kDeltaTHeaderSize + image.size());
  std::vector<std::uint8_t> record(head.size() + image.size());
  std::copy(image.begin(), image.end(), std::copy(head.begin(), head.end(), record.begin()));
  return record;
}

}  // namespace lodesman::emulated
