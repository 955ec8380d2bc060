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

// Whether it is the near side of a body, which goes on behind it: across the line of sight and no
// wider than a body is deep. What is longer, or seen along its side, is a wall.
[[nodiscard]] bool is_front(const Obstacle& in_head) noexcept;

// As an ellipse round its middle, one axis along the line of sight [odometry]; its doubt from the
// beam's width [rad], the range and its size. cut: which of its ends need not be its own.
[[nodiscard]] Sighting sighting_of(const Obstacle& in_head, const VehiclePose& head,
                                   double beam_width_rad, CutEnds cut = {}) noexcept;

// [m] Half of how deep a body so wide is taken to be.
[[nodiscard]] double half_depth_m(double half_across_m) noexcept;

// [m] [odometry] From the middle of what is seen to the middle of the whole, which is so much
// larger (half extents): to the side where it is cut, the other end stays where it is.
[[nodiscard]] Eigen::Vector2d to_the_rest_m(const Sighting& seen, double hidden_m,
                                            double deeper_m) noexcept;

// What is seen of something that is known to be so large across the line of sight: where an end is
// cut the rest lies beyond it, so that it does not seem to move as more or less of it is seen.
[[nodiscard]] Sighting completed(const Sighting& seen, double half_across_m) noexcept;

}  // namespace lodesman
