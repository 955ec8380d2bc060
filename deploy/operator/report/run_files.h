// SPDX-License-Identifier: Apache-2.0
// The text files of a run directory as the contract spells them: trajectory.csv and plans.jsonl,
// written while the run goes on, and result.json. One thread.
#pragma once

#include <filesystem>
#include <string>

#include "deploy/operator/report/output_file.h"
#include "deploy/operator/report/run_record.h"

namespace lodesman::cli {

// The document of result.json and of `lodesman sim --json`, with its final line end.
[[nodiscard]] std::string result_json(const RunResult& result);

class RunFiles {
 public:
  // Into an existing directory: begins both and keeps room for result.json. StartupError names a
  // file that cannot be made.
  explicit RunFiles(const std::filesystem::path& directory);

  void add(const TrajectoryRow& row);
  void add(const PlanRecord& plan);
  // result.json first, then whatever the two others still wait for. Once, and the last call.
  void finish(const RunResult& result);
  // One line that says what is not whole, the first such thing; empty as long as all is.
  [[nodiscard]] const std::string& fault() const noexcept;

 private:
  LineFile trajectory_;
  LineFile plans_;
  ReservedFile result_;
  std::string result_fault_;
};

}  // namespace lodesman::cli
