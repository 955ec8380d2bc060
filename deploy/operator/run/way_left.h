// SPDX-License-Identifier: Apache-2.0
// How far a mission has still to go. Pure; any thread.
#pragma once

#include "hal_sim/scenario/scenario.h"

namespace lodesman::cli {

// [m] from a place through the mission's waypoints from `goal_index` on to its goal.
[[nodiscard]] double way_left_m(const ScenarioMission& mission, std::size_t goal_index,
                                const WorldPoint& from);

}  // namespace lodesman::cli
