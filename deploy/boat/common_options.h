// SPDX-License-Identifier: Apache-2.0
// What a program is told about its configuration, and texts as they stand in it. Plain values; any
// thread.
#pragma once

#include <string>
#include <vector>

namespace lodesman {

struct CommonOptions {
  bool json = false;  // exactly one JSON document (or JSON lines) on stdout
  bool quiet = false;
  std::vector<std::string> config_files;  // overlays, in order
  std::vector<std::string> sets;          // section.key=value
};

// A text as a TOML string, whatever stands in it.
[[nodiscard]] inline std::string toml_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    if (code < 0x20 || code == 0x7f) {
      constexpr const char* kDigits = "0123456789ABCDEF";
      quoted += std::string{"\\u00"} + kDigits[code >> 4U] + kDigits[code & 15U];
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

}  // namespace lodesman
