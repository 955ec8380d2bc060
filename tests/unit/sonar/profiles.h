// SPDX-License-Identifier: Apache-2.0
// Profiles of surfaces that are told by where a ray meets them, and what is found in them. One
// thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "low_level/sonar/profile.h"
#include "mid_level/messages/sane.h"
#include "tests/support/catch.h"
#include "tests/unit/sonar/synthetic.h"

namespace lodesman::testing {

// [m] from the head along a bearing to a surface; infinite where there is none.
using Surface = std::function<double(double bearing_rad)>;
inline constexpr double kNowhere = std::numeric_limits<double>::infinity();

[[nodiscard]] inline Surface disc_at(double x_m, double y_m, double radius_m) {
  return [=](double bearing_rad) {
    const double along = x_m * std::sin(bearing_rad) + y_m * std::cos(bearing_rad);
    const double across = x_m * std::cos(bearing_rad) - y_m * std::sin(bearing_rad);
    const double half = radius_m * radius_m - across * across;
    return half >= 0.0 && along > 0.0 ? along - std::sqrt(half) : kNowhere;
  };
}

// From one point to the other.
[[nodiscard]] inline Surface wall_from(double x1_m, double y1_m, double x2_m, double y2_m) {
  return [=](double bearing_rad) {
    const double s = std::sin(bearing_rad);
    const double c = std::cos(bearing_rad);
    const double first = x1_m * c - y1_m * s;  // across the beam
    const double second = x2_m * c - y2_m * s;
    if (first * second > 0.0) {
      return kNowhere;
    }
    const double part = first / (first - second);
    const double range_m = (x1_m + part * (x2_m - x1_m)) * s + (y1_m + part * (y2_m - y1_m)) * c;
    return range_m > 0.0 ? range_m : kNowhere;
  };
}

[[nodiscard]] inline std::unique_ptr<SonarPing> profile_of(const std::vector<Surface>& surfaces,
                                                           double range_m = 30.0,
                                                           std::uint32_t beams = 120,
                                                           double noise_m = 0.0) {
  auto ping = std::make_unique<SonarPing>();
  ping->number = 5;
  ping->captured = Time{std::chrono::seconds{3}};
  ping->kind = PingKind::kProfile;
  ping->range_m = range_m;
  ping->beams = beams;
  ping->point_count = beams;
  ping->set_bearings(to_rad(-60.0 + 60.0 / beams), to_rad(120.0 / beams));
  std::mt19937 random{7};
  std::normal_distribution<double> noise{0.0, 1.0};
  for (std::uint32_t beam = 0; beam < beams; ++beam) {
    double nearest_m = kNowhere;
    for (const Surface& surface : surfaces) {
      nearest_m = std::min(nearest_m, surface(ping->bearing_rad(beam)));
    }
    if (nearest_m < range_m) {
      ping->points[beam] = {std::min(nearest_m + noise_m * noise(random), range_m), 100};
    }
  }
  REQUIRE(sane(*ping));
  return ping;
}

[[nodiscard]] inline std::unique_ptr<SonarObstacles> seen_in(
    const SonarPing& ping, const SegmentationOptions& options = shipped_options()) {
  auto seen = std::make_unique<SonarObstacles>();
  ProfileDetector{options}.detect(ping, *seen);
  REQUIRE(sane(*seen));
  return seen;
}

// Whether the point lies in one of the obstacles, grown by so much.
[[nodiscard]] inline bool covers(const SonarObstacles& seen, double x_m, double y_m,
                                 double margin_m) {
  for (std::uint32_t i = 0; i < seen.count; ++i) {
    const Obstacle& o = seen.obstacles[i];
    const double dx = x_m - o.centre_x_m;
    const double dy = y_m - o.centre_y_m;
    const double along = dx * std::sin(o.angle_rad) + dy * std::cos(o.angle_rad);
    const double across = dx * std::cos(o.angle_rad) - dy * std::sin(o.angle_rad);
    if (std::hypot(along / (o.semi_axis_first_m + margin_m),
                   across / (o.semi_axis_second_m + margin_m)) <= 1.0) {
      return true;
    }
  }
  return false;
}

// Every return lies in an obstacle, but for so few.
[[nodiscard]] inline std::uint32_t uncovered(const SonarPing& ping, const SonarObstacles& seen,
                                             double margin_m) {
  std::uint32_t count = 0;
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    const double r = ping.points[beam].range_m;
    const double b = ping.bearing_rad(beam);
    count += r > 0.0 && !covers(seen, r * std::sin(b), r * std::cos(b), margin_m) ? 1U : 0U;
  }
  return count;
}

}  // namespace lodesman::testing
