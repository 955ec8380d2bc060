// SPDX-License-Identifier: Apache-2.0
// The options that every command of `lodesman` has. The main thread.
#pragma once

#include "deploy/boat/exit_status.h"
#include "deploy/boat/program_options.h"

namespace lodesman::cli {

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
