// SPDX-License-Identifier: Apache-2.0
// The options that every command of `lodesman` has, and the exit statuses of the
// contract. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lodesman::cli {

// Exit statuses of the contract.
inline constexpr int kExitDone = 0;
inline constexpr int kExitNoGoal = 1;
inline constexpr int kExitRefused = 2;
inline constexpr int kExitCollision = 3;
inline constexpr int kExitFault = 4;
inline constexpr int kExitNotYet = 75;  // EX_TEMPFAIL: what is needed is not there yet

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

inline void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_flag("--json", options.json, "Print one JSON document on standard output");
  command.add_flag("--quiet", options.quiet, "No progress and no summary");
  // One value an option: what follows it is the command's own.
  command.add_option("--config", options.config_files, "Configuration overlay (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command.add_option("--set", options.sets, "Override one configuration value (repeatable)")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
}

}  // namespace lodesman::cli
