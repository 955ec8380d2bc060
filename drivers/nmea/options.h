// SPDX-License-Identifier: Apache-2.0
// What is said of a receiver in its address: "/dev/ttyUSB2?baud=9600". One thread, at start-up;
// everything that is wrong throws StartupError with the reason alone.
#pragma once

#include <string_view>
#include <vector>

#include "drivers/hal/device_address.h"
#include "mid_level/base/time.h"

namespace lodesman {

struct NmeaOptions {
  int baud = 9600;     // [Bd] as the receiver is set: it is not asked and not told
  Duration latency{};  // [ns] [0, 1 s] from a fix to the first byte that tells of it
};

// The names that its address may have: baud, latency_s.
[[nodiscard]] std::vector<std::string_view> nmea_settings();
[[nodiscard]] NmeaOptions nmea_options(const DeviceAddress& address);

}  // namespace lodesman
