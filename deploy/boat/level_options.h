// SPDX-License-Identifier: Apache-2.0
// What the configuration says of the levels. One thread, at start-up; throws StartupError.
#pragma once

#include "drivers/hal/thrust_shape.h"
#include "high_level/tasks/high_level.h"
#include "low_level/tasks/low_level.h"
#include "mid_level/config/toml_document.h"

namespace lodesman {

// What the drivers of real thruster boxes make of a command, from section [vehicle].
[[nodiscard]] ThrustShapeOptions read_thrust_shape(const TomlTable& vehicle);
// Reads [segmentation], [zones], [mounting], [battery], [tracks], [guard] and of [vehicle] what the
// guard goes by; the scene comes from elsewhere.
[[nodiscard]] LowLevelOptions read_low_level_options(const TomlTable& configuration);
// The table [segmentation] alone.
[[nodiscard]] SegmentationOptions read_segmentation_options(const TomlTable& table);

// Reads [planner], [zones], [pilot], [vehicle], [progress], [guidance], [control], [mounting] and
// [estimator];
// position source, start and origin come from elsewhere. `speeds`: the boat's own.
[[nodiscard]] HighLevelOptions read_high_level_options(const TomlTable& configuration,
                                                       const SpeedTable& speeds);

}  // namespace lodesman
