// SPDX-License-Identifier: Apache-2.0
// The line of a leg that is kept to: where it is left, and where gone back to, because of what lies
// on it. Pure functions with bounded work and no allocation; any thread.
#pragma once

#include "mid_level/geometry/leg.h"
#include "mid_level/messages/path.h"

namespace lodesman {

// How a leg is sailed from a place, as far ahead as it matters now: all along it, in
// [0, length_m()] and one after the other.
struct LineToKeep {
  double along_m = 0.0;     // abeam of the vehicle
  double leave_m = 0.0;     // the line is left here; along_m where the vehicle is not on it
  double rejoin_m = 0.0;    // and gone back to here
  bool is_clear = false;    // nothing lies on it, and the vehicle is close enough to sail by it
  bool goes_round = false;  // what lies on it, already
};

// What lies on the line is what has a zone in the request. `before`: what it came to last on this
// leg, so that what is gone round stays in mind even where the way round leads back; at first {}.
[[nodiscard]] LineToKeep line_to_keep(const Leg& leg, const PathRequest& zones,
                                      const Eigen::Vector2d& own_W,
                                      const LineToKeep& before) noexcept;

}  // namespace lodesman
