// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/run/process_main.h"

#include <csignal>
#include <cstdio>
#include <ctime>
#include <exception>

#include "deploy/cli/common_options.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

[[nodiscard]] sigset_t stop_signals() noexcept {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

void add_process_options(CLI::App& app, ProcessOptions& options) {
  app.add_option("--segment", options.segment, "Name of the shared-memory segment")->required();
  app.add_option("--config", options.configuration_file, "Configuration with every key")
      ->required();
  app.add_option("--scenario", options.scenario_file, "Scenario to simulate")->required();
  add_seed_option(app, options.seed);
}

void block_stop_signals() {
  const sigset_t set = stop_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

void wait_for_stop(const std::function<bool()>& give_up) {
  const sigset_t set = stop_signals();
  const timespec tenth{0, 100'000'000};
  while (sigtimedwait(&set, nullptr, &tenth) < 0 && !give_up()) {
  }
}

int process_main(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  try {
    app.parse(argc, argv);
    return body();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help, --version
    }
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return kExitRefused;
  } catch (const StartupError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kExitRefused;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return kExitFault;
  }
}

}  // namespace lodesman::cli
