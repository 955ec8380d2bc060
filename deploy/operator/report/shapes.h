// SPDX-License-Identifier: Apache-2.0
// Outlines of obstacles, zones and circles as lines to draw. Pure functions; any thread.
#pragma once

#include <vector>

#include "deploy/operator/report/plot_script.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman::cli {

[[nodiscard]] Line circle(Point centre, double radius);

// One line: closed for an ellipse and a polygon, open for a polyline; empty without vertices.
[[nodiscard]] Line outline(const Obstacle& obstacle);

[[nodiscard]] bool has_zone(const Obstacle& obstacle);

// Closed shapes whose union is the protection zone: for a wall, one a side and one a corner.
[[nodiscard]] std::vector<Line> zone_shapes(const Obstacle& obstacle);

}  // namespace lodesman::cli
