// SPDX-License-Identifier: Apache-2.0
// `lodesman token`: makes the file of tokens by which a boat is commanded from ashore. The main
// thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

void add_token_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
