// SPDX-License-Identifier: Apache-2.0
// lodesman calibrate: a boat is walked by the stick, and what it is like is printed. The main
// thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

void add_calibrate_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
