// SPDX-License-Identifier: Apache-2.0
// Whether a collision could have been avoided by somebody who knows everything: brute force over
// constant thrust in two stages, sailed with the simulated vessel itself among the obstacles at
// their true places. Pure; any thread.
#pragma once

#include <optional>
#include <span>

#include "hal_sim/world/vessel.h"
#include "mid_level/geometry/moving_obstacle.h"

namespace lodesman::testing {

struct Waters {
  VesselParameters vessel;
  WaterConditions water;
  std::span<const MovingObstacle> obstacles;
};

struct Escape {
  ThrustCommand first;
  double first_for_s = 0.0;
  ThrustCommand second;  // from then on
};

// The first one found that leaves the hull clear of every obstacle at each tenth of a second of
// [from_s, until_s], scenario time, where until_s - from_s is at least 8 s. Nothing where none
// does.
[[nodiscard]] std::optional<Escape> find_escape(const Waters& waters, const VesselState& from,
                                                double from_s, double until_s);

// From the hull to what exists at that time.
struct Nearest {
  std::uint32_t obstacle = 0;  // id
  double clearance_m = 0.0;
};
[[nodiscard]] Nearest nearest_obstacle(const Waters& waters, const VehiclePose& pose,
                                       double scenario_time_s);

}  // namespace lodesman::testing
