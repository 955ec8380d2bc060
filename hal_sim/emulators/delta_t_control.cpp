// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/delta_t_control.h"

#include <array>

namespace lodesman::emulated {
namespace {

constexpr std::size_t kFrameSize = 256;
constexpr std::array<std::uint16_t, 13> kRanges_m{5,  10,  20,  30,  40,  50, 60,
                                                  80, 100, 150, 200, 250, 300};
constexpr unsigned kFirstRangeCode = 2;
constexpr std::array<std::uint16_t, 4> kSectors_deg{30, 60, 90, 120};
constexpr std::array<std::uint16_t, 3> kBeams{480, 240, 120};

// Takes what a code stands for, if it stands for something.
template <std::size_t kCount>
void take(unsigned code, const std::array<std::uint16_t, kCount>& table, std::uint16_t& into) {
  if (code < kCount) {
    into = table[code];
  }
}

void take_within(int value, int least, int most, int& into) noexcept {
  if (value >= least && value <= most) {
    into = value;
  }
}

}  // namespace

bool obey(std::span<const std::uint8_t> datagram, DeltaTSettings& settings) noexcept {
  if (datagram.size() != kFrameSize || datagram[0] != 'E' || datagram[1] != 'C' ||
      datagram[2] != 0 || datagram[3] != 1) {
    return false;
  }
  const auto byte = [&datagram](std::size_t at) noexcept { return int{datagram[at]}; };
  settings.transmits = byte(4) == 0;
  take(static_cast<unsigned>(byte(7)) - kFirstRangeCode, kRanges_m, settings.range_m);
  take_within(byte(8), 0, 20, settings.gain_db);
  take(static_cast<unsigned>(byte(11)), kSectors_deg, settings.sector_deg);
  take(static_cast<unsigned>(byte(13)), kBeams, settings.beams);
  take_within(byte(14), 0, 10, settings.averaged);
  const int sound_speed_dm_s = byte(17) * 256 + byte(18);
  if (sound_speed_dm_s >= 14000 && sound_speed_dm_s <= 16000) {
    settings.sound_speed_m_s = sound_speed_dm_s / 10.0;
  }
  if (byte(20) <= 1) {
    settings.sends_image = byte(20) == 1;
  }
  settings.profile_points = byte(21) == 1;
  take_within(byte(22), 0, 100, settings.profile_least_range_m);
  take_within(byte(23), 10, 90, settings.profile_least_level_percent);
  settings.tilt_deg = byte(25) - 180;
  return true;
}

}  // namespace lodesman::emulated
