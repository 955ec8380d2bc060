// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/raw_file.h"

#include "drivers/delta_t/head.h"
#include "mid_level/base/heading.h"

namespace lodesman::delta_t {
namespace {

constexpr std::size_t kEchoesAt = 112;

// [-] echoes of the record that begins here; 0: none does.
[[nodiscard]] std::size_t echoes_of(Bytes bytes) noexcept {
  if (bytes.size() < kEchoesAt || bytes[0] != '8' || bytes[1] != '3' || bytes[2] != '7') {
    return 0;
  }
  const bool is_long = bytes[3] == 11;
  const std::size_t echoes = is_long ? 16000 : 8000;
  const std::size_t length = is_long ? 16384 : 8192;
  const bool is_right = (is_long || bytes[3] == 10) && word_at(bytes, 4) == length &&
                        word_at(bytes, 6) == echoes + 13 && bytes.size() >= length &&
                        bytes[kEchoesAt + echoes] == kReplyEnd;
  return is_right ? echoes : 0;
}

}  // namespace

std::optional<RawFileRecord> raw_file_record_in(Bytes bytes) noexcept {
  const std::size_t echoes = echoes_of(bytes);
  if (echoes == 0) {
    return std::nullopt;
  }
  RawFileRecord r;
  r.length = word_at(bytes, 4);
  r.data_points = static_cast<int>(echoes);
  r.date = text_at<sizeof(r.date)>(bytes, 8);
  r.time = text_at<sizeof(r.time)>(bytes, 20);
  r.hundredths = text_at<sizeof(r.hundredths)>(bytes, 29);
  r.milliseconds = text_at<sizeof(r.milliseconds)>(bytes, 93);
  r.latitude = text_at<sizeof(r.latitude)>(bytes, 48);
  r.longitude = text_at<sizeof(r.longitude)>(bytes, 62);
  r.display_mode = bytes[37];
  r.gain_db = bytes[38];
  r.tilt_rad = valid_angle_rad(bytes, 39, 180.0);
  r.pings_averaged = bytes[43];
  r.pulse_s = bytes[44] * 10e-6;
  r.user_byte = bytes[45];
  r.sound_speed_m_s = valid_tenths(bytes, 46).value_or(kNominalSoundSpeed_m_s);
  r.speed_m_s = bytes[76] / 10.0 * kKnot_m_s;
  r.course_rad = to_rad(word_at(bytes, 77) / 10.0);
  r.frequency_hz = word_at(bytes, 80) * 1000.0;
  r.pitch_rad = valid_angle_rad(bytes, 82, 90.0);
  r.roll_rad = valid_angle_rad(bytes, 84, 90.0);
  r.heading_rad = valid_angle_rad(bytes, 86, 0.0);
  r.repetition_s = word_at(bytes, 88) / 1000.0;
  r.display_gain_percent = bytes[90];
  r.status = bytes[104];
  r.packet = bytes[105];
  r.range_m = head_range_m(bytes[107]);
  r.echoes = bytes.subspan(kEchoesAt, echoes);
  return r;
}

}  // namespace lodesman::delta_t
