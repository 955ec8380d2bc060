// SPDX-License-Identifier: Apache-2.0
// How each thing of the world picture looks, said once for its panels and its legend: the paper's
// colours, in shades and line styles that a colour-blind reader can tell apart. Pure functions
// but for the script they add to; any one thread.
#pragma once

#include <string>
#include <vector>

#include "deploy/operator/report/plot_script.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman::cli {

// "#rrggbb"; shade 0 is the palest (longest ago), 1 the full colour (now).
[[nodiscard]] std::string vehicle_colour(double shade);
[[nodiscard]] std::string obstacle_colour(double shade);

void add_zones(PlotScript& script, const std::vector<Obstacle>& obstacles);
void add_obstacle(PlotScript& script, const Obstacle& obstacle, double shade);
void add_vehicle(PlotScript& script, Point centre, double radius, double heading_deg, double shade);
void add_path(PlotScript& script, const Line& path);
void add_current_waypoints(PlotScript& script, const Line& centres, double radius);
void add_previous_waypoints(PlotScript& script, const Line& centres, double radius);
void add_trajectory(PlotScript& script, const Line& line);
void add_estimated_trajectory(PlotScript& script, const Line& line);
void add_start(PlotScript& script, Point at);
void add_goal(PlotScript& script, Point at, double radius);

}  // namespace lodesman::cli
