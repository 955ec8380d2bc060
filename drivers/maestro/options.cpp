// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "drivers/maestro/maestro.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {

std::vector<std::string_view> maestro_settings() {
  return {"left",       "right",          "reverse", "neutral_us",   "range_us",
          "time_out_s", "hold_neutral_s", "crc",     "neutral_first"};
}

MaestroOptions maestro_options(const DeviceAddress& address) {
  MaestroOptions options;
  const auto channel = [&](std::string_view side, std::uint8_t otherwise) {
    return static_cast<std::uint8_t>(address.integer(side, otherwise, 0, maestro::kMaxChannel));
  };
  options.left_channel = channel("left", options.left_channel);
  options.right_channel = channel("right", options.right_channel);
  const std::string reversed = address.word("reverse", "none", {"none", "left", "right", "both"});
  options.left_reversed = reversed == "left" || reversed == "both";
  options.right_reversed = reversed == "right" || reversed == "both";
  options.neutral_us = address.number("neutral_us", options.neutral_us, 1000.0, 2000.0);
  options.range_us = address.number("range_us", options.range_us, 50.0, 1000.0);
  options.time_out =
      from_seconds(address.number("time_out_s", to_seconds(options.time_out), 0.3, 0.9));
  options.hold_neutral =
      from_seconds(address.number("hold_neutral_s", to_seconds(options.hold_neutral), 0.0, 60.0));
  options.crc = address.word("crc", "off", {"off", "on"}) == "on";
  options.neutral_first = address.word("neutral_first", "on", {"off", "on"}) == "on";
  return options;
}

}  // namespace lodesman
