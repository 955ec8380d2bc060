// SPDX-License-Identifier: Apache-2.0
// The one value between configuration and levels: what a voyage has that the boat itself has not.
// One thread, at start-up; everything that is wrong throws StartupError.
#pragma once

#include <optional>
#include <vector>

#include "deploy/boat/configuration.h"
#include "hal_sim/scenario/scenario.h"
#include "high_level/tasks/high_level.h"
#include "high_level/tasks/operator_desk.h"
#include "low_level/tasks/low_level.h"

namespace lodesman {

struct Voyage {
  PositionSource position_source = PositionSource::kDeadReckoning;
  WorldPoint start;                // where dead reckoning begins
  std::optional<GeoPoint> origin;  // of the world frame; empty: by the first fixes
  // The paper's tank trick: the obstacles are known, and drawn where the estimate has the boat.
  std::optional<std::vector<MovingObstacle>> known_scene;
  double sonar_sector_rad = 0.0;  // in which they are seen
  std::uint64_t seed = 0;
  std::optional<MissionDefinition> mission;  // that it begins with
};

// The scenario's sonar, with the scene that the configuration puts in the place of its own.
[[nodiscard]] ScenarioSonar sailed_sonar(const BoatConfig& config, const Scenario& scenario);

// `scenario`: of the simulated world, where there is one.
[[nodiscard]] Voyage voyage_of(const BoatConfig& config, const Scenario* scenario);

// The options of each level, and of the desk before the high one.
[[nodiscard]] LowLevelOptions low_level_options(const BoatConfig& config, const Voyage& voyage);
[[nodiscard]] HighLevelOptions high_level_options(const BoatConfig& config, const Voyage& voyage);
[[nodiscard]] DeskOptions desk_options(const BoatConfig& config, const Voyage& voyage);

}  // namespace lodesman
