// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/options.h"

#include <charconv>
#include <string>

namespace lodesman {

std::vector<std::string_view> nmea_settings() { return {"baud", "latency_s"}; }

NmeaOptions nmea_options(const DeviceAddress& address) {
  NmeaOptions options;
  const std::string word = address.word(
      "baud", "9600",
      {"4800", "9600", "19200", "38400", "57600", "115200", "230400", "460800", "921600"});
  std::from_chars(word.data(), word.data() + word.size(), options.baud);
  options.latency = from_seconds(address.number("latency_s", 0.0, 0.0, 1.0));
  return options;
}

}  // namespace lodesman
