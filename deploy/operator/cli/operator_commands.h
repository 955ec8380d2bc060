// SPDX-License-Identifier: Apache-2.0
// `lodesman start`, `abort` and `status`: an operator's word to a running boat, straight to the
// command socket of lodesman-high, whatever else is dead. The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

void add_operator_commands(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
