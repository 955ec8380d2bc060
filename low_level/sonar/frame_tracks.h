// SPDX-License-Identifier: Apache-2.0
// One sonar frame's obstacles as tracks without a past: nothing is known of how they move, and they
// are forgotten with the next frame. It stands in for tracking from echoes. A pure function; any
// thread.
#pragma once

#include "mid_level/base/frames.h"
#include "mid_level/messages/sonar.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

// Track::id is 0: which obstacle of the frame before it was is not known.
void tracks_of_frame(const SonarObstacles& obstacles, const VehiclePose& pose,
                     Tracks& out) noexcept;

// The same obstacle, seen in the world.
[[nodiscard]] Obstacle to_world(const VehiclePose& pose, const Obstacle& in_vehicle) noexcept;

}  // namespace lodesman
