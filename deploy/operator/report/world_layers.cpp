// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/world_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "deploy/operator/report/shapes.h"

namespace lodesman::cli {
namespace {

using Rgb = std::array<double, 3>;

constexpr Rgb kPaleBlue{0xd3, 0xe6, 0xf4};
constexpr Rgb kBlue{0x00, 0x5f, 0x99};
constexpr Rgb kPaleRed{0xf9, 0xdb, 0xd3};
constexpr Rgb kRed{0xcc, 0x33, 0x11};

std::string mixed(const Rgb& pale, const Rgb& full, double shade) {
  std::array<char, 8> text{};
  std::array<unsigned, 3> mix{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = pale[i] + (full[i] - pale[i]) * std::clamp(shade, 0.0, 1.0);
    mix[i] = static_cast<unsigned>(std::lround(part)) & 0xffU;
  }
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", mix[0], mix[1], mix[2]);
  return text.data();
}

std::string filled(const std::string& colour) {
  return "with filledcurves closed fs solid noborder fc rgb '" + colour + "'";
}

std::string lines(const std::string& colour, double width) {
  return "with lines dt solid lc rgb '" + colour + "' lw " + std::to_string(width);
}

std::vector<Line> circles(const Line& centres, double radius) {
  std::vector<Line> all;
  for (const Point& centre : centres) {
    all.push_back(circle(centre, radius));
  }
  return all;
}

}  // namespace

std::string vehicle_colour(double shade) { return mixed(kPaleBlue, kBlue, shade); }
std::string obstacle_colour(double shade) { return mixed(kPaleRed, kRed, shade); }

void add_zones(PlotScript& script, const std::vector<Obstacle>& obstacles) {
  std::vector<Line> shapes;
  for (const Obstacle& obstacle : obstacles) {
    const std::vector<Line> of_one = zone_shapes(obstacle);
    shapes.insert(shapes.end(), of_one.begin(), of_one.end());
  }
  // Every border below every filling: only the border of their union stays in sight.
  script.layer(shapes, lines("#6fb58a", 3.0));
  script.layer(shapes, filled("#dcf2dc"));
}

void add_obstacle(PlotScript& script, const Obstacle& obstacle, double shade) {
  const std::vector<Line> shape{outline(obstacle)};
  const std::string colour = obstacle_colour(shade);
  if (obstacle.shape == ObstacleShape::kPolyline) {
    script.layer(shape, lines(colour, 4.0));
    return;
  }
  script.layer(shape, filled(colour));
  script.layer(shape, lines(obstacle_colour(shade < 1.0 ? 0.6 : 1.0), 1.0));
}

void add_vehicle(PlotScript& script, Point centre, double radius, double heading_deg,
                 double shade) {
  const std::vector<Line> hull{circle(centre, radius)};
  script.layer(hull, filled(vehicle_colour(shade)));
  script.layer(hull, lines(vehicle_colour(shade < 1.0 ? 0.7 : 1.0), 1.0));
  const double heading_rad = heading_deg * std::numbers::pi / 180.0;
  const Point bow{centre[0] + radius * std::sin(heading_rad),
                  centre[1] + radius * std::cos(heading_rad)};
  script.layer({{centre, bow}}, lines(shade < 0.5 ? vehicle_colour(1.0) : "#ffffff", 1.5));
}

void add_path(PlotScript& script, const Line& path) {
  // Yellow alone is faint on white and on green.
  script.layer({path}, lines("#6b6100", 5.0));
  script.layer({path}, lines("#ffe81a", 3.2));
}

void add_current_waypoints(PlotScript& script, const Line& centres, double radius) {
  script.layer(circles(centres, radius), lines("#00805c", 1.8));
}

void add_previous_waypoints(PlotScript& script, const Line& centres, double radius) {
  script.layer(circles(centres, radius), "with lines dt (5,3) lc rgb '#b8338a' lw 1.8");
}

void add_trajectory(PlotScript& script, const Line& line) {
  script.layer({line}, lines("#0072b2", 2.0));
}

void add_estimated_trajectory(PlotScript& script, const Line& line) {
  script.layer({line}, "with lines dt (8,5) lc rgb '#555555' lw 1.5");
}

void add_start(PlotScript& script, Point at) {
  script.layer({{at}}, "with points pt 5 ps 1.3 lc rgb '#000000'");
}

void add_goal(PlotScript& script, Point at, double radius) {
  script.layer({circle(at, radius)}, "with lines dt (2,3) lc rgb '#000000' lw 1.5");
  script.layer({{at}}, "with points pt 2 ps 1.2 lc rgb '#000000' lw 2.5");
}

}  // namespace lodesman::cli
