// SPDX-License-Identifier: Apache-2.0
// The words of `lodesman` that lodesman-bench has: they draw pictures, for which it needs libraries
// that a boat does without (ADR 0034). The main thread, before anything is parsed.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

// Lists them, for --help.
void name_bench_commands(CLI::App& root);
// Whether the first word is one of them.
[[nodiscard]] bool is_bench_command(int argc, char** argv);
// This process goes on as lodesman-bench, which lies beside it. Returns only where that cannot be:
// the exit status, after a line that says why.
[[nodiscard]] int go_on_as_bench(char** argv);

}  // namespace lodesman::cli
