// SPDX-License-Identifier: Apache-2.0
// How far the vehicle is from an obstacle, exactly and signed, as a circle and as a hull. Pure
// functions with bounded work and no allocation; any thread.
#pragma once

#include "mid_level/base/frames.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

// From a point to the obstacle's edge, negative inside. A polyline has no inside.
[[nodiscard]] double edge_distance_m(const Obstacle& obstacle, const WorldPoint& p_W) noexcept;

// The oriented rectangle round the vehicle's origin.
struct HullSize {
  double length_m = 0.0;  // along the heading
  double beam_m = 0.0;
};

// From the hull to the obstacle. Where they overlap: minus how deep the obstacle reaches into the
// hull, which is at most half the beam.
[[nodiscard]] double hull_clearance_m(const Obstacle& obstacle, const VehiclePose& pose,
                                      const HullSize& hull) noexcept;

// Never more than the distance from the point to the obstacle's edge, and quick to compute.
[[nodiscard]] double edge_distance_bound_m(const Obstacle& obstacle,
                                           const WorldPoint& p_W) noexcept;

}  // namespace lodesman
