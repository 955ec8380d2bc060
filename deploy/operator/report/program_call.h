// SPDX-License-Identifier: Apache-2.0
// Runs another program to its end, with its input from memory and its output into a file. Waits for
// it; any one thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lodesman::cli {

struct ProgramCall {
  std::vector<std::string> words;   // its name, looked for in PATH, then its arguments
  std::filesystem::path directory;  // where it runs
  std::string_view input;
  int output = -1;  // a descriptor
};

enum class ProgramEnd { kSuccess, kFailure, kMissing };

struct ProgramResult {
  ProgramEnd end = ProgramEnd::kFailure;
  std::string reason;  // one line: the last that it said of itself, or how it ended
};

// StartupError where this process can open no more files.
[[nodiscard]] ProgramResult run_program(const ProgramCall& call);

}  // namespace lodesman::cli
