// SPDX-License-Identifier: Apache-2.0
// The options that every command of `lodesman` has. The main thread.
#pragma once

#include "deploy/boat/exit_status.h"
#include "deploy/boat/program_options.h"

namespace lodesman::cli {

inline void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_flag("--json", options.json, "Print one JSON document on standard output");
  command.add_flag("--quiet", options.quiet, "No progress and no summary");
  add_configuration_options(command, options);
}

}  // namespace lodesman::cli
