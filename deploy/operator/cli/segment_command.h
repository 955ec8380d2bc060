// SPDX-License-Identifier: Apache-2.0
// `lodesman segment`: the sonar image processing alone, on frames in image files. Called by main
// before it parses; the command runs on the main thread.
#pragma once

#include <CLI/CLI.hpp>

namespace lodesman::cli {

inline constexpr const char* kSegmentDescription = "Find obstacles in sonar frames";

// `exit_status` must outlive `root`; it is set when the command has run.
void add_segment_command(CLI::App& root, int& exit_status);

}  // namespace lodesman::cli
