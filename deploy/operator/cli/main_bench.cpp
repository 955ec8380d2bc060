// SPDX-License-Identifier: Apache-2.0
// lodesman-bench: the words of the operator's command that draw pictures. `lodesman` goes on as
// this program where one of them is said.
#include <CLI/CLI.hpp>

#include "deploy/boat/process_main.h"
#include "deploy/boat/version.h"
#include "deploy/operator/cli/plot_command.h"
#include "deploy/operator/cli/replay_command.h"
#include "deploy/operator/cli/segment_command.h"
#include "deploy/operator/cli/sim_command.h"

int main(int argc, char** argv) {
  namespace cli = lodesman::cli;
  lodesman::unblock_signals();
  // What it says is said by the command that was typed.
  CLI::App app{"The words of lodesman that draw: scenarios sailed, and sonar frames", "lodesman"};
  app.set_version_flag("--version", lodesman::kVersion);
  app.require_subcommand(1);
  int exit_status = 0;
  cli::add_sim_command(app, exit_status);
  cli::add_hil_command(app, exit_status);
  cli::add_segment_command(app, exit_status);
  cli::add_plot_command(app, exit_status);
  cli::add_replay_command(app, exit_status);
  return lodesman::process_main(app, argc, argv, [&] { return exit_status; });
}
