// SPDX-License-Identifier: Apache-2.0
// What must hold of every answer of TangentPath, and shapes to ask it about.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "low_level/path/clearance.h"
#include "low_level/path/tangent_path.h"
#include "low_level/path/zone.h"

namespace lodesman::testing {

using Zones = std::vector<ZonePx>;

[[nodiscard]] EllipsePx disc_px(double column, double row, double radius);
[[nodiscard]] WallPx wall_px(std::initializer_list<PointPx> vertices, double radius,
                             bool closed = false);

// The shape's equation, sampled along the path: shares no code with clearance.h.
[[nodiscard]] bool holds_point(const ZonePx& zone, PointPx point);

// The path leads from start to goal, is as long as is said, lies in the region, and touches no
// zone, by clearance.h and at points close together.
void require_sound(const TangentResult& result, std::span<const ZonePx> zones,
                   const RegionPx& region, PointPx start, PointPx goal);

// Larger shapes: their inscribed_bound() is no less than what the search answers exactly.
[[nodiscard]] Zones grown_by_polygons(std::span<const ZonePx> zones);

}  // namespace lodesman::testing
