// SPDX-License-Identifier: Apache-2.0
// The `[segmentation]` table of the configuration. Read once, before any task runs, by the thread
// that starts them; throws StartupError.
#pragma once

#include "low_level/sonar/segmentation.h"
#include "mid_level/base/config/toml_document.h"

namespace lodesman {

[[nodiscard]] SegmentationOptions read_segmentation_options(const TomlTable& table);

}  // namespace lodesman
