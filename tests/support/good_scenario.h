// SPDX-License-Identifier: Apache-2.0
// A scenario that is right, for tests that make one thing of it wrong. Any thread.
#pragma once

#include <string>

namespace lodesman::testing {

// A scenario of the contract's example, with a bit of everything in it.
inline const std::string kGoodScenario = R"(name = "a-good.one"
seed = 1
time_limit_s = 200.0
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
goal_m = [0.0, 20.0]
goal_radius_m = 0.5
[vehicle]
speed_m_s = 0.22
radius_m = 0.5
[[obstacle]]
shape = "circle"
centre_m = [0.0, 10.0]
radius_m = 0.5
protection_m = 3.5
velocity_m_s = [0.0, -0.11]
stop_at_m = [0.0, 0.0]
start_s = 5.0
end_s = 60.0
[[obstacle]]
shape = "ellipse"
centre_m = [3.0, 14.0]
semi_axes_m = [1.5, 0.4]
angle_deg = 30.0
protection_semi_axes_m = [4.0, 2.0]
[[obstacle]]
shape = "polyline"
points_m = [[-10.0, 25.0], [10.0, 25.0]]
protection_m = 1.0
[environment]
current_m_s = [0.1, 0.0]
lift = true
origin_deg = [36.0, 138.0]
[position]
source = "gps"
gps_sigma_m = 2.0
[sonar]
scene = "beams"
noise = "none"
range_m = 20.0
sector_deg = 90.0
beams = 240
bins = 400
ping_hz = 5.0
[[fault]]
device = "thruster"
kind = "disconnect"
at_s = 20.0
duration_s = 5.0
)";

// Empty where `old` is no part of the text.
[[nodiscard]] inline std::string replaced(std::string text, const std::string& old,
                                          const std::string& by) {
  const auto place = text.find(old);
  return place == std::string::npos ? "" : text.replace(place, old.size(), by);
}

}  // namespace lodesman::testing
