// SPDX-License-Identifier: Apache-2.0
// The options that every command of `lodesman` has, and how a command joins the program.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lodesman::cli {

// Exit statuses of the contract.
inline constexpr int kExitDone = 0;
inline constexpr int kExitNoGoal = 1;
inline constexpr int kExitRefused = 2;
inline constexpr int kExitCollision = 3;
inline constexpr int kExitFault = 4;

struct CommonOptions {
  bool json = false;  // exactly one JSON document (or JSON lines) on stdout
  bool quiet = false;
  std::vector<std::string> config_files;  // overlays, in order
  std::vector<std::string> sets;          // section.key=value
};

inline void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_flag("--json", options.json, "Print one JSON document on standard output");
  command.add_flag("--quiet", options.quiet, "No progress and no summary");
  command.add_option("--config", options.config_files, "Configuration overlay (repeatable)")
      ->type_name("FILE");
  command.add_option("--set", options.sets, "Override one configuration value (repeatable)")
      ->type_name("SECTION.KEY=VALUE");
}

}  // namespace lodesman::cli
