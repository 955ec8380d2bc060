// SPDX-License-Identifier: Apache-2.0
// What both levels are told of a voyage, from the configuration and the scenario. One thread, at
// start-up; everything that is wrong throws StartupError.
#pragma once

#include "hal_sim/scenario/scenario.h"
#include "high_level/tasks/high_level.h"
#include "low_level/tasks/low_level.h"
#include "mid_level/config/toml_document.h"

namespace lodesman {

// The options of each level for a scenario that is simulated.
[[nodiscard]] LowLevelOptions low_level_options(const TomlDocument& configuration,
                                                const Scenario& scenario);
[[nodiscard]] HighLevelOptions high_level_options(const TomlDocument& configuration,
                                                  const Scenario& scenario);

}  // namespace lodesman
