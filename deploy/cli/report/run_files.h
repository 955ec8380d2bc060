// SPDX-License-Identifier: Apache-2.0
// Writes the text files of a run directory as the contract spells them: result.json,
// trajectory.csv, plans.jsonl. One thread; StartupError names a file that cannot be written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/cli/report/run_record.h"

namespace lodesman::cli {

// The document of result.json and of `lodesman sim --json`, with its final line end.
[[nodiscard]] std::string result_json(const RunResult& result);

// Into an existing directory.
void write_result(const std::filesystem::path& directory, const RunResult& result);
void write_trajectory(const std::filesystem::path& directory,
                      const std::vector<TrajectoryRow>& rows);
void write_plans(const std::filesystem::path& directory, const std::vector<PlanRecord>& plans);

// All three, result.json last: where it stands, the run directory's text is whole.
void write_run_files(const std::filesystem::path& directory, const RunRecord& record);

}  // namespace lodesman::cli
