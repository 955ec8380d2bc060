// SPDX-License-Identifier: Apache-2.0
// The directory that a run is written to, made for this run alone. One thread, at start-up;
// StartupError says why there is none.
#pragma once

#include <filesystem>
#include <string>

namespace lodesman::cli {

// Whether a run lies there: any file or folder that a run would write.
[[nodiscard]] bool holds_a_run(const std::filesystem::path& directory);

// A new directory of that name, or the next free one: name-2, name-3, ...
[[nodiscard]] std::filesystem::path make_new_directory(const std::filesystem::path& name);

// The directory that a user names, made where there is none. One that holds a run is refused, or
// with `force` cleared of what runs write, and of nothing else.
[[nodiscard]] std::filesystem::path make_named_directory(const std::filesystem::path& name,
                                                         bool force);

}  // namespace lodesman::cli
