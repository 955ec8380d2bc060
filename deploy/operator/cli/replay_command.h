// SPDX-License-Identifier: Apache-2.0
// `lodesman replay LOG`: a recording's decisions made again, and those that differ. The main
// thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

inline constexpr const char* kReplayDescription = "Make a recording's decisions again";

// Its exit status is left in `exit_status` when the command is parsed.
void add_replay_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
