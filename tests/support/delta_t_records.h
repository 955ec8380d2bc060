// SPDX-License-Identifier: Apache-2.0
// Records of a Delta T as bytes, from what their headers mean: the way back of
// drivers/delta_t/record.h, so that what is decoded can be compared to the byte, and pings and
// files made. One thread.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/delta_t/record.h"
#include "mid_level/base/heading.h"

namespace lodesman::testing {

using ByteList = std::vector<std::uint8_t>;

class RecordWriter {
 public:
  explicit RecordWriter(std::size_t size) : bytes_(size) {}

  void byte(std::size_t at, std::int64_t value) {
    bytes_.at(at) = static_cast<std::uint8_t>(value & 0xFF);
  }
  void number(std::size_t at, std::size_t width, double value) {
    const std::int64_t whole = std::llround(value);
    for (std::size_t i = 0; i < width; ++i) {
      byte(at + i, whole >> (8 * (width - 1 - i)));
    }
  }
  void real(std::size_t at, double value) {
    number(at, 4, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  }
  template <std::size_t N>
  void text(std::size_t at, const delta_t::Text<N>& text) {
    for (std::size_t i = 0; i < N; ++i) {
      byte(at + i, text[i]);
    }
  }
  // Absent: without the bit that says it is valid, and a value that must not be believed.
  void tenths(std::size_t at, const std::optional<double>& value, double zero, double absent) {
    number(at, 2, value ? 0x8000 + std::round((*value + zero) * 10.0) : absent);
  }
  [[nodiscard]] ByteList take() { return std::move(bytes_); }

 private:
  ByteList bytes_;
};

[[nodiscard]] inline std::optional<double> degrees(const std::optional<double>& rad) {
  return rad ? std::optional{to_deg(*rad)} : std::nullopt;
}

inline void write_common(const delta_t::Header& h, RecordWriter& out) {
  const bool is_image = h.kind == delta_t::RecordKind::kImage;
  out.byte(0, '8');
  out.byte(1, '3');
  out.byte(2, is_image ? 'B' : 'P');
  out.byte(3, h.version);
  out.number(4, is_image ? 3 : 2, h.total_bytes);
  out.text(8, h.date);
  out.text(20, h.time);
  out.text(29, h.hundredths);
  out.text(33, h.latitude);
  out.text(47, h.longitude);
  out.number(61, 1, h.speed_m_s * 3600.0 / 1852.0 * 10.0);
  out.number(62, 2, to_deg(h.course_rad) * 10.0);
  out.tenths(64, degrees(h.pitch_rad), 90.0, 0x0384);
  out.tenths(66, degrees(h.roll_rad), 90.0, 0x0384);
  out.tenths(68, degrees(h.heading_rad), 0.0, 0.0);
  out.number(70, 2, h.beams);
  out.number(72, 2, h.samples);
  out.number(74, 2, to_deg(h.sector_rad));
  out.number(76, 2, (to_deg(h.first_bearing_rad) + 180.0) * 100.0);
  out.number(78, 1, to_deg(h.beam_step_rad) * 100.0);
  out.number(79, 2, h.range_m);
  out.number(81, 2, h.frequency_hz / 1000.0);
  out.tenths(83, h.sound_speed, 0.0, 0x3A98);
  out.number(85, 2, h.resolution_m * 1000.0);
  out.number(87, 2, h.pulse_s * 1e6);
  out.number(89, 2, to_deg(h.tilt_rad) + 180.0);
  out.number(91, 2, h.repetition_s * 1000.0);
  out.number(93, 4, h.ping_number);
}

inline void write_extended(const delta_t::Header& h, RecordWriter& out) {
  const auto latency = [](Duration time) { return to_seconds(time) * 1e4; };
  for (std::size_t i = 0; i < 3; ++i) {
    out.real(100 + 4 * i, h.offset_m[i]);
  }
  out.text(112, h.milliseconds);
  out.byte(117, h.has_intensities ? 1 : 0);
  out.number(118, 2, latency(h.ping_latency));
  out.number(120, 2, latency(h.data_latency));
  out.byte(122, h.sample_rate_code);
  out.byte(123, h.flags);
  out.byte(125, h.pings_averaged);
  out.number(126, 2, latency(h.centre_ping_offset));
  out.real(128, h.heave_m.value_or(0.0));
  out.byte(132, h.user_byte);
  out.real(133, h.altitude_m.value_or(0.0));
  out.byte(137, h.external_flags);
  out.real(138, degrees(h.external_pitch_rad).value_or(0.0));
  out.real(142, degrees(h.external_roll_rad).value_or(0.0));
  out.real(146, degrees(h.external_heading_rad).value_or(0.0));
  out.byte(150, h.auto_scan ? 1 : 0);
  out.real(151, degrees(h.scan_angle_rad).value_or(0.0));
}

[[nodiscard]] inline ByteList record_bytes(const delta_t::Header& header,
                                           std::span<const std::uint8_t> body) {
  RecordWriter out{delta_t::kHeaderBytes};
  write_common(header, out);
  write_extended(header, out);
  ByteList bytes = out.take();
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

template <std::size_t N>
void set_text(delta_t::Text<N>& text, std::string_view value) {
  text = {};
  std::copy_n(value.begin(), std::min(value.size(), N), text.begin());
}

// What the maker's program would say of a head of 120 beams over 120 degrees, 30 m.
[[nodiscard]] inline delta_t::Header usual_header(delta_t::RecordKind kind,
                                                  std::uint32_t ping_number) {
  delta_t::Header h;
  h.kind = kind;
  h.version = 10;
  set_text(h.date, "21-NOV-2026");
  set_text(h.time, "12:35:00");
  set_text(h.hundredths, ".25");
  set_text(h.milliseconds, ".253");
  h.beams = 120;
  h.samples = 500;
  h.sector_rad = to_rad(120.0);
  h.first_bearing_rad = to_rad(-59.5);
  h.beam_step_rad = to_rad(1.0);
  h.range_m = 30.0;
  h.frequency_hz = 260e3;
  h.sound_speed = 1500.0;
  h.resolution_m = 0.06;
  h.repetition_s = 0.1;
  h.ping_number = ping_number;
  return h;
}

// `echo(beam, bin)`.
template <class Echo>
[[nodiscard]] ByteList image_record(delta_t::Header header, Echo echo) {
  ByteList body;
  body.reserve(std::size_t{header.beams} * header.samples);
  for (std::uint32_t beam = 0; beam < header.beams; ++beam) {
    for (std::uint32_t bin = 0; bin < header.samples; ++bin) {
      body.push_back(echo(beam, bin));
    }
  }
  header.total_bytes = static_cast<std::uint32_t>(delta_t::kHeaderBytes + body.size());
  return record_bytes(header, body);
}

// `steps(beam)`: of the resolution, 0 without a return.
template <class Steps, class Intensity>
[[nodiscard]] ByteList profile_record(delta_t::Header header, Steps steps, Intensity intensity) {
  ByteList body;
  const auto append = [&](unsigned word) {
    body.push_back(static_cast<std::uint8_t>(word >> 8U));
    body.push_back(static_cast<std::uint8_t>(word & 0xFFU));
  };
  for (std::uint32_t beam = 0; beam < header.beams; ++beam) {
    append(steps(beam));
  }
  for (std::uint32_t beam = 0; header.has_intensities && beam < header.beams; ++beam) {
    append(intensity(beam));
  }
  header.total_bytes = static_cast<std::uint32_t>(delta_t::kHeaderBytes + body.size());
  return record_bytes(header, body);
}

// An image that is dark but for bin 100 of beam 30, and the same as a profile.
[[nodiscard]] inline ByteList usual_image(const delta_t::Header& header) {
  return image_record(header, [](std::uint32_t beam, std::uint32_t bin) {
    return static_cast<std::uint8_t>(beam == 30 && bin == 100 ? 200 : 0);
  });
}
[[nodiscard]] inline ByteList usual_profile(const delta_t::Header& header) {
  return profile_record(
      header, [](std::uint32_t beam) { return beam == 30 ? 100U : 0U; },
      [](std::uint32_t beam) { return beam == 30 ? 200U : 0U; });
}

}  // namespace lodesman::testing
