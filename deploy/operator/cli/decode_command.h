// SPDX-License-Identifier: Apache-2.0
// `lodesman decode`: the recorded bytes of a device as JSON lines. The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

// Its exit status is left in `exit_status` when the command is parsed.
void add_decode_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
