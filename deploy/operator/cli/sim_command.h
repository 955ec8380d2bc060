// SPDX-License-Identifier: Apache-2.0
// `lodesman sim SCENARIO`: the whole boat on simulated devices, by two processes in real time or in
// lock-step. The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

// Its exit status is left in `exit_status` when the command is parsed.
void add_sim_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
