// SPDX-License-Identifier: Apache-2.0
// The configuration's section [console]: read by every program, so that what is wrong in it is
// refused by all, and used by the console. One thread, at start-up; throws StartupError.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "high_level/mission/network.h"
#include "mid_level/config/toml_document.h"

namespace lodesman {

struct ConsoleSettings {
  std::string address;  // IP
  std::uint16_t port = 0;
  std::vector<std::string> names;  // of the machine, in a browser's address, beside loopback's
};

[[nodiscard]] inline ConsoleSettings read_console(const TomlTable& table) {
  ConsoleSettings settings{table.text("address", 64),
                           static_cast<std::uint16_t>(table.integer("port", 0, 65535)),
                           table.texts("names", 253, 16)};
  const std::optional<Reach> reach = reach_of(settings.address);
  if (!reach) {
    table.refuse("address", "must be an IP address");
  }
  if (*reach == Reach::kNetwork) {
    table.refuse("address", "must be this machine's own: HTTP would carry tokens in the clear");
  }
  return settings;
}

}  // namespace lodesman
