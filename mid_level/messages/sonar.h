// SPDX-License-Identifier: Apache-2.0
// What the sonar saw: the ping as the head delivers it, and the obstacles found in it.
// Plain data for the blackboard; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

inline constexpr std::size_t kMaxBeams = 512;
inline constexpr std::size_t kMaxBins = 1000;

// [m] The longest range setting is 300 m at 1500 m/s; sound may be faster.
inline constexpr double kMaxSonarRange_m = 350.0;

enum class PingKind : std::uint8_t {
  kImage,    // an echo strength a bin of each beam
  kProfile,  // a range a beam
};
[[nodiscard]] constexpr auto enumerators(PingKind) noexcept {
  return enumerators_to<PingKind::kProfile>("image", "profile");
}

// What came back in one beam of a profile.
struct ProfilePoint {
  double range_m = 0.0;         // [m] 0: nothing came back
  std::uint32_t intensity = 0;  // [-] as the device counts; 0 where it gives none

  static constexpr auto fields() noexcept {
    using P = ProfilePoint;
    return field_list(field("range_m", &P::range_m).within(0.0, kMaxSonarRange_m),
                      field("intensity", &P::intensity));
  }
};

// One ping, of either kind. Written by the DeltaT task at the sonar's rate (10 Hz); read by
// recorders and displays.
struct SonarPing {
  std::uint64_t number = 0;        // [-] counts up by one a ping of this sonar
  Time captured{};                 // [ns] when the ping was sent
  double range_m = 0.0;            // [m] [0.01, 350] of the far edge of the last bin
  double sector_rad = 0.0;         // [rad] (0, pi] that all beams cover together
  double first_bearing_rad = 0.0;  // [rad] of the first beam's centre, clockwise from ahead
  double beam_step_rad = 0.0;      // [rad] > 0 from one beam to the next: left to right
  PingKind kind = PingKind::kImage;
  std::uint32_t beams = 0;        // [-] [1, kMaxBeams]
  std::uint32_t bins = 0;         // [-] [1, kMaxBins] of an image's beam; 0 in a profile
  std::uint32_t point_count = 0;  // [-] beams in a profile; 0 in an image
  std::uint32_t echo_count = 0;   // [-] beams x bins
  std::array<ProfilePoint, kMaxBeams> points{};
  // [-] [0, 255] echo strength, beam by beam: echo[beam * bins + bin], bin 0 nearest
  std::array<std::uint8_t, kMaxBeams * kMaxBins> echo{};

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(SonarPing, echo) + std::min<std::size_t>(echo_count, echo.size());
  }
  [[nodiscard]] Time measured_at() const noexcept { return captured; }
  [[nodiscard]] bool fits() const noexcept {
    const bool is_image = kind == PingKind::kImage;
    return echo_count == beams * bins && (bins > 0) == is_image &&
           point_count == (is_image ? 0 : beams) &&
           std::abs(sector_rad - beams * beam_step_rad) < 1e-6;
  }

  // Where the beams lie, whose number is set.
  void set_bearings(double first_rad, double step_rad) noexcept {
    first_bearing_rad = first_rad;
    beam_step_rad = step_rad;
    sector_rad = beams * step_rad;
  }
  // An image whose beams lie side by side, centred on straight ahead. Its echoes stay as they are.
  void make_image(std::uint32_t beam_count, std::uint32_t bin_count, double sector) noexcept {
    kind = PingKind::kImage;
    beams = beam_count;
    bins = bin_count;
    point_count = 0;
    echo_count = beams * bins;
    set_bearings(0.5 * sector * (1.0 / beams - 1.0), sector / beams);
  }
  // A profile, laid out so. Its points stay as they are.
  void make_profile(std::uint32_t beam_count, double sector) noexcept {
    kind = PingKind::kProfile;
    beams = point_count = beam_count;
    bins = echo_count = 0;
    set_bearings(0.5 * sector * (1.0 / beams - 1.0), sector / beams);
  }
  // Bearing of a beam's centre, clockwise from straight ahead.
  [[nodiscard]] double bearing_rad(std::uint32_t beam) const noexcept {
    return first_bearing_rad + beam * beam_step_rad;
  }
  // Which beam looks there; may lie outside [0, beams).
  [[nodiscard]] double beam_at(double bearing_rad) const noexcept {
    return (bearing_rad - first_bearing_rad) / beam_step_rad + 0.5;
  }
  // Range of a bin's centre.
  [[nodiscard]] double bin_range_m(std::uint32_t bin) const noexcept {
    return range_m * (bin + 0.5) / bins;
  }

  static constexpr auto fields() noexcept {
    using P = SonarPing;
    return field_list(
        field("number", &P::number), field("captured", &P::captured),
        field("range_m", &P::range_m).within(0.01, kMaxSonarRange_m),
        field("sector_rad", &P::sector_rad).within(1e-3, kHalfTurn_rad),
        field("first_bearing_rad", &P::first_bearing_rad).within(-kHalfTurn_rad, kHalfTurn_rad),
        field("beam_step_rad", &P::beam_step_rad).within(1e-6, kHalfTurn_rad),
        field("kind", &P::kind), field("beams", &P::beams).within(1, kMaxBeams),
        field("bins", &P::bins).within(0, kMaxBins),
        field("point_count", &P::point_count).within(0, kMaxBeams),
        field("echo_count", &P::echo_count), field("points", &P::points, &P::point_count),
        field("echo", &P::echo, &P::echo_count));
  }
};

// The obstacles in one sonar frame, in the vehicle frame at its capture time. Written by the
// DeltaT task once a ping; read by PathFinder, the planner and displays.
struct SonarObstacles {
  std::uint64_t frame = 0;    // [-] number of the ping they were found in, or stand for
  Time captured{};            // [ns] the vehicle's pose at this time is the frame they are given in
  double range_m = 0.0;       // [m] [0.01, 350] of the ping: the radius of the sonar view
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
    return field_list(field("frame", &O::frame), field("captured", &O::captured),
                      field("range_m", &O::range_m).within(0.0, kMaxSonarRange_m),
                      field("dropped", &O::dropped), field("count", &O::count),
                      field("obstacles", &O::obstacles, &O::count));
  }
};

}  // namespace lodesman
