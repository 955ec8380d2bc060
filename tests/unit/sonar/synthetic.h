// SPDX-License-Identifier: Apache-2.0
// Pings that tests make by hand, and the segmentation values that the vehicle ships with.
// Tests only, on their one thread.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>

#include "deploy/boat/level_options.h"
#include "low_level/sonar/segmentation.h"
#include "mid_level/base/heading.h"
#include "mid_level/messages/sonar.h"

namespace lodesman::testing {

inline SegmentationOptions shipped_options() {
  const TomlDocument document = TomlDocument::from_file(LODESMAN_DEFAULT_CONFIG);
  return read_segmentation_options(document.root().table("segmentation"));
}

// The DeltaT of the paper's section 5, seeing nothing.
inline std::unique_ptr<SonarPing> empty_ping(double range_m = 30.0, std::uint32_t beams = 120,
                                             std::uint32_t bins = 500) {
  auto ping = std::make_unique<SonarPing>();
  ping->range_m = range_m;
  ping->make_image(beams, bins, 2.0 * std::numbers::pi / 3.0);
  return ping;
}

// Sets every bin whose centre's place satisfies `is_lit(x_m, y_m)`.
template <class IsLit>
void light(SonarPing& ping, std::uint8_t echo, IsLit is_lit) {
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    for (std::uint32_t bin = 0; bin < ping.bins; ++bin) {
      const double x_m = ping.bin_range_m(bin) * std::sin(ping.bearing_rad(beam));
      const double y_m = ping.bin_range_m(bin) * std::cos(ping.bearing_rad(beam));
      if (is_lit(x_m, y_m)) {
        ping.echo[beam * ping.bins + bin] = echo;
      }
    }
  }
}

inline void light_disc(SonarPing& ping, double range_m, double bearing_rad, double radius_m,
                       std::uint8_t echo = 200) {
  const double cx = range_m * std::sin(bearing_rad);
  const double cy = range_m * std::cos(bearing_rad);
  light(ping, echo, [=](double x, double y) { return std::hypot(x - cx, y - cy) <= radius_m; });
}

// Whether the point lies in the ellipse's body.
inline bool holds(const Obstacle& o, double x_m, double y_m) {
  const double dx = x_m - o.centre_x_m;
  const double dy = y_m - o.centre_y_m;
  const double along = dx * std::sin(o.angle_rad) + dy * std::cos(o.angle_rad);
  const double across = dx * std::cos(o.angle_rad) - dy * std::sin(o.angle_rad);
  return std::hypot(along / o.semi_axis_first_m, across / o.semi_axis_second_m) <= 1.0;
}

}  // namespace lodesman::testing
