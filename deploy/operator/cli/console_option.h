// SPDX-License-Identifier: Apache-2.0
// The option --console of the commands that sail in real time: whether lodesman-console runs beside
// them, and on which port. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "deploy/operator/run/realtime_run.h"

namespace lodesman::cli {

inline constexpr const char* kConsoleAuto = "auto";

// "auto", "off", "on" or a port.
void add_console_option(CLI::App& command, std::string& console);

// By the word and the configured port: on that port alone where it was named; with "auto" where
// somebody sees standard error, a terminal, and is to be told where it is. None where `quiet`.
[[nodiscard]] std::optional<ConsoleBeside> console_beside(const std::string& console,
                                                          std::uint16_t configured, bool quiet);

}  // namespace lodesman::cli
