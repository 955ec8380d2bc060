// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpsd/options.h"

#include <charconv>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

constexpr const char* kPort = "2947";

// Behind the host; an IPv6 address has colons of its own, within brackets.
[[nodiscard]] std::size_t colon_of_port(const std::string& place) {
  const std::size_t colon = place.rfind(':');
  const std::size_t bracket = place.rfind(']');
  return colon != std::string::npos && bracket != std::string::npos && colon < bracket
             ? std::string::npos
             : colon;
}

[[nodiscard]] std::string with_port(const std::string& place) {
  const std::size_t colon = colon_of_port(place);
  const std::string host = place.substr(0, colon);
  if (host.empty() || (host.front() == '[') != (host.back() == ']')) {
    throw StartupError("needs the host on which gpsd runs, as gpsd:localhost");
  }
  const std::string port = colon == std::string::npos ? kPort : place.substr(colon + 1);
  int number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error != std::errc{} || end != port.data() + port.size() || number < 1 || number > 65535) {
    throw StartupError("the port of gpsd must be from 1 to 65535, not \"" + port + "\"");
  }
  return host + ":" + port;
}

}  // namespace

std::vector<std::string_view> gpsd_settings() { return {"device", "latency_s"}; }

GpsdOptions gpsd_options(const DeviceAddress& address) {
  GpsdOptions options;
  options.place = with_port(address.place());
  options.device = address.text("device", "");
  options.latency = from_seconds(address.number("latency_s", 0.0, 0.0, 1.0));
  return options;
}

}  // namespace lodesman
