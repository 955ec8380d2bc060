// SPDX-License-Identifier: Apache-2.0
// `lodesman plan`: the path finder alone, on obstacle lists in the sonar view or on MovingAI maps.
// The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

// Its exit status is left in `exit_status` when the command is parsed.
void add_plan_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
