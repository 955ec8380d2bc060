// SPDX-License-Identifier: Apache-2.0
// What the sonar saw: the ping as the head delivers it, and the obstacles found in it.
// Plain data for the blackboard; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

inline constexpr std::size_t kMaxBeams = 512;
inline constexpr std::size_t kMaxBins = 1000;

// One ping. Written by the DeltaT task at the sonar's rate (10 Hz); read by recorders and displays.
struct SonarPing {
  std::uint64_t number = 0;      // [-] counts up by one a ping of this sonar
  Time captured{};               // [ns] when the ping was sent
  double range_m = 0.0;          // [m] [0.01, 300] of the far edge of the last bin
  double sector_rad = 0.0;       // [rad] (0, pi] the beams share it evenly, left to right
  std::uint32_t beams = 0;       // [-] [1, kMaxBeams]
  std::uint32_t bins = 0;        // [-] [1, kMaxBins]
  std::uint32_t echo_count = 0;  // [-] beams x bins
  // [-] [0, 255] echo strength, beam by beam: echo[beam * bins + bin], bin 0 nearest
  std::array<std::uint8_t, kMaxBeams * kMaxBins> echo{};

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(SonarPing, echo) + std::min<std::size_t>(echo_count, echo.size());
  }
  [[nodiscard]] Time measured_at() const noexcept { return captured; }
  [[nodiscard]] bool fits() const noexcept { return echo_count == beams * bins; }
  // Bearing of a beam's centre, clockwise from straight ahead.
  [[nodiscard]] double bearing_rad(std::uint32_t beam) const noexcept {
    return sector_rad * ((beam + 0.5) / beams - 0.5);
  }
  // Range of a bin's centre.
  [[nodiscard]] double bin_range_m(std::uint32_t bin) const noexcept {
    return range_m * (bin + 0.5) / bins;
  }

  static constexpr auto fields() noexcept {
    using P = SonarPing;
    return std::tuple{field("number", &P::number),
                      field("captured", &P::captured),
                      field("range_m", &P::range_m).within(0.01, 300.0),
                      field("sector_rad", &P::sector_rad).within(1e-3, kHalfTurn_rad),
                      field("beams", &P::beams).within(1, kMaxBeams),
                      field("bins", &P::bins).within(1, kMaxBins),
                      field("echo_count", &P::echo_count),
                      field("echo", &P::echo, &P::echo_count)};
  }
};

// The obstacles in one sonar frame, in the vehicle frame at its capture time. Written by the
// DeltaT task once a ping; read by PathFinder, the planner and displays.
struct SonarObstacles {
  std::uint64_t frame = 0;    // [-] number of the ping they were found in, or stand for
  Time captured{};            // [ns] the vehicle's pose at this time is the frame they are given in
  double range_m = 0.0;       // [m] [0.01, 300] of the ping: the radius of the sonar view
  std::uint32_t dropped = 0;  // [-] obstacles that found no room (the farthest ones)
  std::uint32_t count = 0;    // [-] [0, kMaxObstacles]
  std::array<Obstacle, kMaxObstacles> obstacles{};

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(SonarObstacles, obstacles) +
           std::min<std::size_t>(count, kMaxObstacles) * sizeof(Obstacle);
  }
  [[nodiscard]] Time measured_at() const noexcept { return captured; }

  static constexpr auto fields() noexcept {
    using O = SonarObstacles;
    return std::tuple{field("frame", &O::frame),
                      field("captured", &O::captured),
                      field("range_m", &O::range_m).within(0.0, 300.0),
                      field("dropped", &O::dropped),
                      field("count", &O::count),
                      field("obstacles", &O::obstacles, &O::count)};
  }
};

}  // namespace lodesman
