// SPDX-License-Identifier: Apache-2.0
// `lodesman rt-test`: the task set on this machine under load, beside what the machine itself can
// do. The main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

void add_rt_test_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
