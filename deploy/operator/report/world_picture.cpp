// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "deploy/operator/report/gnuplot.h"
#include "deploy/operator/report/numbers.h"
#include "deploy/operator/report/plots.h"
#include "deploy/operator/report/shapes.h"
#include "deploy/operator/report/titles.h"
#include "deploy/operator/report/world_layers.h"
#include "deploy/operator/report/world_legend.h"
#include "deploy/operator/report/world_story.h"

namespace lodesman::cli {
namespace {

constexpr int kWidth_px = 1200;
constexpr double kLeft_px = 84.0;  // room of the Y axis' numbers and name
constexpr double kRight_px = 18.0;
constexpr double kGap_px = 22.0;      // between panels side by side
constexpr double kTitle_px = 40.0;    // of the picture
constexpr double kCaption_px = 44.0;  // above each panel: two lines
constexpr double kAxis_px = 34.0;     // below each panel: the numbers of the X axis
constexpr double kAxisName_px = 24.0;
constexpr double kLabels_px = 18.0;         // inside each panel, left and right: times
constexpr double kPanelsHeight_px = 780.0;  // all rows of panels, without their captions

constexpr double kLabelGap_m = 0.15;

// Where the panels lie: equal aspect, so one scale for all.
struct Layout {
  int columns = 1;
  int rows = 1;
  double px_per_m = 0.0;
  double panel_width_px = 0.0;
  double panel_height_px = 0.0;

  [[nodiscard]] double row_pitch_px() const { return kCaption_px + panel_height_px + kAxis_px; }
};

Layout layout_of(const ViewBox& box, int panels) {
  const double width_m = box.high[0] - box.low[0];
  const double height_m = box.high[1] - box.low[1];
  Layout best;
  for (int columns = 1; columns <= panels; ++columns) {
    Layout layout;
    layout.columns = columns;
    layout.rows = (panels + columns - 1) / columns;
    layout.panel_width_px = (kWidth_px - kLeft_px - kRight_px - (columns - 1) * kGap_px) / columns;
    layout.px_per_m = std::min((layout.panel_width_px - 2.0 * kLabels_px) / width_m,
                               kPanelsHeight_px / layout.rows / height_m);
    layout.panel_height_px = height_m * layout.px_per_m;
    if (layout.px_per_m > best.px_per_m) {
      best = layout;
    }
  }
  return best;
}

// 1, 2 or 5 times a power of ten, the next one up.
double nice_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(std::max(least, 1e-6))));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (least <= factor * power) {
      return factor * power;
    }
  }
  return 10.0 * power;
}

// [s] between the pale vehicles of the past: a few metres, and not more than about ten of them.
double ghost_step_s(const RunRecord& record) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < record.trajectory.size(); ++i) {
    length_m += std::hypot(record.trajectory[i].x_m - record.trajectory[i - 1].x_m,
                           record.trajectory[i].y_m - record.trajectory[i - 1].y_m);
  }
  if (!(length_m > record.vehicle_radius_m)) {
    return 0.0;
  }
  const double apart_m = std::max({2.0, 3.0 * record.vehicle_radius_m, length_m / 11.0});
  return nice_step(record.trajectory.back().t_s * apart_m / length_m);
}

std::vector<double> ghost_times_s(double step_s, double until_s) {
  std::vector<double> times_s;
  for (int i = 0; step_s > 0.0 && i * step_s < until_s - 0.4 * step_s; ++i) {
    times_s.push_back(i * step_s);
  }
  return times_s;
}

// Where a time is written: abeam of the vehicle, on the side away from what it avoids.
Point away_from_obstacles(const RunRecord& record, const TrajectoryRow& row) {
  const double heading_rad = row.heading_deg * std::numbers::pi / 180.0;
  const Point starboard{std::cos(heading_rad), -std::sin(heading_rad)};
  double nearest_m = std::numeric_limits<double>::infinity();
  double side = 1.0;
  for (const MovingObstacle& obstacle : record.obstacles) {
    if (!obstacle.exists(row.t_s)) {
      continue;
    }
    for (const Point& point : outline(obstacle.at(row.t_s))) {
      const Point to{point[0] - row.x_m, point[1] - row.y_m};
      const double distance_m = std::hypot(to[0], to[1]);
      if (distance_m < nearest_m) {
        nearest_m = distance_m;
        side = to[0] * starboard[0] + to[1] * starboard[1] > 0.0 ? -1.0 : 1.0;
      }
    }
  }
  return {side * starboard[0], side * starboard[1]};
}

// `towards`: a direction of length 1 from `centre`.
void add_time_label(PlotScript& script, Point centre, Point towards, double distance_m, double t_s,
                    const std::string& colour) {
  const char* anchor = towards[0] > 0.3 ? " left" : towards[0] < -0.3 ? " right" : " center";
  const bool is_whole = std::abs(t_s - std::round(t_s)) < 1e-6;
  script.command("set label " + plot_text(fixed(t_s, is_whole ? 0 : 1) + " s") + " at " +
                 fixed(centre[0] + towards[0] * distance_m, 3) + ',' +
                 fixed(centre[1] + towards[1] * distance_m, 3) + anchor + " offset 0," +
                 fixed(0.5 * towards[1], 2) + " front font 'Sans,10' tc rgb '" + colour + "'");
}

void add_moving_ghosts(PlotScript& script, const RunRecord& record, double t_s, double until_s,
                       bool is_labelled) {
  for (const MovingObstacle& obstacle : record.obstacles) {
    if (!moves(obstacle) || !obstacle.exists(t_s) || t_s > obstacle.stops_at_s) {
      continue;
    }
    const Obstacle then = obstacle.at(t_s);
    add_obstacle(script, then, 0.8 * t_s / until_s);
    const TrajectoryRow* row = row_at(record.trajectory, t_s);
    const Line shape = outline(then);
    if (is_labelled && row != nullptr && !shape.empty()) {
      const auto [west, east] = std::minmax_element(
          shape.begin(), shape.end(), [](const Point& a, const Point& b) { return a[0] < b[0]; });
      const double middle_m = ((*west)[0] + (*east)[0]) / 2.0;
      const double side = row->x_m < middle_m ? 1.0 : -1.0;
      add_time_label(script, {middle_m, (*west)[1]}, {side, 0.0},
                     ((*east)[0] - (*west)[0]) / 2.0 + kLabelGap_m, t_s, obstacle_colour(1.0));
    }
  }
}

void add_obstacles(PlotScript& script, const RunRecord& record, const Moment& moment,
                   double step_s) {
  std::vector<Obstacle> there;
  for (const MovingObstacle& obstacle : record.obstacles) {
    if (obstacle.exists(moment.t_s)) {
      there.push_back(obstacle.at(moment.t_s));
    }
  }
  add_zones(script, there);
  for (const double t_s : ghost_times_s(step_s, moment.t_s)) {
    add_moving_ghosts(script, record, t_s, moment.t_s, moment.is_end);
  }
  for (const Obstacle& obstacle : there) {
    add_obstacle(script, obstacle, 1.0);
  }
}

void add_plan(PlotScript& script, const RunRecord& record, const Moment& moment) {
  const double radius_m = record.waypoint_radius_m;
  if (moment.last_found != nullptr) {
    add_path(script, moment.last_found->path_m);
  }
  if (moment.replaced != nullptr) {
    add_previous_waypoints(script, moment.replaced->waypoints_m, radius_m);
  }
  if (moment.plan == nullptr) {
    return;
  }
  if (moment.plan->waypoint_source == "previous") {
    add_previous_waypoints(script, moment.plan->waypoints_m, radius_m);
  } else {
    add_current_waypoints(script, moment.plan->waypoints_m, radius_m);
  }
}

void add_tracks(PlotScript& script, const RunRecord& record, const Moment& moment,
                bool shows_estimate) {
  Line track;
  Line estimate;
  for (const TrajectoryRow& row : record.trajectory) {
    if (row.t_s <= moment.t_s + 1e-6) {
      track.push_back({row.x_m, row.y_m});
      estimate.push_back({row.estimate_x_m, row.estimate_y_m});
    }
  }
  if (shows_estimate) {
    add_estimated_trajectory(script, estimate);
  }
  add_trajectory(script, track);
}

void add_vehicle_ghosts(PlotScript& script, const RunRecord& record, const Moment& moment,
                        double step_s) {
  const double radius_m = record.vehicle_radius_m;
  for (const double t_s : ghost_times_s(step_s, moment.t_s)) {
    const TrajectoryRow& row = *row_at(record.trajectory, t_s);
    const Point at{row.x_m, row.y_m};
    add_vehicle(script, at, radius_m, row.heading_deg, 0.8 * t_s / moment.t_s);
    if (moment.is_end && t_s > 0.0) {
      add_time_label(script, at, away_from_obstacles(record, row), radius_m + kLabelGap_m, t_s,
                     vehicle_colour(1.0));
    }
  }
}

void add_panel(PlotScript& script, const RunRecord& record, const Moment& moment, double step_s,
               bool shows_estimate) {
  add_obstacles(script, record, moment, step_s);
  add_plan(script, record, moment);
  add_tracks(script, record, moment, shows_estimate);
  add_vehicle_ghosts(script, record, moment, step_s);
  add_start(script, record.start_m);
  add_goal(script, record.goal_m, record.goal_radius_m);
  if (const TrajectoryRow* row = row_at(record.trajectory, moment.t_s)) {
    add_vehicle(script, {row->x_m, row->y_m}, record.vehicle_radius_m, row->heading_deg, 1.0);
  }
  script.plot();
}

void set_panel(PlotScript& script, const ViewBox& box, const Layout& layout, int index, int panels,
               int height_px) {
  const int column = index % layout.columns;
  const int row = index / layout.columns;
  const double left = kLeft_px + column * (layout.panel_width_px + kGap_px);
  const double top = kTitle_px + row * layout.row_pitch_px() + kCaption_px;
  const auto x_part = [](double px) { return fixed(px / kWidth_px, 6); };
  const auto y_part = [&](double px) { return fixed(1.0 - px / height_px, 6); };
  script.command("set lmargin at screen " + x_part(left));
  script.command("set rmargin at screen " + x_part(left + layout.panel_width_px));
  script.command("set tmargin at screen " + y_part(top));
  script.command("set bmargin at screen " + y_part(top + layout.panel_height_px));
  const double middle_m = (box.low[0] + box.high[0]) / 2.0;
  const double half_m = layout.panel_width_px / layout.px_per_m / 2.0;
  script.command("set xrange [" + fixed(middle_m - half_m, 4) + ":" + fixed(middle_m + half_m, 4) +
                 "]; set yrange [" + fixed(box.low[1], 4) + ":" + fixed(box.high[1], 4) + "]");
  const std::string step = fixed(nice_step(42.0 / layout.px_per_m), 6);
  script.command("set xtics " + step + "; set ytics " + step);
  script.command(column == 0 ? "set format y '%g'; set ylabel 'Y [m]' offset 0.5"
                             : "set format y ''; unset ylabel");
  const bool is_lowest = index + layout.columns >= panels;
  script.command(is_lowest ? "set xlabel 'X [m]' offset 0,0.4" : "unset xlabel");
}

void set_caption(PlotScript& script, const Moment& moment, int index) {
  const std::string letter(1, static_cast<char>('a' + index));
  script.command("unset label");
  script.command("set label " + plot_text("(" + letter + ")  " + fixed(moment.t_s, 1) + " s") +
                 " at graph 0,1 offset char 0.2,1.75 left font 'Sans Bold,13'");
  script.command("set label " + plot_text(moment.caption) +
                 " at graph 0,1 offset char 0.2,0.65 left font 'Sans,12'");
}

}  // namespace

void draw_world(const std::filesystem::path& png, const RunRecord& record) {
  const std::vector<Moment> moments = story(record);
  const ViewBox box = view_box(record, moments);
  const Layout layout = layout_of(box, static_cast<int>(moments.size()));
  const double step_s = ghost_step_s(record);
  const LegendNeeds needs = legend_needs(record, moments);
  const int panels_px =
      static_cast<int>(std::ceil(kTitle_px + layout.rows * layout.row_pitch_px() + kAxisName_px));
  const int height_px = panels_px + legend_height_px(needs);

  PlotScript script;
  script.command("set multiplot; unset key; set border lc rgb '#444444'");
  script.command("set tics nomirror; set grid back lt 1 lc rgb '#e4e4e4' lw 1; set format x '%g'");
  for (int i = 0; i < static_cast<int>(moments.size()); ++i) {
    const Moment& moment = moments[static_cast<std::size_t>(i)];
    set_panel(script, box, layout, i, static_cast<int>(moments.size()), height_px);
    set_caption(script, moment, i);
    if (i == 0) {
      script.command("set label " + plot_text(picture_title(record.result)) + " at screen 0.5," +
                     fixed(1.0 - 0.55 * kTitle_px / height_px, 6) + " center font 'Sans Bold,15'");
    }
    add_panel(script, record, moment, step_s, needs.estimate);
  }
  script.command("unset label");
  add_legend(script, needs, kWidth_px, height_px);
  script.command("unset multiplot");
  draw_picture(png, {.width_px = kWidth_px, .height_px = height_px}, script.text());
}

}  // namespace lodesman::cli
