// SPDX-License-Identifier: Apache-2.0
// The two records that the maker's program for the Delta T sends and files: 83P, a range a beam,
// and 83B, the image; 256 bytes of header and a body each. Pure and total: any bytes may be given.
// Integers are big-endian; what the header leaves open is empty here. Angles are clockwise from
// straight ahead as the header has them, before the beam sign of the mounting.
//
// Sources: the maker's note on the 83P datagram and the drivers that agree with it; of 83B, whose
// header is documented up to byte 96 alone, one driver (docs/wire/delta_t.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "drivers/delta_t/bytes.h"
#include "mid_level/base/time.h"

namespace lodesman::delta_t {

inline constexpr std::size_t kHeaderBytes = 256;
// That ranges in a record are reckoned by.
inline constexpr double kNominalSoundSpeed_m_s = 1500.0;

enum class RecordKind : std::uint8_t { kImage, kProfile };  // 83B, 83P

// Up to the first zero.
template <std::size_t kSize>
[[nodiscard]] constexpr std::string_view text_of(const Text<kSize>& text) noexcept {
  const std::string_view whole{text.data(), text.size()};
  return whole.substr(0, whole.find('\0'));
}

struct Header {
  RecordKind kind = RecordKind::kImage;
  std::uint8_t version = 0;       // [-] 10 is 1.10
  std::uint32_t total_bytes = 0;  // [-] header and body
  Text<12> date{};                // DD-MMM-YYYY
  Text<9> time{};                 // HH:MM:SS
  Text<4> hundredths{};           // .hh
  Text<14> latitude{};            // dd.mm.mmmmm N, degrees and minutes
  Text<14> longitude{};           // ddd.mm.mmmmm E
  double speed_m_s = 0.0;
  double course_rad = 0.0;
  std::optional<double> pitch_rad, roll_rad, heading_rad;
  std::uint32_t beams = 0;            // [-]
  std::uint32_t samples = 0;          // [-] of a beam, in an image
  double sector_rad = 0.0;            // [rad] as it names it; the bearings are the next two
  double first_bearing_rad = 0.0;     // [rad] centre of beam 0
  double beam_step_rad = 0.0;         // [rad] > 0
  double range_m = 0.0;               // [m] acoustic range at the nominal sound speed
  double frequency_hz = 0.0;          // [Hz]
  std::optional<double> sound_speed;  // [m/s]
  double resolution_m = 0.0;          // [m] of a profile's ranges at the nominal sound speed
  bool resolution_was_cm = false;     // it was given in centimetres, against the format
  double pulse_s = 0.0;               // [s]
  double tilt_rad = 0.0;
  double repetition_s = 0.0;          // [s] from ping to ping
  std::uint32_t ping_number = 0;      // [-]
  std::array<double, 3> offset_m{};   // [m] of the sonar: x, y, z
  Text<5> milliseconds{};             // .mmm
  bool has_intensities = false;       // of a profile
  Duration ping_latency{};            // [ns]
  Duration data_latency{};            // [ns] 0 where a recording is played back
  std::uint8_t sample_rate_code = 0;  // [-] 0: 500 steps of resolution in the range, 1: 5000
  std::uint8_t flags = 0;             // [-] bit 0 roll-corrected, 1 ray-bent, 2 overlapped
  std::uint8_t pings_averaged = 0;    // [-] 0 and 1: none
  Duration centre_ping_offset{};      // [ns]
  std::optional<double> heave_m;
  std::uint8_t user_byte = 0;
  std::optional<double> altitude_m;
  std::uint8_t external_flags = 0;  // [-] bit 0 heading, 1 roll, 2 pitch, 3 heave
  std::optional<double> external_pitch_rad, external_roll_rad, external_heading_rad;
  bool auto_scan = false;
  std::optional<double> scan_angle_rad;

  [[nodiscard]] double sound_speed_m_s() const noexcept {
    return sound_speed.value_or(kNominalSoundSpeed_m_s);
  }
  // From a length at the nominal sound speed to the real one.
  [[nodiscard]] double stretch() const noexcept {
    return sound_speed_m_s() / kNominalSoundSpeed_m_s;
  }
  // How long before it came the ping was sent; the data may not have been early.
  [[nodiscard]] Duration age_at_arrival() const noexcept { return data_latency - ping_latency; }
  // Whether its beams lie as its sector says: centred, and side by side over all of it.
  [[nodiscard]] bool fills_its_sector() const noexcept;
};

// Degrees north or east, of the texts above; empty where they say nothing.
[[nodiscard]] std::optional<double> degrees_in(std::string_view text) noexcept;
// Since 1970, in the clock of the computer that wrote it; empty where the texts are no time.
[[nodiscard]] std::optional<Duration> written_at(const Header& header) noexcept;

// Why bytes are no record.
enum class Refusal : std::uint8_t {
  kNone,
  kUnknownTag,   // neither 83B nor 83P: something else that may come on the same socket
  kWrongLength,  // shorter than a header, or not as long as its own counts say
  kGeometry,     // no beams or bins, more than a ping has, or bearings that cannot be
  kRange,        // none, or longer than the head has; or a resolution that does not belong to it
  kSoundSpeed,   // of no water
};

struct Record {
  Header header;
  // Image: a byte a sample, beam by beam. Profile: a word a beam, then, where it has them, the
  // intensities.
  Bytes body;

  [[nodiscard]] std::uint8_t sample(std::uint32_t beam, std::uint32_t bin) const noexcept {
    return body[std::size_t{beam} * header.samples + bin];
  }
  // [m] true range by the sound speed; 0: no return, or one from beyond the acoustic range.
  [[nodiscard]] double range_m(std::uint32_t beam) const noexcept;
  // [-] as the device counts; 0 where it gives none.
  [[nodiscard]] std::uint16_t intensity(std::uint32_t beam) const noexcept;
};

struct Parsed {
  Refusal refusal = Refusal::kUnknownTag;
  Record record;  // where it is not refused; its body lies in the bytes that were given
};

// All of the bytes as one record.
[[nodiscard]] Parsed parse_record(Bytes bytes) noexcept;

// [-] bytes of the record that begins here, by its own word: at least a header's. 0: none does.
[[nodiscard]] std::size_t record_length(Bytes bytes) noexcept;

}  // namespace lodesman::delta_t
