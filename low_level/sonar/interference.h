// SPDX-License-Identifier: Apache-2.0
// Stripes along one bearing: electrical interference, not an object, as no surface is lit from the
// head to the edge of the view. A pure function on its caller's plane; any thread; allocates
// nothing.
#pragma once

#include <cstdint>

#include "low_level/sonar/echo_plane.h"
#include "low_level/sonar/range_levels.h"

namespace lodesman {

struct StripeOptions {
  double fraction;          // [-] (0, 1] of a beam's cells that are bright, from which on it is one
  std::uint32_t max_beams;  // [-] wider ones are left alone: hiding them could hide a wall
};

// A stripe's beams take the mean of the beams beside them, or their own excess over their own usual
// level where that is more, so that an obstacle wider than the stripe or much brighter is still
// seen. Whether there was one.
[[nodiscard]] bool mend_stripes(EchoPlane& plane, const RangeLevels& levels, std::uint32_t nearest,
                                const StripeOptions& options) noexcept;

}  // namespace lodesman
