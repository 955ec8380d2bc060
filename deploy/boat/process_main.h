// SPDX-License-Identifier: Apache-2.0
// What the main files have in common: the options of both processes, their streams and signals, how
// a refusal is said, and that what could not be written is no success. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "deploy/boat/stop_signals.h"
#include "mid_level/runtime/health_watch.h"

namespace lodesman {

struct ProcessOptions {
  std::string segment;
  std::string configuration_file;  // resolved: every key
  std::string scenario_file;
  std::optional<std::uint64_t> seed;  // instead of the scenario's
};

void add_process_options(CLI::App& app, ProcessOptions& options);

// What a runner does whose tasks hang at the end: says which, and ends the process with a fault.
[[noreturn]] void end_without(std::span<const TaskId> hung);
// Says once which tasks have begun to hang, and which step again.
void say_what_hangs(HealthWatch& watch);

// Parses, runs `body` and turns what it throws into one line and an exit status, which is a fault
// too where standard output could not be written.
[[nodiscard]] int process_main(CLI::App& app, int argc, char** argv,
                               const std::function<int()>& body);

}  // namespace lodesman
