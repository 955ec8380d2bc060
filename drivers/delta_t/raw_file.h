// SPDX-License-Identifier: Apache-2.0
// A record of a .837 file: what a head said in one ping, as the maker's player reads it. For
// `lodesman decode` alone, as head.h. Pure; any thread.
//
// Sources: two independent readers; what stands behind the echoes, one.
#pragma once

#include <optional>

#include "drivers/delta_t/record.h"

namespace lodesman::delta_t {

struct RawFileRecord {
  std::size_t length = 0;  // [-] 8192 or 16384 bytes
  int data_points = 0;     // [-] 8000 or 16000
  Text<12> date{};         // as in a record's header
  Text<9> time{};
  Text<4> hundredths{};
  Text<5> milliseconds{};
  Text<14> latitude{};
  Text<14> longitude{};
  std::uint8_t display_mode = 0;  // [-] bit 6 transducer up, the low ones the mode
  int gain_db = 0;                // [dB]
  std::optional<double> tilt_rad;
  std::uint8_t pings_averaged = 0;
  double pulse_s = 0.0;  // [s]
  std::uint8_t user_byte = 0;
  double sound_speed_m_s = kNominalSoundSpeed_m_s;
  double speed_m_s = 0.0;
  double course_rad = 0.0;
  double frequency_hz = 0.0;  // [Hz]
  std::optional<double> pitch_rad, roll_rad, heading_rad;
  double repetition_s = 0.0;  // [s]
  std::uint8_t display_gain_percent = 0;
  int range_m = 0;  // [m] of the head's own header, of which the first bytes follow
  std::uint8_t status = 0;
  std::uint8_t packet = 0;
  Bytes echoes;  // 8000 or 16000, of elements, not of beams
};

// The record that begins here; nothing where none does, or it is not whole. The number of data
// bytes in it differs from writer to writer and says nothing.
[[nodiscard]] std::optional<RawFileRecord> raw_file_record_in(Bytes bytes) noexcept;

}  // namespace lodesman::delta_t
