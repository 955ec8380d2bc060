// SPDX-License-Identifier: Apache-2.0
// The records that the program beside an Imagenex Delta T sends: 83P, a range a beam, and 83B, the
// image. A header of 256 bytes and the data, all numbers high byte first. From the maker's 83P note
// and his sample program's text; of 83B only the first 97 bytes are documented. Pure functions; any
// thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hal_sim/emulators/utc.h"

namespace lodesman::emulated {

// A value of a sensor that may not be there: then it stays where it is and is not marked as valid.
struct MaybeDegrees {
  double deg = 0.0;
  bool is_valid = false;
};

enum class DeltaTRecord : std::uint8_t { k83P, k83B };

// Attitude from a sensor outside of the head: in what order its numbers come differs by version.
enum class ExternalAttitude : std::uint8_t { kNone, kLowByteFirst, kHighByteFirst };

struct DeltaTHeader {
  DeltaTRecord record = DeltaTRecord::k83P;
  std::uint8_t version = 10;  // 1.10
  CivilTime time;             // of the ping
  bool has_position = false;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double speed_kn = 0.0;
  double course_deg = 0.0;
  MaybeDegrees pitch;
  MaybeDegrees roll;
  MaybeDegrees heading;
  std::uint16_t beams = 120;
  std::uint16_t samples = 500;  // a beam
  std::uint16_t sector_deg = 120;
  double start_deg = -59.5;    // of the centre of beam 0
  double increment_deg = 1.0;  // from beam to beam
  std::uint16_t range_m = 30;
  std::uint16_t frequency_khz = 260;
  double sound_speed_m_s = 1500.0;
  bool sound_speed_is_valid = true;
  std::uint16_t resolution_mm = 60;
  std::uint16_t pulse_us = 0;
  int tilt_deg = 0;
  std::uint16_t repetition_ms = 100;
  std::uint32_t ping = 1;
  // From here on of 83P alone, as far as documents go.
  std::array<float, 3> offset_m{};
  bool has_intensity = false;
  std::uint16_t ping_latency_100us = 0;
  std::uint16_t data_latency_100us = 0;
  bool fine_ranges = false;  // a tenth of the range bins of the image
  std::uint8_t flags = 0;
  std::uint8_t averaged = 0;
  std::uint16_t centre_ping_100us = 0;
  ExternalAttitude external = ExternalAttitude::kNone;  // told of pitch, roll, heading as above
  // False: the undocumented part of an 83B header is 0.
  bool whole_image_header = true;
};

inline constexpr std::size_t kDeltaTHeaderSize = 256;

// The header of a record that has `total` bytes.
[[nodiscard]] std::array<std::uint8_t, kDeltaTHeaderSize> delta_t_header(const DeltaTHeader& header,
                                                                         std::size_t total);

// ranges: one a beam, in multiples of the resolution, 0: no return. intensities: as many, or none.
[[nodiscard]] std::vector<std::uint8_t> profile_record(const DeltaTHeader& header,
                                                       std::span<const std::uint16_t> ranges,
                                                       std::span<const std::uint16_t> intensities);
// image: beam after beam, the leftmost first.
[[nodiscard]] std::vector<std::uint8_t> image_record(const DeltaTHeader& header,
                                                     std::span<const std::uint8_t> image);

// " 35.01.63200 N": degrees, minutes and their fraction.
[[nodiscard]] std::string delta_t_latitude(double deg);
// "138.54.00000 E"
[[nodiscard]] std::string delta_t_longitude(double deg);

}  // namespace lodesman::emulated
