// SPDX-License-Identifier: Apache-2.0
// How far the vehicle's hull is from an obstacle, exactly and signed. Pure functions with bounded
// work and no allocation; any thread.
#pragma once

#include "mid_level/base/frames.h"
#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {

// The oriented rectangle round the vehicle's origin.
struct HullSize {
  double length_m = 0.0;  // along the heading
  double beam_m = 0.0;
};

// From the hull to the obstacle. Where they overlap: minus how deep the obstacle reaches into the
// hull, which is at most half the beam.
[[nodiscard]] double hull_clearance_m(const Obstacle& obstacle, const VehiclePose& pose,
                                      const HullSize& hull) noexcept;

}  // namespace lodesman
