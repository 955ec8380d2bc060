// SPDX-License-Identifier: Apache-2.0
// `lodesman run`: a boat without a service manager. The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

void add_run_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
