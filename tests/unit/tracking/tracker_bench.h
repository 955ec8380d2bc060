// SPDX-License-Identifier: Apache-2.0
// A sonar with a tracker behind it, and discs for it to hear. Tests only; one thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "low_level/tracking/tracker.h"
#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman::testing {

inline constexpr double kTrackerPing_s = 0.1;

struct Disc {
  double x_m;
  double y_m;
  double radius_m;
};

// A sonar with a tracker behind it, and what it would hear of discs: the near side of each.
struct TrackerBench {
  std::unique_ptr<SonarPing> ping = std::make_unique<SonarPing>();
  std::unique_ptr<SonarObstacles> seen = std::make_unique<SonarObstacles>();
  std::unique_ptr<Tracks> tracks = std::make_unique<Tracks>();
  std::unique_ptr<Tracker> tracker = std::make_unique<Tracker>(1.0);
  VehiclePose pose{};
  double t_s = 10.0;
  std::vector<std::uint8_t> blind;  // one a beam, or none

  TrackerBench() {
    ping->range_m = 30.0;
    ping->make_image(120, 500, 2.0 * std::numbers::pi / 3.0);
  }

  void hear(const std::vector<Disc>& discs, const Obstacle* other = nullptr) {
    t_s += kTrackerPing_s;
    ping->number += 1;
    ping->captured = Time{from_seconds(t_s)};
    seen->captured = ping->captured;
    seen->range_m = ping->range_m;
    seen->count = 0;
    for (const Disc& disc : discs) {
      const Eigen::Vector2d at = pose.to_vehicle({{disc.x_m, disc.y_m}}).xy_m;
      const double to_its_end_rad =
          std::abs(std::atan2(at.x(), at.y())) - std::asin(disc.radius_m / at.norm());
      if (to_its_end_rad < ping->sector_rad / 2.0 - ping->beam_step_rad && at.norm() < 30.0) {
        Obstacle& o = seen->obstacles[seen->count++];
        o = near_side_of(at, disc.radius_m);
      }
    }
    if (other != nullptr) {
      seen->obstacles[seen->count++] = *other;
    }
    tracker->see(*ping, *seen, pose, *tracks, blind);
  }

  // The beams round that bearing.
  void blind_beams(double bearing_rad, double half_width_rad) {
    blind.assign(ping->beams, 0);
    for (std::uint32_t beam = 0; beam < ping->beams; ++beam) {
      blind[beam] = std::abs(ping->bearing_rad(beam) - bearing_rad) <= half_width_rad ? 1 : 0;
    }
  }

  // Of a disc, what of it lies in the fan.
  [[nodiscard]] Obstacle near_side_of(const Eigen::Vector2d& at, double radius_m) const {
    const double bearing_rad = std::atan2(at.x(), at.y());
    const double half_rad = std::asin(radius_m / at.norm());
    const double end_rad = ping->sector_rad / 2.0;
    const double port_rad = std::max(bearing_rad - half_rad, -end_rad);
    const double starboard_rad = std::min(bearing_rad + half_rad, end_rad);
    const double middle_rad = 0.5 * (port_rad + starboard_rad);
    const double range_m = at.norm() - 0.8 * radius_m;
    Obstacle o;
    o.centre_x_m = range_m * std::sin(middle_rad);
    o.centre_y_m = range_m * std::cos(middle_rad);
    o.semi_axis_first_m = 0.2 * radius_m;
    o.semi_axis_second_m = range_m * std::sin(0.5 * (starboard_rad - port_rad));
    o.angle_rad = middle_rad;
    return o;
  }

  [[nodiscard]] const Track* track_at(double x_m, double y_m) const {
    const Track* best = nullptr;
    double best_m = 1.0;
    for (std::uint32_t i = 0; i < tracks->count; ++i) {
      const double off_m = edge_distance_m(tracks->tracks[i].shape, {{x_m, y_m}});
      if (off_m < best_m) {
        best_m = off_m;
        best = &tracks->tracks[i];
      }
    }
    return best;
  }
};

[[nodiscard]] inline double speed_of(const Track& track) {
  return std::hypot(track.velocity_x_m_s, track.velocity_y_m_s);
}

}  // namespace lodesman::testing
