// SPDX-License-Identifier: Apache-2.0
// What the main files have in common: the options of both processes, their streams and signals, how
// a refusal is said, and that what could not be written is no success. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>

#include "deploy/boat/program_options.h"
#include "deploy/boat/stop_signals.h"
#include "mid_level/runtime/health_watch.h"

namespace lodesman {

struct ProcessOptions {
  CommonOptions common;
  std::string profile = "default";
};

// Those of a program of the boat, its version among them.
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
