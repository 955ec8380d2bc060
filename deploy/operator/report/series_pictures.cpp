// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "deploy/operator/report/gnuplot.h"
#include "deploy/operator/report/numbers.h"
#include "deploy/operator/report/plot_script.h"
#include "deploy/operator/report/plots.h"
#include "deploy/operator/report/titles.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

using Rows = std::vector<TrajectoryRow>;

constexpr const char* kBlue = "#005f99";
constexpr const char* kOrange = "#e69f00";
constexpr const char* kRed = "#cc3311";

std::string line_style(const std::string& dash, const std::string& colour, const std::string& lw) {
  return "with lines dt " + dash + " lc rgb '" + colour + "' lw " + lw;
}

template <class Value>
Line series(const Rows& rows, Value&& value) {
  Line line;
  for (const TrajectoryRow& row : rows) {
    line.push_back({row.t_s, value(row)});
  }
  return line;
}

// A command holds from one row to the next.
template <class Value>
Line steps(const Rows& rows, Value&& value) {
  Line line;
  for (const TrajectoryRow& row : rows) {
    if (!line.empty()) {
      line.push_back({row.t_s, line.back()[1]});
    }
    line.push_back({row.t_s, value(row)});
  }
  return line;
}

struct Range {
  double low = 0.0;
  double high = 1.0;
};

Range time_range(const Rows& rows) {
  const double first_s = rows.empty() ? 0.0 : rows.front().t_s;
  const double last_s = rows.empty() ? 1.0 : rows.back().t_s;
  return {first_s, std::max(last_s, first_s + 1.0)};
}

// Of the finite values, with a margin; never narrower than `narrowest`.
Range value_range(const Line& line, Range range, double narrowest) {
  for (const Point& point : line) {
    if (std::isfinite(point[1])) {
      range.low = std::min(range.low, point[1]);
      range.high = std::max(range.high, point[1]);
    }
  }
  const double missing = std::max(0.0, narrowest - (range.high - range.low)) / 2.0;
  const double margin = 0.08 * (range.high - range.low) + missing;
  return {range.low - margin, range.high + margin};
}

std::string range_text(const Range& range) {
  return "[" + fixed(range.low, 4) + ":" + fixed(range.high, 4) + "]";
}

// The times in which the newest plan had found no path, as boxes over all of `height`.
std::vector<Line> pathless_boxes(const Rows& rows, const Range& height) {
  std::vector<Line> boxes;
  std::optional<double> since_s;
  const auto close = [&](double until_s) {
    if (since_s) {
      boxes.push_back({{*since_s, height.low},
                       {until_s, height.low},
                       {until_s, height.high},
                       {*since_s, height.high},
                       {*since_s, height.low}});
      since_s.reset();
    }
  };
  for (const TrajectoryRow& row : rows) {
    if (row.path_found || row.plan_id == 0) {
      close(row.t_s);
    } else if (!since_s) {
      since_s = row.t_s;
    }
  }
  if (!rows.empty()) {
    close(rows.back().t_s);
  }
  return boxes;
}

void add_pathless(PlotScript& script, const Rows& rows, const Range& height, bool in_legend) {
  const std::vector<Line> boxes = pathless_boxes(rows, height);
  if (!boxes.empty()) {
    script.layer(boxes,
                 "with filledcurves closed fs transparent solid 0.22 noborder fc rgb '#555555'",
                 in_legend ? "no path found" : "");
  }
}

PlotScript started(const RunRecord& record) {
  PlotScript script;
  script.command("set title " + plot_text(picture_title(record.result)) +
                 " font 'Sans Bold,15' offset 0,-0.2");
  script.command("set border lc rgb '#444444'; set tics nomirror; set format '%g'");
  script.command("set grid back lt 1 lc rgb '#e4e4e4' lw 1; set xlabel 'Time [s]' offset 0,0.3");
  script.command("set lmargin at screen 0.09; set rmargin at screen 0.975");
  script.command("set tmargin at screen 0.92; set bmargin at screen 0.19");
  script.command("set key at screen 0.5325,0.045 center center vertical Left reverse" +
                 std::string{" maxrows 1 samplen 3 width 1"});
  script.command("set xrange " + range_text(time_range(record.trajectory)));
  return script;
}

// Continuous where the heading passes north, and near 0 at the start.
Line unwrapped_heading(const Rows& rows) {
  Line line = series(rows, [](const TrajectoryRow& row) { return row.heading_deg; });
  double before_deg = 0.0;
  for (Point& point : line) {
    point[1] = before_deg + std::remainder(point[1] - before_deg, 360.0);
    before_deg = std::isfinite(point[1]) ? point[1] : before_deg;
  }
  return line;
}

void add_minimum(PlotScript& script, const RunResult& result, const Range& times) {
  if (!result.min_inoffensive_distance_m || !result.time_of_min_inoffensive_distance_s) {
    return;
  }
  const double t_s = *result.time_of_min_inoffensive_distance_s;
  const double id_m = *result.min_inoffensive_distance_m;
  script.layer({{{t_s, id_m}}}, std::string{"with points pt 7 ps 1.6 lc rgb '"} + kRed + "'",
               "minimum");
  const bool is_late = t_s > (times.low + times.high) / 2.0;
  script.command("set label " + plot_text(fixed(id_m, 2) + " m at " + fixed(t_s, 1) + " s") +
                 " at " + fixed(t_s, 4) + ',' + fixed(id_m, 4) + (is_late ? " right" : " left") +
                 " offset char " + (is_late ? "-1.2" : "1.2") + ",-0.9 front font 'Sans Bold,13'");
}

}  // namespace

void draw_inoffensive_distance(const std::filesystem::path& png, const RunRecord& record) {
  const Rows& rows = record.trajectory;
  const Line id = series(rows, [](const TrajectoryRow& row) { return row.id_m; });
  const Range times = time_range(rows);
  const Range height = value_range(id, {.low = 0.0, .high = 1.0}, 2.0);
  PlotScript script = started(record);
  script.command("set ylabel 'Inoffensive distance (ID) [m]'; set yrange " + range_text(height));
  if (std::none_of(id.begin(), id.end(), [](const Point& p) { return std::isfinite(p[1]); })) {
    script.command("set label 'no obstacle in this run' at graph 0.5,0.5 center");
  }
  add_pathless(script, rows, height, true);
  script.layer({{{times.low, 0.0}, {times.high, 0.0}}}, line_style("(10,6)", kRed, "2"),
               "collision (ID = 0)");
  script.layer({id}, line_style("solid", kBlue, "2.5"), "inoffensive distance");
  add_minimum(script, record.result, times);
  script.plot();
  draw_picture(png, {}, script.text());
}

void draw_heading(const std::filesystem::path& png, const RunRecord& record) {
  const Rows& rows = record.trajectory;
  const Line heading = unwrapped_heading(rows);
  const Line head_ref =
      steps(rows, [](const TrajectoryRow& row) { return static_cast<double>(row.head_ref); });
  const double first_deg = heading.empty() ? 0.0 : heading.front()[1];
  const Range heading_range = value_range(heading, {first_deg, first_deg}, 20.0);
  const Range reference_range{-105.0, 105.0};
  PlotScript script = started(record);
  script.command("set multiplot");
  script.command("set tmargin at screen 0.92; set bmargin at screen 0.50");
  script.command("set ylabel 'True heading [deg]'; set yrange " + range_text(heading_range));
  script.command("set format x ''; unset xlabel; set key off");
  add_pathless(script, rows, heading_range, false);
  script.layer({heading}, line_style("solid", kBlue, "2.5"));
  script.plot();
  script.command("unset title; set format x '%g'; set xlabel 'Time [s]' offset 0,0.3; set key on");
  script.command("set tmargin at screen 0.45; set bmargin at screen 0.19");
  script.command("set ylabel 'HeadRef [-]'; set ytics 50; set yrange " +
                 range_text(reference_range));
  add_pathless(script, rows, reference_range, true);
  script.layer({}, line_style("solid", kBlue, "2.5"), "true heading, clockwise from Y");
  script.layer({head_ref}, line_style("solid", kOrange, "2"), "heading reference (HeadRef)");
  script.plot();
  script.command("unset multiplot");
  draw_picture(png, {.width_px = 1200, .height_px = 700}, script.text());
}

void draw_thrust(const std::filesystem::path& png, const RunRecord& record) {
  const Rows& rows = record.trajectory;
  const auto left = [](const TrajectoryRow& row) { return static_cast<double>(row.thrust_left); };
  const auto right = [](const TrajectoryRow& row) { return static_cast<double>(row.thrust_right); };
  const Range times = time_range(rows);
  constexpr double kStop = 127.5;  // both 127 and 128 stop the propeller
  PlotScript script = started(record);
  script.command("set ylabel 'Thrust command [0-255]'; set yrange [0:260]");
  script.command("set ytics (0, 32, 64, 96, 127.5, 160, 192, 224, 255)");
  script.layer({{{times.low, kStop}, {times.high, kStop}}}, line_style("(10,6)", "#666666", "1.5"),
               "stop (127.5)");
  script.layer({steps(rows, left)}, line_style("solid", kOrange, "4"), "left thruster");
  script.layer({steps(rows, right)}, line_style("solid", kBlue, "1.8"), "right thruster");
  script.plot();
  draw_picture(png, {}, script.text());
}

void draw_pictures(const std::filesystem::path& directory, const RunRecord& record) {
  using Draw = void (*)(const std::filesystem::path&, const RunRecord&);
  std::string fault;
  for (const auto& [draw, name] : std::initializer_list<std::pair<Draw, const char*>>{
           {draw_world, "world.png"},
           {draw_inoffensive_distance, "inoffensive_distance.png"},
           {draw_heading, "heading.png"},
           {draw_thrust, "thrust.png"}}) {
    try {
      draw(directory / name, record);
    } catch (const StartupError& error) {
      fault = fault.empty() ? error.what() : fault;
    }
  }
  if (!fault.empty()) {
    throw StartupError(fault);
  }
}

}  // namespace lodesman::cli
