// SPDX-License-Identifier: Apache-2.0
// `lodesman recover`: closes a recording that was cut off. The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

// Its exit status is left in `exit_status` when the command is parsed.
void add_recover_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
