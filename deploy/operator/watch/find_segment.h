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
// of those of them that are `alive`. Throws NotYetError where there is none, StartupError where
// there is a choice.
[[nodiscard]] std::string choose_segment(const std::string& named,
                                         const std::vector<std::string>& found,
                                         const std::vector<std::string>& alive);

// Those of them that no living program holds, of this user's: somebody was killed and left them.
[[nodiscard]] std::vector<std::string> dead_segments_in(const std::filesystem::path& directory);

// Removes what killed simulated runs have left in /dev/shm, and of no other boat.
void remove_dead_runs();

}  // namespace lodesman::cli
