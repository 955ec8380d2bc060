// SPDX-License-Identifier: Apache-2.0
// Protection zones of our own making, for obstacles that bring none that may be used. Pure
// functions; any thread.
#pragma once

#include "mid_level/messages/sonar.h"

namespace lodesman {

// A zone keeps the hull clear of the shape by a margin.
struct OwnZones {
  double hull_radius_m = 0.0;  // [m] >= 0 from the vehicle's centre to where it counts as touching
  double margin_m = 0.0;       // [m] >= 0
};

// Replaces every protection zone.
void make_own_zones(const OwnZones& zones, SonarObstacles& obstacles) noexcept;

}  // namespace lodesman
