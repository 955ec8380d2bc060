// SPDX-License-Identifier: Apache-2.0
// The boat's speed table as a file has it. One thread, at start-up.
#pragma once

#include "mid_level/base/speed_table.h"
#include "mid_level/config/toml_document.h"

namespace lodesman {

// speed_table = [[surge_ref, m/s], ...] of the table [vehicle]. Throws StartupError.
[[nodiscard]] SpeedTable read_speed_table(const TomlTable& vehicle);

}  // namespace lodesman
