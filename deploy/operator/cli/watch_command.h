// SPDX-License-Identifier: Apache-2.0
// `lodesman watch`: the channels and tasks of a running boat, live in the terminal; it only looks
// on. The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

// Its exit status is left in `exit_status` when the command is parsed.
void add_watch_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
