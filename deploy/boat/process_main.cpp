// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/process_main.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "deploy/boat/exit_status.h"
#include "deploy/boat/version.h"
#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

// A file that is opened later must not be taken for a stream that was closed. What is opened here
// cannot be read, or written, as the closed one could not.
void hold_closed_streams() noexcept {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0) {
      // The lowest free number is this one's.
      static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
    }
  }
}

[[nodiscard]] bool all_was_written() noexcept {
  std::cout.flush();
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::ferror(stderr) == 0;
}

[[nodiscard]] int status_of(CLI::App& app, int argc, char** argv,
                            const std::function<int()>& body) {
  try {
    app.parse(argc, argv);
    return body();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help, --version
    }
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return kExitRefused;
  } catch (const NotYetError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kExitNotYet;
  } catch (const StartupError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kExitRefused;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return kExitFault;
  }
}

}  // namespace

void add_process_options(CLI::App& app, ProcessOptions& options) {
  app.set_version_flag("--version", kVersion);
  add_configuration_options(app, options.common);
  app.add_option("--profile", options.profile, "default, or paper: as the paper did it")
      ->check(CLI::IsMember({"default", "paper"}));
  add_set_option(app, "--segment", "boat.segment", "Of shared memory, instead of the boat's",
                 options.common);
  add_set_option(app, "--scenario", "simulation.scenario", "Of the simulated world",
                 options.common);
  app.add_flag_callback("--stop-with-input", stop_with_standard_input,
                        "End with standard input, a pipe: so no child outlives its launcher");
}

void end_without(std::span<const TaskId> hung) {
  std::string tasks;
  for (const TaskId task : hung) {
    tasks += std::string{tasks.empty() ? "" : ", "} + to_string(task);
  }
  spdlog::error("stopped, but these tasks hang and are not known to be safe: {}", tasks);
  std::_Exit(kExitFault);
}

void say_what_hangs(HealthWatch& watch) {
  for (const std::string& line : watch.news(SteadyClock{}.now())) {
    spdlog::warn("{}", line);
  }
}

int process_main(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  hold_closed_streams();
  settle_signals();
  const int status = status_of(app, argc, argv, body);
  if (!all_was_written() && status == kExitDone) {
    std::fprintf(stderr, "%s: standard output cannot be written\n", app.get_name().c_str());
    return kExitFault;
  }
  return status;
}

}  // namespace lodesman
