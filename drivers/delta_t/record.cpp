// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/record.h"

#include <cmath>

#include "mid_level/base/heading.h"
#include "mid_level/messages/sonar.h"

namespace lodesman::delta_t {
namespace {

constexpr Duration kLatencyUnit = std::chrono::microseconds{100};
constexpr int kMostRange_m = 300;
// Water between ice and boiling, fresh or salt, down to any depth.
constexpr double kLeastSoundSpeed_m_s = 1300.0;
constexpr double kMostSoundSpeed_m_s = 1700.0;
// By which the resolution times its steps may differ from the range, and a return lie beyond it.
constexpr double kRangeTolerance = 0.02;
constexpr double kMillimetresInCentimetre = 10.0;

[[nodiscard]] Duration latency_at(Bytes bytes, std::size_t at) noexcept {
  return word_at(bytes, at) * kLatencyUnit;
}
[[nodiscard]] std::optional<double> flagged_angle_rad(Bytes bytes, std::size_t at,
                                                      unsigned flag) noexcept {
  if ((bytes[137] & flag) == 0) {
    return std::nullopt;
  }
  const std::optional<double> degrees = doubtful_float_at(bytes, at, 360.0);
  return degrees ? std::optional{to_rad(*degrees)} : std::nullopt;
}

[[nodiscard]] std::optional<RecordKind> kind_of(Bytes bytes) noexcept {
  if (bytes.size() < 3 || bytes[0] != '8' || bytes[1] != '3') {
    return std::nullopt;
  }
  return bytes[2] == 'B'   ? std::optional{RecordKind::kImage}
         : bytes[2] == 'P' ? std::optional{RecordKind::kProfile}
                           : std::nullopt;
}

// Of an image three bytes: two do not hold its largest records.
[[nodiscard]] std::uint32_t total_bytes(RecordKind kind, Bytes bytes) noexcept {
  return kind == RecordKind::kImage ? three_bytes_at(bytes, 4) : word_at(bytes, 4);
}

// Bytes 0 to 96, which both records have.
void read_common(Bytes bytes, Header& h) noexcept {
  h.version = bytes[3];
  h.total_bytes = total_bytes(h.kind, bytes);
  h.date = text_at<12>(bytes, 8);
  h.time = text_at<9>(bytes, 20);
  h.hundredths = text_at<4>(bytes, 29);
  h.latitude = text_at<14>(bytes, 33);
  h.longitude = text_at<14>(bytes, 47);
  h.speed_m_s = bytes[61] / 10.0 * kKnot_m_s;
  h.course_rad = to_rad(word_at(bytes, 62) / 10.0);
  h.pitch_rad = valid_angle_rad(bytes, 64, 90.0);
  h.roll_rad = valid_angle_rad(bytes, 66, 90.0);
  h.heading_rad = valid_angle_rad(bytes, 68, 0.0);
  h.beams = word_at(bytes, 70);
  h.samples = word_at(bytes, 72);
  h.sector_rad = to_rad(word_at(bytes, 74));
  h.first_bearing_rad = to_rad(word_at(bytes, 76) / 100.0 - 180.0);
  h.beam_step_rad = to_rad(bytes[78] / 100.0);
  h.range_m = word_at(bytes, 79);
  h.frequency_hz = word_at(bytes, 81) * 1000.0;
  h.sound_speed = valid_tenths(bytes, 83);
  h.resolution_m = word_at(bytes, 85) / 1000.0;
  h.pulse_s = word_at(bytes, 87) * 1e-6;
  h.tilt_rad = to_rad(word_at(bytes, 89) - 180.0);
  h.repetition_s = word_at(bytes, 91) / 1000.0;
  h.ping_number = long_at(bytes, 93);
}

// The rest, which of an image nothing depends on.
void read_extended(Bytes bytes, Header& h) noexcept {
  for (std::size_t i = 0; i < h.offset_m.size(); ++i) {
    const auto offset_m = static_cast<double>(std::bit_cast<float>(long_at(bytes, 100 + 4 * i)));
    h.offset_m[i] = std::isfinite(offset_m) ? offset_m : 0.0;
  }
  h.milliseconds = text_at<5>(bytes, 112);
  h.has_intensities = h.kind == RecordKind::kProfile && bytes[117] == 1;
  h.ping_latency = latency_at(bytes, 118);
  h.data_latency = latency_at(bytes, 120);
  h.sample_rate_code = bytes[122];
  h.flags = bytes[123];
  h.pings_averaged = bytes[125];
  h.centre_ping_offset = latency_at(bytes, 126);
  constexpr double kMostHeave_m = 100.0;
  constexpr double kMostAltitude_m = 12000.0;
  h.heave_m = doubtful_float_at(bytes, 128, kMostHeave_m);
  h.user_byte = bytes[132];
  h.altitude_m = doubtful_float_at(bytes, 133, kMostAltitude_m);
  h.external_flags = bytes[137];
  h.external_pitch_rad = flagged_angle_rad(bytes, 138, 4U);
  h.external_roll_rad = flagged_angle_rad(bytes, 142, 2U);
  h.external_heading_rad = flagged_angle_rad(bytes, 146, 1U);
  h.auto_scan = bytes[150] != 0;
  const std::optional<double> scan_deg = doubtful_float_at(bytes, 151, 360.0);
  h.scan_angle_rad = scan_deg ? std::optional{to_rad(*scan_deg)} : std::nullopt;
}

[[nodiscard]] std::size_t length_by_counts(const Header& h) noexcept {
  const std::size_t a_beam = h.kind == RecordKind::kImage ? std::size_t{h.samples}
                             : h.has_intensities          ? 4U
                                                          : 2U;
  return kHeaderBytes + h.beams * a_beam;
}

[[nodiscard]] bool has_geometry(const Header& h) noexcept {
  const double last_rad = h.first_bearing_rad + (h.beams - 1.0) * h.beam_step_rad;
  return h.beams >= 1 && h.beams <= kMaxBeams && h.beam_step_rad > 0.0 &&
         (h.kind == RecordKind::kProfile || (h.samples >= 1 && h.samples <= kMaxBins)) &&
         h.beams * h.beam_step_rad <= kHalfTurn_rad && h.first_bearing_rad >= -kHalfTurn_rad &&
         last_rad <= kHalfTurn_rad;
}

// A profile's resolution belongs to its range. In centimetres it is seen, and mended.
[[nodiscard]] bool has_range(Header& h) noexcept {
  if (!(h.range_m >= 1.0 && h.range_m <= kMostRange_m)) {
    return false;
  }
  if (h.kind == RecordKind::kImage) {
    return true;
  }
  if (h.sample_rate_code > 1) {
    return false;
  }
  const double span_m = h.resolution_m * (h.sample_rate_code == 0 ? 500.0 : 5000.0);
  const auto is_range = [&](double length_m) {
    return std::abs(length_m - h.range_m) <= kRangeTolerance * h.range_m;
  };
  if (is_range(span_m)) {
    return true;
  }
  h.resolution_was_cm = is_range(span_m * kMillimetresInCentimetre);
  h.resolution_m *= h.resolution_was_cm ? kMillimetresInCentimetre : 1.0;
  return h.resolution_was_cm;
}

[[nodiscard]] bool has_sound_speed(const Header& h) noexcept {
  return h.sound_speed_m_s() >= kLeastSoundSpeed_m_s && h.sound_speed_m_s() <= kMostSoundSpeed_m_s;
}

}  // namespace

bool Header::fills_its_sector() const noexcept {
  // The start is given in hundredths of a degree, half of one off at the most, as is the step.
  const double tolerance_rad = to_rad(0.011);
  const double centred_rad = 0.5 * (beam_step_rad - sector_rad);
  return std::abs(first_bearing_rad - centred_rad) <= tolerance_rad &&
         std::abs(beams * beam_step_rad - sector_rad) <= 0.5 * beam_step_rad;
}

double Record::range_m(std::uint32_t beam) const noexcept {
  const double nominal_m = word_at(body, std::size_t{2} * beam) * header.resolution_m;
  return nominal_m <= header.range_m * (1.0 + kRangeTolerance) ? nominal_m * header.stretch() : 0.0;
}

std::uint16_t Record::intensity(std::uint32_t beam) const noexcept {
  return header.has_intensities ? word_at(body, std::size_t{2} * (header.beams + beam))
                                : std::uint16_t{0};
}

std::size_t record_length(Bytes bytes) noexcept {
  const std::optional<RecordKind> kind = kind_of(bytes);
  if (!kind || bytes.size() < kHeaderBytes) {
    return 0;
  }
  const std::size_t length = total_bytes(*kind, bytes);
  return length >= kHeaderBytes ? length : 0;
}

Parsed parse_record(Bytes bytes) noexcept {
  const std::optional<RecordKind> kind = kind_of(bytes);
  if (!kind) {
    return {Refusal::kUnknownTag, {}};
  }
  if (bytes.size() < kHeaderBytes) {
    return {Refusal::kWrongLength, {}};
  }
  Parsed parsed;
  Header& header = parsed.record.header;
  header.kind = *kind;
  read_common(bytes, header);
  read_extended(bytes, header);
  parsed.record.body = bytes.subspan(kHeaderBytes);
  parsed.refusal = header.total_bytes != bytes.size() || length_by_counts(header) != bytes.size()
                       ? Refusal::kWrongLength
                   : !has_geometry(header)    ? Refusal::kGeometry
                   : !has_range(header)       ? Refusal::kRange
                   : !has_sound_speed(header) ? Refusal::kSoundSpeed
                                              : Refusal::kNone;
  return parsed;
}

}  // namespace lodesman::delta_t
