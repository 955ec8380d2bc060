// SPDX-License-Identifier: Apache-2.0
// Where gpsd listens, and which of its receivers is meant: "localhost:2947?device=/dev/ttyACM0".
// One thread, at start-up; everything that is wrong throws StartupError with the reason alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "drivers/hal/device_address.h"
#include "mid_level/base/time.h"

namespace lodesman {

struct GpsdOptions {
  std::string place;   // "host:port"
  std::string device;  // of gpsd's receivers, by its path there; empty: the first that speaks
  Duration latency{};  // [ns] [0, 1 s] from a fix to gpsd's report of it
};

// The names that its address may have: device, latency_s.
[[nodiscard]] std::vector<std::string_view> gpsd_settings();
// Without a port it is gpsd's own, 2947.
[[nodiscard]] GpsdOptions gpsd_options(const DeviceAddress& address);

}  // namespace lodesman
