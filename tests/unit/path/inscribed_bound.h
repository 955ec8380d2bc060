// SPDX-License-Identifier: Apache-2.0
// A lower bound of the length of every path among zones: the shortest path among polygons inscribed
// in them, by brute force. Shares only the zones' own structs with what it is a check of.
#pragma once

#include <optional>
#include <span>

#include "low_level/path/clearance.h"
#include "low_level/path/zone.h"

namespace lodesman::testing {

// Nothing where even the polygons leave no path. A polygon has 64 corners on the edge of an
// ellipse, or of each edge of a wall, so the bound is too low by less than 0.05 % of the arcs.
[[nodiscard]] std::optional<double> inscribed_bound(std::span<const ZonePx> zones,
                                                    const RegionPx& region, PointPx start,
                                                    PointPx goal);

}  // namespace lodesman::testing
