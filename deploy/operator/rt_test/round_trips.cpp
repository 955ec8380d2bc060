// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/round_trips.h"

#include <fmt/format.h>

#include <cmath>

namespace lodesman::cli {
namespace {

constexpr double kSpeed_m_s = 0.42;
constexpr double kLeg_m = 20.0;

struct Circle {
  double x_m;
  double y_m;
  double radius_m;
};
// On both sides of the way, and on it.
constexpr Circle kCircles[] = {
    {-1.5, 5.0, 0.3}, {1.5, 8.5, 0.5}, {-1.0, 12.0, 0.8}, {2.0, 15.5, 0.4}};

}  // namespace

std::string round_trips_scenario(double seconds) {
  // Nobody sails a leg in less.
  const int legs = static_cast<int>(std::ceil(seconds * kSpeed_m_s / kLeg_m)) + 2;
  std::string waypoints;
  for (int leg = 0; leg < legs; ++leg) {
    waypoints += fmt::format("{}[0.0, {:.1f}]", leg == 0 ? "" : ", ", leg % 2 == 0 ? kLeg_m : 0.0);
  }
  std::string text = fmt::format(
      "name = \"round-trips\"\nseed = 1\ntime_limit_s = {:.1f}\n[mission]\nstart_m = [0.0, 0.0]\n"
      "start_heading_deg = 0.0\nwaypoints_m = [{}]\ngoal_m = [0.0, {:.1f}]\ngoal_radius_m = 0.5\n"
      "[vehicle]\nspeed_m_s = {:.2f}\nradius_m = 0.5\n",
      3.0 * seconds + 300.0, waypoints, legs % 2 == 0 ? kLeg_m : 0.0, kSpeed_m_s);
  for (const Circle& circle : kCircles) {
    text += fmt::format(
        "[[obstacle]]\nshape = \"circle\"\ncentre_m = [{:.1f}, {:.1f}]\nradius_m = {:.1f}\n"
        "protection_m = {:.1f}\n",
        circle.x_m, circle.y_m, circle.radius_m, circle.radius_m + 1.5);
  }
  return text;
}

}  // namespace lodesman::cli
