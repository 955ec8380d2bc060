// SPDX-License-Identifier: Apache-2.0
// What the machine is kept busy with meanwhile, by stress-ng. Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lodesman::cli {

enum class LoadKind : std::uint8_t {
  kIdle,  // nothing: as it is found
  kCpu,   // every core computes
  kAll,   // and memory is written, files too, sockets and pipes are used, threads change
};
[[nodiscard]] const char* to_string(LoadKind kind) noexcept;
[[nodiscard]] std::optional<LoadKind> load_named(std::string_view name) noexcept;

// The command; empty for kIdle. It ends by itself after so long, should nobody end it.
[[nodiscard]] std::vector<std::string> load_words(LoadKind kind, unsigned cores,
                                                  unsigned longest_s);

}  // namespace lodesman::cli
