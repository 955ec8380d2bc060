// SPDX-License-Identifier: Apache-2.0
// lodesman: the operator's command.
#include <CLI/CLI.hpp>

#include "deploy/boat/process_main.h"
#include "deploy/boat/version.h"
#include "deploy/operator/cli/bench_program.h"
#include "deploy/operator/cli/calibrate_command.h"
#include "deploy/operator/cli/check_command.h"
#include "deploy/operator/cli/decode_command.h"
#include "deploy/operator/cli/doctor_command.h"
#include "deploy/operator/cli/operator_commands.h"
#include "deploy/operator/cli/plan_command.h"
#include "deploy/operator/cli/recover_command.h"
#include "deploy/operator/cli/rt_test_command.h"
#include "deploy/operator/cli/run_command.h"
#include "deploy/operator/cli/thrust_commands.h"
#include "deploy/operator/cli/token_command.h"
#include "deploy/operator/cli/watch_command.h"

int main(int argc, char** argv) {
  namespace cli = lodesman::cli;
  if (cli::is_bench_command(argc, argv)) {
    return cli::go_on_as_bench(argv);
  }
  lodesman::unblock_signals();
  CLI::App app{"Sees underwater obstacles with a forward-looking sonar and steers round them",
               "lodesman"};
  app.set_version_flag("--version", lodesman::kVersion);
  app.require_subcommand(1);
  int exit_status = 0;
  cli::name_bench_commands(app);
  cli::add_run_command(app, exit_status);
  cli::add_operator_commands(app, exit_status);
  cli::add_thrust_commands(app, exit_status);
  cli::add_calibrate_command(app, exit_status);
  cli::add_plan_command(app, exit_status);
  cli::add_check_command(app, exit_status);
  cli::add_decode_command(app, exit_status);
  cli::add_recover_command(app, exit_status);
  cli::add_watch_command(app, exit_status);
  cli::add_doctor_command(app, exit_status);
  cli::add_rt_test_command(app, exit_status);
  cli::add_token_command(app, exit_status);
  return lodesman::process_main(app, argc, argv, [&] { return exit_status; });
}
