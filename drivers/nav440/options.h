// SPDX-License-Identifier: Apache-2.0
// What a NAV440 is asked for, read from its address: "/dev/ttyUSB0?packet=N1&rate_hz=20". One
// thread, at start-up; everything that is wrong throws StartupError with the reason alone.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "drivers/hal/device_address.h"
#include "drivers/nav440/packets.h"
#include "mid_level/base/time.h"

namespace lodesman {

// Where its heading comes from. A2 is none of them: its yaw drifts freely.
enum class Nav440Packet : std::uint8_t {
  kAuto,  // A1, and where the unit refuses that, A0
  kA0,    // magnetic
  kA1,    // magnetic, with the whole time of the week
  kN0,    // true, with position
  kN1,    // true, with position and the whole time of the week
};

inline constexpr std::array<int, 4> kNav440Speeds_baud{57600, 38400, 19200, 9600};

struct Nav440Options {
  int baud = 57600;  // [Bd] tried first, and set where another is too slow for what is asked for
  Nav440Packet packet = Nav440Packet::kAuto;
  int rate_hz = 50;              // [Hz] [2, 100] 100 or what a divider of the unit makes of it
  double declination_rad = 0.0;  // [rad] [-pi, pi] east positive; for a magnetic heading alone
  Duration latency{};            // [ns] what the adapter is known to hold bytes back
  // Where it has none, bytes take no time, and no speed is looked for or set.
  bool line_has_speed = true;
};

// The names that its address may have: baud, packet, rate_hz, declination_deg, latency_s.
[[nodiscard]] std::vector<std::string_view> nav440_settings();
[[nodiscard]] Nav440Options nav440_options(const DeviceAddress& address);
// Throws where such packets at such a rate do not fit a line of this speed, or the unit has none.
void check_nav440_options(const Nav440Options& options);

namespace nav440 {

// The packet that is asked for first.
[[nodiscard]] PacketType first_choice(Nav440Packet packet) noexcept;
// [Hz] so many whole packets a line of this speed carries; ten bits go for a byte.
[[nodiscard]] int most_packets_hz(PacketType type, int baud) noexcept;

}  // namespace nav440
}  // namespace lodesman
