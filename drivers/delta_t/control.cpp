// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/control.h"

#include <algorithm>
#include <cmath>

#include "mid_level/base/heading.h"

namespace lodesman::delta_t {
namespace {

constexpr std::uint8_t kFirstRangeCode = 2;
constexpr std::uint8_t kWideBeams = 0;    // 3 degrees
constexpr std::uint8_t kProfileMode = 3;  // without which there are no profile points
constexpr std::uint8_t kPlus180Low = 180;

template <std::size_t kSize>
[[nodiscard]] std::uint8_t code_of(const std::array<int, kSize>& values, int value) noexcept {
  const auto found = std::find(values.begin(), values.end(), value);
  return static_cast<std::uint8_t>((found == values.end() ? values.end() - 1 : found) -
                                   values.begin());
}

[[nodiscard]] std::uint8_t byte_of(int value) noexcept { return static_cast<std::uint8_t>(value); }

}  // namespace

std::array<std::uint8_t, kControlBytes> control_frame(const Control& control) noexcept {
  std::array<std::uint8_t, kControlBytes> frame{};
  frame[0] = 'E';
  frame[1] = 'C';
  frame[3] = 1;  // settings come from outside
  frame[7] = static_cast<std::uint8_t>(code_of(kRanges_m, control.range_m) + kFirstRangeCode);
  frame[8] = byte_of(control.gain_db);
  frame[9] = byte_of(control.display_gain_percent);
  frame[11] = code_of(kSectors_deg, control.sector_deg);
  frame[12] = kWideBeams;
  frame[13] = code_of(kBeams, control.beams);
  const auto speed = static_cast<unsigned>(std::lround(control.sound_speed_m_s * 10.0));
  frame[17] = static_cast<std::uint8_t>(speed >> 8U);
  frame[18] = static_cast<std::uint8_t>(speed & 0xFFU);
  frame[19] = kProfileMode;
  frame[20] = control.output == RecordKind::kImage ? 1 : 0;
  frame[21] = 1;  // profile points
  frame[22] = byte_of(control.least_range_m);
  frame[23] = byte_of(control.least_level_percent);
  frame[24] = control.transducer_up ? 1 : 0;
  frame[25] = kPlus180Low;
  return frame;
}

std::optional<Control> control_in(Bytes bytes) noexcept {
  if (bytes.size() < kControlBytes || bytes[0] != 'E' || bytes[1] != 'C' || bytes[2] != 0 ||
      bytes[3] > 1) {
    return std::nullopt;
  }
  const std::size_t range_code = bytes[7];
  if (range_code < kFirstRangeCode || range_code - kFirstRangeCode >= kRanges_m.size() ||
      bytes[11] >= kSectors_deg.size() || bytes[13] >= kBeams.size() || bytes[20] > 1) {
    return std::nullopt;
  }
  Control control;
  control.output = bytes[20] == 1 ? RecordKind::kImage : RecordKind::kProfile;
  control.range_m = kRanges_m[range_code - kFirstRangeCode];
  control.gain_db = bytes[8];
  control.display_gain_percent = bytes[9];
  control.sector_deg = kSectors_deg[bytes[11]];
  control.beams = kBeams[bytes[13]];
  control.sound_speed_m_s = word_at(bytes, 17) / 10.0;
  control.least_range_m = bytes[22];
  control.least_level_percent = bytes[23];
  control.transducer_up = bytes[24] == 1;
  return control;
}

bool echoes(const Header& header, const Control& control) noexcept {
  constexpr double kHalfADegree_rad = 0.0087;
  constexpr double kHalfATenth_m_s = 0.05;
  const bool same_speed =
      !header.sound_speed ||
      std::abs(*header.sound_speed - control.sound_speed_m_s) <= kHalfATenth_m_s;
  return header.kind == control.output && std::abs(header.range_m - control.range_m) < 0.5 &&
         header.beams == static_cast<std::uint32_t>(control.beams) &&
         std::abs(header.sector_rad - to_rad(control.sector_deg)) < kHalfADegree_rad &&
         same_speed && header.pings_averaged <= 1;
}

}  // namespace lodesman::delta_t
