// SPDX-License-Identifier: Apache-2.0
// How a program's command line fills its CommonOptions. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>

#include "deploy/boat/common_options.h"

namespace lodesman {

inline void add_configuration_options(CLI::App& command, CommonOptions& options) {
  // One value an option: what follows it is the command's own.
  command.add_option("--config", options.config_files, "Configuration overlay (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command.add_option("--set", options.sets, "Override one configuration value (repeatable)")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
}

// An option of its own for a key that holds a text.
inline void add_set_option(CLI::App& command, const std::string& flag, const std::string& key,
                           const std::string& description, CommonOptions& options) {
  command
      .add_option_function<std::string>(
          flag,
          [&options, key](const std::string& text) {
            options.sets.push_back(key + "=" + toml_string(text));
          },
          description)
      ->type_name("TEXT");
}

// A port of a network. Digits alone: CLI11 by itself wraps negative numbers round.
inline void add_port_option(CLI::App& command, const std::string& name, std::uint16_t& port,
                            const std::string& description) {
  command
      .add_option_function<std::string>(
          name,
          [&port, name](const std::string& text) {
            std::uint16_t value = 0;
            const char* end = text.data() + text.size();
            const auto parsed = std::from_chars(text.data(), end, value);
            if (parsed.ec != std::errc{} || parsed.ptr != end || value == 0) {
              throw CLI::ValidationError(name, "must be from 1 to 65535");
            }
            port = value;
          },
          description)
      ->type_name("PORT");
}

// Digits alone, for the same reason, up to what a scenario file can hold.
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
