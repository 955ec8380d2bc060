// SPDX-License-Identifier: Apache-2.0
// Obstacles as closed lines to be drawn, in the frame that the obstacle is in. Pure functions; any
// thread.
#pragma once

#include <vector>

#include "mid_level/messages/obstacle.h"

namespace lodesman::console {

inline constexpr int kEllipseCorners = 24;

// Its edge; of a wall its points there and back.
[[nodiscard]] std::vector<Vertex> outline_of(const Obstacle& obstacle);
// The edge of its protection zone; round a wall the line so far off it, which crosses itself where
// the wall is bent inwards: filled by the non-zero rule it is the zone. Empty where it has none.
[[nodiscard]] std::vector<Vertex> zone_of(const Obstacle& obstacle);

}  // namespace lodesman::console
