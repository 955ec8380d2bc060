// SPDX-License-Identifier: Apache-2.0
// What a sonar's obstacle says of the thing that it is an echo of. A sonar hears the near side
// alone: of something compact the far side is taken to lie as far behind its middle as it is wide.
// Pure functions; any thread; nothing allocates.
#pragma once

#include "low_level/tracking/followed.h"
#include "mid_level/base/frames.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

// Small enough each way to be one thing that may move.
[[nodiscard]] bool is_compact(const Obstacle& in_head) noexcept;

// As an ellipse round its middle, one axis along the line of sight [odometry]; its doubt from the
// beam's width [rad], the range and its size.
[[nodiscard]] Sighting sighting_of(const Obstacle& in_head, const VehiclePose& head,
                                   double beam_width_rad) noexcept;

}  // namespace lodesman
