// SPDX-License-Identifier: Apache-2.0
// Scenarios with the vessel that is shipped. One thread.
#pragma once

#include <string>

#include "hal_sim/scenario/scenario.h"
#include "tests/support/good_scenario.h"

namespace lodesman::testing {

[[nodiscard]] inline VesselParameters shipped_vessel() { return load_vessel(LODESMAN_VESSEL); }

[[nodiscard]] inline Scenario scenario_of(const std::string& text) {
  const TomlDocument document = TomlDocument::from_text(text, "s.toml");
  return read_scenario(document, shipped_vessel());
}

}  // namespace lodesman::testing
