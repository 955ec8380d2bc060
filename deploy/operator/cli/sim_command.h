// SPDX-License-Identifier: Apache-2.0
// `lodesman sim SCENARIO`: the whole boat on simulated devices, by two processes in real time or in
// lock-step; `lodesman hil SCENARIO`: with the real drivers, on a bench. The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

inline constexpr const char* kSimDescription = "Sail a scenario on simulated devices";
inline constexpr const char* kHilDescription =
    "Sail a scenario with the real drivers, on devices that are emulated to the byte";

// Its exit status is left in `exit_status` when the command is parsed.
void add_sim_command(CLI::App& root, int& exit_status);
void add_hil_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
