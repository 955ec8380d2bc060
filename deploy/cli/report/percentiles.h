// SPDX-License-Identifier: Apache-2.0
// What result.json says of many measurements in three numbers. A pure function; any thread.
#pragma once

#include <vector>

#include "deploy/cli/report/run_record.h"

namespace lodesman::cli {

// Nearest rank: always one of the values. Not finite values are left out; zeros when none is left.
[[nodiscard]] Percentiles percentiles(std::vector<double> values);

}  // namespace lodesman::cli
