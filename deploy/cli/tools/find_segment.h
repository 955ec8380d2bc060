// SPDX-License-Identifier: Apache-2.0
// Which segment is meant when none is named: the only one there is. One thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lodesman::cli {

// The names of the segments in `directory` (/dev/shm), sorted.
[[nodiscard]] std::vector<std::string> segments_in(const std::filesystem::path& directory);

// `named` where it is not empty (its path in /dev/shm will do); else the only one of `found`, or
// of those of them that are `alive`. Throws StartupError where there is none or a choice.
[[nodiscard]] std::string choose_segment(const std::string& named,
                                         const std::vector<std::string>& found,
                                         const std::vector<std::string>& alive);

}  // namespace lodesman::cli
