// SPDX-License-Identifier: Apache-2.0
// Scenarios with the vessel that is shipped. One thread.
#pragma once

#include <string>

#include "hal_sim/scenario/scenario.h"
#include "hal_sim/scenario/vessel_parameters.h"
#include "mid_level/config/read_speed_table.h"
#include "tests/support/good_scenario.h"

namespace lodesman::testing {

[[nodiscard]] inline VesselParameters shipped_vessel() { return load_vessel(LODESMAN_VESSEL); }

[[nodiscard]] inline SpeedTable shipped_speeds() {
  return read_speed_table(TomlDocument::from_file(LODESMAN_DEFAULT_CONFIG).root().table("vehicle"));
}

[[nodiscard]] inline Scenario scenario_of(const std::string& text) {
  const TomlDocument document = TomlDocument::from_text(text, "s.toml");
  return read_scenario(document, shipped_speeds());
}

}  // namespace lodesman::testing
