// SPDX-License-Identifier: Apache-2.0
// How a vehicle that turns on arcs no tighter than a radius can sail a path of straight legs. Plain
// values and pure functions; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "low_level/path/clearance.h"
#include "low_level/path/zone.h"

namespace lodesman {

// The arc that touches both legs at a corner.
struct Fillet {
  double turn_rad = 0.0;  // [-pi, pi] positive: clockwise in the view, to starboard
  double begin_px = 0.0;  // along the legs: from the arc's begin to the corner, and on to its end
  double swing_px = 0.0;  // how far beyond the next leg it goes if it turns only at the corner
};
[[nodiscard]] Fillet fillet_of(PointPx before, PointPx corner, PointPx after,
                               double radius_px) noexcept;

// One arc in place of one corner, or of several to the same side that are too close together for
// an arc each. These are replaced by the point where the legs before and after them meet.
struct Turn {
  std::uint32_t first = 0;  // the corners it stands for, as places in the path
  std::uint32_t last = 0;
  PointPx begin;
  PointPx end;
  Fillet fillet;
  // The legs have room for the arc, and arc and legs are clear of every zone and in the region.
  // Where not, begin and end are the corners themselves, and the vehicle swings wide or must slow.
  bool possible = false;
};

// The turns of a path in their order; those for which `turns` has no room are left away. Gives how
// many were written. An arc is tested by the chords and tangents between which it lies, at most
// kClearancePx apart.
[[nodiscard]] std::size_t find_turns(std::span<const PointPx> path, double radius_px,
                                     std::span<const ZonePx> zones, const RegionPx& region,
                                     std::span<Turn> turns) noexcept;

}  // namespace lodesman
