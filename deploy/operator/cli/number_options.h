// SPDX-License-Identifier: Apache-2.0
// Numbers on a command line. The only place where one is read: it is finite and in range, or usage
// is refused with the option's name. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>

namespace lodesman::cli {

// A check for an option of one number: decimal, finite, and from `low` to `high`.
[[nodiscard]] CLI::Validator number_from(double low, double high);

// An option whose one value is two such numbers with a comma between them, as "3.5,-2".
CLI::Option* add_pair_option(CLI::App& command, const std::string& name,
                             std::optional<std::array<double, 2>>& pair, double low, double high,
                             const std::string& description);

}  // namespace lodesman::cli
