// SPDX-License-Identifier: Apache-2.0
// `lodesman plot LOG`: the run directory of a recording, of a run on the water too. The main
// thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

inline constexpr const char* kPlotDescription = "Draw a recording's pictures";

// Its exit status is left in `exit_status` when the command is parsed.
void add_plot_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
