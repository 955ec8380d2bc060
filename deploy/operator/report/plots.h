// SPDX-License-Identifier: Apache-2.0
// The pictures of a run directory, drawn by gnuplot from a run's record. One thread; StartupError
// says in one line what is missing (gnuplot) or which file cannot be written.
#pragma once

#include <filesystem>

#include "deploy/operator/report/run_record.h"

namespace lodesman::cli {

// As the paper's Figs 5 and 6: obstacles, protection zones, plans and the track, at up to four
// moments of the run.
void draw_world(const std::filesystem::path& png, const RunRecord& record);
// As Fig. 7: its minimum, the collision line, the times without a path.
void draw_inoffensive_distance(const std::filesystem::path& png, const RunRecord& record);
// As Figs 12a and 16: true heading, HeadRef below it.
void draw_heading(const std::filesystem::path& png, const RunRecord& record);
// As Fig. 12b: both thrust commands.
void draw_thrust(const std::filesystem::path& png, const RunRecord& record);

// All four, by their names in the contract, into an existing directory. One that fails leaves the
// others to be drawn; the first failure is thrown afterwards.
void draw_pictures(const std::filesystem::path& directory, const RunRecord& record);

}  // namespace lodesman::cli
