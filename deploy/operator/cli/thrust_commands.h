// SPDX-License-Identifier: Apache-2.0
// `lodesman arm`, `disarm`, `estop` and `manual`: whether the thrusters of a running boat may turn,
// and by whose hand. The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

void add_thrust_commands(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
