// SPDX-License-Identifier: Apache-2.0
// What a program is told on its command line about its configuration. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lodesman {

struct CommonOptions {
  bool json = false;  // exactly one JSON document (or JSON lines) on stdout
  bool quiet = false;
  std::vector<std::string> config_files;  // overlays, in order
  std::vector<std::string> sets;          // section.key=value
};

// Digits alone, up to what a scenario file can hold: CLI11 by itself wraps negative numbers round.
inline void add_seed_option(CLI::App& command, std::optional<std::uint64_t>& seed) {
  command
      .add_option_function<std::string>(
          "--seed",
          [&seed](const std::string& text) {
            std::int64_t value = -1;
            const char* end = text.data() + text.size();
            const auto parsed = std::from_chars(text.data(), end, value);
            if (parsed.ec != std::errc{} || parsed.ptr != end || value < 0) {
              throw CLI::ValidationError("--seed", "must be from 0 to 9223372036854775807");
            }
            seed = static_cast<std::uint64_t>(value);
          },
          "Seed instead of the scenario's")
      ->type_name("N");
}

}  // namespace lodesman
