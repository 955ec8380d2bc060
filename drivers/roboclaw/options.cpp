// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "drivers/roboclaw/roboclaw.h"

namespace lodesman {

std::vector<std::string_view> roboclaw_settings() {
  return {"address", "time_out_s", "reverse", "swap", "neutral_first"};
}

RoboClawOptions roboclaw_options(const DeviceAddress& address) {
  RoboClawOptions options;
  options.address = static_cast<std::uint8_t>(
      address.integer("address", options.address, roboclaw::kFirstAddress, roboclaw::kLastAddress));
  options.time_out =
      from_seconds(address.number("time_out_s", to_seconds(options.time_out), 0.3, 0.9));
  const std::string reversed = address.word("reverse", "none", {"none", "left", "right", "both"});
  options.left_reversed = reversed == "left" || reversed == "both";
  options.right_reversed = reversed == "right" || reversed == "both";
  options.swap = address.word("swap", "off", {"off", "on"}) == "on";
  options.neutral_first = address.word("neutral_first", "on", {"off", "on"}) == "on";
  return options;
}

}  // namespace lodesman
