// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/world_legend.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "deploy/operator/report/numbers.h"
#include "deploy/operator/report/shapes.h"
#include "deploy/operator/report/world_layers.h"

namespace lodesman::cli {
namespace {

constexpr int kMaxColumns = 4;
constexpr int kRowHeight_px = 27;
constexpr int kPadding_px = 8;
constexpr double kInset_px = 30.0;
constexpr double kRadius_px = 9.0;
constexpr double kHalfLine_px = 17.0;
constexpr double kEstimateShown_m = 0.2;  // an estimate that stays closer is no second line

struct Entry {
  std::string label;
  std::function<void(PlotScript&, Point)> sample;  // drawn about that point
};

Obstacle round_obstacle(Point at, double radius, double zone) {
  Obstacle obstacle;
  obstacle.centre_x_m = at[0];
  obstacle.centre_y_m = at[1];
  obstacle.semi_axis_first_m = obstacle.semi_axis_second_m = radius;
  obstacle.protection_first_m = obstacle.protection_second_m = zone;
  return obstacle;
}

Line short_line(Point at) { return {{at[0] - kHalfLine_px, at[1]}, {at[0] + kHalfLine_px, at[1]}}; }

Point beside(Point at, double steps) { return {at[0] + steps * kRadius_px, at[1]}; }

void add_fading_vehicles(PlotScript& script, Point at) {
  add_vehicle(script, beside(at, -1.2), kRadius_px, 90.0, 0.1);
  add_vehicle(script, at, kRadius_px, 90.0, 0.5);
  add_vehicle(script, beside(at, 1.2), kRadius_px, 90.0, 1.0);
}

void add_fading_obstacles(PlotScript& script, Point at) {
  add_obstacle(script, round_obstacle(beside(at, -1.2), kRadius_px, 0.0), 0.1);
  add_obstacle(script, round_obstacle(at, kRadius_px, 0.0), 0.5);
  add_obstacle(script, round_obstacle(beside(at, 1.2), kRadius_px, 0.0), 1.0);
}

std::vector<Entry> obstacle_entries(const LegendNeeds& needs) {
  std::vector<Entry> entries;
  if (needs.movers) {
    entries.push_back({"moving obstacle, pale: earlier", add_fading_obstacles});
  } else if (needs.obstacles) {
    entries.push_back({"obstacle", [](PlotScript& script, Point at) {
                         add_obstacle(script, round_obstacle(at, kRadius_px, 0.0), 1.0);
                       }});
  }
  if (needs.zones) {
    entries.push_back({"protection zone", [](PlotScript& script, Point at) {
                         add_zones(script, {round_obstacle(at, 0.0, kRadius_px)});
                       }});
  }
  return entries;
}

std::vector<Entry> plan_entries(const LegendNeeds& needs) {
  std::vector<Entry> entries;
  if (needs.path) {
    entries.push_back({"path of the last plan found",
                       [](PlotScript& script, Point at) { add_path(script, short_line(at)); }});
  }
  if (needs.current_waypoints) {
    entries.push_back({"current waypoints", [](PlotScript& script, Point at) {
                         add_current_waypoints(script, {at}, kRadius_px);
                       }});
  }
  if (needs.previous_waypoints) {
    entries.push_back({"previous waypoints", [](PlotScript& script, Point at) {
                         add_previous_waypoints(script, {at}, kRadius_px);
                       }});
  }
  return entries;
}

std::vector<Entry> entries_for(const LegendNeeds& needs) {
  std::vector<Entry> entries{
      {"vehicle, pale: earlier", add_fading_vehicles},
      {needs.truth ? "trajectory (true)" : "trajectory as estimated",
       [](PlotScript& script, Point at) { add_trajectory(script, short_line(at)); }}};
  if (needs.estimate) {
    entries.push_back({"trajectory as estimated", [](PlotScript& script, Point at) {
                         add_estimated_trajectory(script, short_line(at));
                       }});
  }
  for (const auto& more : {obstacle_entries(needs), plan_entries(needs)}) {
    entries.insert(entries.end(), more.begin(), more.end());
  }
  entries.push_back({"start", add_start});
  entries.push_back({"goal and its radius",
                     [](PlotScript& script, Point at) { add_goal(script, at, kRadius_px); }});
  return entries;
}

int rows_of(std::size_t entries) {
  return (static_cast<int>(entries) + kMaxColumns - 1) / kMaxColumns;
}

}  // namespace

LegendNeeds legend_needs(const RunRecord& record, const std::vector<Moment>& moments) {
  LegendNeeds needs;
  for (const MovingObstacle& obstacle : record.obstacles) {
    needs.movers = needs.movers || moves(obstacle);
    for (const Moment& moment : moments) {
      const bool exists = obstacle.exists(moment.t_s);
      needs.obstacles = needs.obstacles || exists;
      needs.zones = needs.zones || (exists && has_zone(obstacle.at_start));
    }
  }
  for (const Moment& moment : moments) {
    const bool has_waypoints = moment.plan != nullptr && !moment.plan->waypoints_m.empty();
    const bool are_previous = has_waypoints && moment.plan->waypoint_source == "previous";
    needs.path = needs.path || moment.last_found != nullptr;
    needs.current_waypoints = needs.current_waypoints || (has_waypoints && !are_previous);
    needs.previous_waypoints =
        needs.previous_waypoints || are_previous || moment.replaced != nullptr;
  }
  needs.truth = record.result.counted_from == CountedFrom::kTruth;
  needs.estimate =
      needs.truth &&
      std::any_of(record.trajectory.begin(), record.trajectory.end(), [](const TrajectoryRow& row) {
        return std::hypot(row.x_m - row.estimate_x_m, row.y_m - row.estimate_y_m) >
               kEstimateShown_m;
      });
  return needs;
}

int legend_height_px(const LegendNeeds& needs) {
  return rows_of(entries_for(needs).size()) * kRowHeight_px + 2 * kPadding_px;
}

void add_legend(PlotScript& script, const LegendNeeds& needs, int width_px, int picture_height_px) {
  const std::vector<Entry> entries = entries_for(needs);
  const int rows = rows_of(entries.size());
  const int columns = (static_cast<int>(entries.size()) + rows - 1) / rows;
  const int height_px = legend_height_px(needs);
  script.command("set lmargin at screen 0; set rmargin at screen 1; set bmargin at screen 0");
  script.command("set tmargin at screen " +
                 fixed(static_cast<double>(height_px) / picture_height_px, 6));
  script.command("unset border; unset tics; unset grid; unset xlabel; unset ylabel");
  script.command("set xrange [0:" + std::to_string(width_px) + "]");
  script.command("set yrange [0:" + std::to_string(height_px) + "]");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    // Down the columns, so that what belongs together stands together.
    const int column = static_cast<int>(i) / rows;
    const int row = static_cast<int>(i) % rows;
    const Point at{kInset_px + column * static_cast<double>(width_px - 20) / columns,
                   height_px - kPadding_px - (row + 0.5) * kRowHeight_px};
    entries[i].sample(script, at);
    script.command("set label " + plot_text(entries[i].label) + " at " + fixed(at[0] + 28.0, 1) +
                   ',' + fixed(at[1], 1) + " left front font 'Sans,12'");
  }
  script.plot();
}

}  // namespace lodesman::cli
