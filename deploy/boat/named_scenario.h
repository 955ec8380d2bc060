// SPDX-License-Identifier: Apache-2.0
// The scenario that a simulated boat sails. One thread, at start-up; everything that is wrong
// throws StartupError.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hal_sim/scenario/scenario.h"
#include "hal_sim/scenario/vessel_parameters.h"
#include "high_level/tasks/high_level.h"

namespace lodesman {

// By path, or by the name of a shipped scenario or of an encounter. `speeds`: the boat's own.
[[nodiscard]] Scenario load_named_scenario(const std::string& name_or_path,
                                           const SpeedTable& speeds);
[[nodiscard]] std::filesystem::path scenario_file(const std::string& name_or_path);
// A hull by the name of a shipped one (hal_sim/vessels), or by path; none where it is neither.
[[nodiscard]] std::optional<std::filesystem::path> hull_file(const std::string& name_or_path);
inline constexpr const char* kNoHull = " is neither a shipped hull (paper-asv, otter) nor a file";
[[nodiscard]] VesselParameters load_hull(const std::string& name_or_path);

// The scenario with the zones that are planned with: its own, or those that the pilot makes round
// what it gives a zone to and is sure of.
[[nodiscard]] Scenario with_planned_zones(Scenario scenario, const HighLevelOptions& options);

}  // namespace lodesman
