// SPDX-License-Identifier: Apache-2.0
// What a Pololu Maestro keeps in its memory of how it is set, read as its maker's program does and
// compared with what this boat needs of it. Decoding and judgement are pure: where the bytes come
// from is the caller's (maestro_usb.h). Nothing is ever written. One thread.
//
// A parameter is 1 or 2 bytes, the least significant first, by an index: the maker's SDK, and ports
// of it to other languages that agree. Pulses are in quarters of a microsecond, limits in 64 of
// these, the time-out in hundredths of a second.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deploy/operator/doctor/diagnosis.h"
#include "drivers/hal/thrust_shape.h"
#include "drivers/maestro/maestro.h"

namespace lodesman::cli {

struct MaestroChannel {
  // [quarter us] where it goes on start-up and on error; the first two values mean something else.
  static constexpr std::uint16_t kHomeOff = 0;
  static constexpr std::uint16_t kHomeIgnore = 1;
  std::uint16_t home_quarter_us = kHomeOff;
  std::uint16_t least_quarter_us = 0;
  std::uint16_t most_quarter_us = 0;
  std::uint8_t speed = 0;         // as it is stored; 0: no limit
  std::uint8_t acceleration = 0;  // likewise
};

struct MaestroSettings {
  static constexpr std::uint8_t kUsbDualPort = 0;
  static constexpr std::uint8_t kUsbChained = 1;
  static constexpr std::uint8_t kUartDetect = 2;
  static constexpr std::uint8_t kUartFixed = 3;
  std::uint8_t serial_mode = kUartDetect;  // any value that the box gives
  Duration time_out{};                     // [ns] 0: none
  bool crc = false;
  bool never_suspend = false;
  MaestroChannel left;
  MaestroChannel right;
};

// What the boat asks of its box.
struct MaestroNeeds {
  MaestroOptions options;
  double most_ahead = 1.0;   // [-] [0, 1] share of the range that full thrust comes to
  double most_astern = 1.0;  // [-] [0, 1]
};
// Of an address "maestro:/dev/...?left=0"; of any other, what the driver takes by itself.
[[nodiscard]] MaestroNeeds maestro_needs(const std::string& address,
                                         const ThrustShapeOptions& shape);

// Fills in the bytes of a parameter; false where the box does not give just as many.
using MaestroParameters = std::function<bool(std::uint8_t index, std::span<std::uint8_t> bytes)>;
// None where one of them is not given.
[[nodiscard]] std::optional<MaestroSettings> read_maestro(const MaestroParameters& give,
                                                          const MaestroOptions& options);

// What is wrong, each with what mends it; one finding that all is well where nothing is.
[[nodiscard]] std::vector<Finding> judge_maestro(const std::string& name,
                                                 const MaestroSettings& settings,
                                                 const MaestroNeeds& needs);

}  // namespace lodesman::cli
