// SPDX-License-Identifier: Apache-2.0
// What the main files of both processes have in common: their options, signals, and how a refusal
// is said. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace lodesman::cli {

struct ProcessOptions {
  std::string segment;
  std::string configuration_file;  // resolved: every key
  std::string scenario_file;
  std::optional<std::uint64_t> seed;  // instead of the scenario's
};

void add_process_options(CLI::App& app, ProcessOptions& options);

// Keeps SIGINT and SIGTERM for wait_for_stop(). To be called before any thread is started.
void block_stop_signals();
// Returns on SIGINT or SIGTERM, or once `give_up` says true (asked ten times a second).
void wait_for_stop(const std::function<bool()>& give_up);

// Parses, runs `body` and turns what it throws into one line and an exit status.
[[nodiscard]] int process_main(CLI::App& app, int argc, char** argv,
                               const std::function<int()>& body);

}  // namespace lodesman::cli
