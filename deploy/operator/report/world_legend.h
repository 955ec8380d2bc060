// SPDX-License-Identifier: Apache-2.0
// The legend below the panels of the world picture: a strip with a sample of everything that
// some panel shows. Pure functions but for the script they add to; any one thread.
#pragma once

#include <vector>

#include "deploy/operator/report/plot_script.h"
#include "deploy/operator/report/world_story.h"

namespace lodesman::cli {

// What some panel shows beyond the vehicle, its track, start and goal.
struct LegendNeeds {
  bool obstacles = false;
  bool movers = false;
  bool zones = false;
  bool path = false;
  bool current_waypoints = false;
  bool previous_waypoints = false;
  bool truth = true;      // the track is true, else the boat's own estimate
  bool estimate = false;  // beside the true one
};

[[nodiscard]] LegendNeeds legend_needs(const RunRecord& record, const std::vector<Moment>& moments);

[[nodiscard]] int legend_height_px(const LegendNeeds& needs);

// A plot of its own on the lowest legend_height_px of a picture so wide, in pixels; every setting
// of a panel must be unset.
void add_legend(PlotScript& script, const LegendNeeds& needs, int width_px, int picture_height_px);

}  // namespace lodesman::cli
