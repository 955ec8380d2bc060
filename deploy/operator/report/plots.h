// SPDX-License-Identifier: Apache-2.0
// The pictures of a run directory, drawn by gnuplot from a run's record and files. One thread;
// StartupError says in one line what is missing (gnuplot) or which file cannot be written.
#pragma once

#include <filesystem>

#include "deploy/operator/report/run_record.h"

namespace lodesman::cli {

// As the paper's Figs 5 and 6: obstacles, protection zones, plans and the track, at up to four
// moments of the run.
void draw_world(const std::filesystem::path& png, const RunRecord& record);

// All four, by their names in the contract, into a directory that holds trajectory.csv. Those over
// time are drawn by the gnuplot scripts of their names in `scripts`, which anybody may change. One
// that fails leaves the others to be drawn; the first failure is thrown afterwards.
void draw_pictures(const std::filesystem::path& directory, const RunRecord& record,
                   const std::filesystem::path& scripts);

}  // namespace lodesman::cli
