// SPDX-License-Identifier: Apache-2.0
// What is known of each obstacle over time: where it is, how it moves, how sure that is. Plain data
// for the blackboard; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

// One obstacle, moving on at a constant velocity as far as is known. Its zone is not part of it:
// the planner makes zones from what it knows of speed, hull and doubt.
struct Track {
  std::uint32_t id = 0;  // [-] > 0; kept as long as the obstacle is known
  Time last_seen{};      // [ns] its shape is placed for this time: of the frame that showed it
                         // last or, of one's own echoes, that it was foreseen for
  Obstacle shape{};      // [world] at last_seen; its protection semi-axes mean nothing
  double velocity_x_m_s = 0.0;  // [m/s] [world]
  double velocity_y_m_s = 0.0;  // [m/s] [world]
  // Covariances of the place at last_seen and of the velocity, in the world frame.
  double place_xx_m2 = 0.0;        // [m^2] >= 0
  double place_xy_m2 = 0.0;        // [m^2]
  double place_yy_m2 = 0.0;        // [m^2] >= 0
  double velocity_xx_m2_s2 = 0.0;  // [m^2/s^2] >= 0
  double velocity_xy_m2_s2 = 0.0;  // [m^2/s^2]
  double velocity_yy_m2_s2 = 0.0;  // [m^2/s^2] >= 0

  // Whether its velocity is more than its doubt can explain, once in a thousand (chi squared of two
  // degrees of freedom). Most things rest: foreseen for a minute, noise would carry them far.
  [[nodiscard]] bool surely_moves() const noexcept {
    constexpr double kChiSquared = 13.8;
    const double squared = velocity_x_m_s * velocity_x_m_s + velocity_y_m_s * velocity_y_m_s;
    return squared > 0.5 * kChiSquared * (velocity_xx_m2_s2 + velocity_yy_m2_s2);
  }

  static constexpr auto fields() noexcept {
    using T = Track;
    return field_list(field("id", &T::id), field("last_seen", &T::last_seen),
                      field("shape", &T::shape),
                      field("velocity_x_m_s", &T::velocity_x_m_s).within(-1e3, 1e3),
                      field("velocity_y_m_s", &T::velocity_y_m_s).within(-1e3, 1e3),
                      field("place_xx_m2", &T::place_xx_m2).within(0.0, 1e9),
                      field("place_xy_m2", &T::place_xy_m2),
                      field("place_yy_m2", &T::place_yy_m2).within(0.0, 1e9),
                      field("velocity_xx_m2_s2", &T::velocity_xx_m2_s2).within(0.0, 1e9),
                      field("velocity_xy_m2_s2", &T::velocity_xy_m2_s2),
                      field("velocity_yy_m2_s2", &T::velocity_yy_m2_s2).within(0.0, 1e9));
  }
};

// All that is known at one sonar frame: what it shows, and what has left the view but not the mind.
// Written by the DeltaT task once a ping; read by the planner and displays.
struct Tracks {
  std::uint64_t frame = 0;    // [-] number of the ping
  Time captured{};            // [ns] when it was taken
  std::uint32_t dropped = 0;  // [-] tracks that found no room (the farthest ones)
  std::uint32_t count = 0;    // [-] [0, kMaxObstacles]
  std::array<Track, kMaxObstacles> tracks{};

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(Tracks, tracks) + std::min<std::size_t>(count, kMaxObstacles) * sizeof(Track);
  }
  [[nodiscard]] Time measured_at() const noexcept { return captured; }

  static constexpr auto fields() noexcept {
    using T = Tracks;
    return field_list(field("frame", &T::frame), field("captured", &T::captured),
                      field("dropped", &T::dropped), field("count", &T::count),
                      field("tracks", &T::tracks, &T::count));
  }
};

}  // namespace lodesman
