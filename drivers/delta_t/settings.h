// SPDX-License-Identifier: Apache-2.0
// What the address of a Delta T says, or of a recording of one. At start-up; throws StartupError.
#pragma once

#include <string_view>
#include <vector>

#include "drivers/delta_t/control.h"
#include "drivers/delta_t/ping.h"
#include "drivers/hal/device_address.h"

namespace lodesman {

inline constexpr std::uint16_t kDeltaTPort = 4040;

struct DeltaTSettings {
  std::uint16_t port = kDeltaTPort;  // [-] of this computer, to which the maker's program sends
  delta_t::Control control;          // what is asked of that program
  bool controls = true;              // false: its user sets it, and nothing is asked
  delta_t::BeamSign beam_sign = delta_t::BeamSign::kStarboard;
};

// The names that its address may have: port, output, range_m, gain_db, sector_deg, beams,
// sound_speed_m_s, display_gain_percent, least_level_percent, least_range_m, transducer, control,
// beam_sign. Its place is the computer on which the maker's program runs.
[[nodiscard]] std::vector<std::string_view> delta_t_settings();
[[nodiscard]] DeltaTSettings delta_t_settings_in(const DeviceAddress& address);

// Of a recording: beam_sign. Its place is a directory.
[[nodiscard]] std::vector<std::string_view> ping_file_settings();
[[nodiscard]] delta_t::BeamSign beam_sign_in(const DeviceAddress& address);

}  // namespace lodesman
