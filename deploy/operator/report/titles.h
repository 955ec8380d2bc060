// SPDX-License-Identifier: Apache-2.0
// What the pictures say of a run in words. Pure functions; any thread.
#pragma once

#include <string>

#include "deploy/operator/report/run_record.h"

namespace lodesman::cli {

// The outcome in words: "goal reached", "time limit", ...
[[nodiscard]] std::string outcome_words(const RunResult& result);

// Scenario, profile, outcome and time.
[[nodiscard]] std::string picture_title(const RunResult& result);

}  // namespace lodesman::cli
