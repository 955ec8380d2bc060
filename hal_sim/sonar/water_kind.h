// SPDX-License-Identifier: Apache-2.0
// What makes a tank sound different from the sea, and the grid that a ping is drawn in. Plain
// values for what draws a ping; any thread. docs/sonar_simulation.md says where each comes from.
#pragma once

#include <cstdint>

namespace lodesman {

// Ranges and lengths of water were measured on frames whose range setting is not known, and to
// which so much was assigned: they are shares of a range setting, and this is their whole. What is
// called nominal below grows and shrinks with the range setting.
inline constexpr double kNominalRange_m = 30.0;

struct EchoGrid {
  std::uint32_t beams = 0;
  std::uint32_t bins = 0;
  double range_m = 0.0;     // [m] of the far edge of the last bin
  double sector_rad = 0.0;  // [rad] that all beams cover together, centred on straight ahead

  [[nodiscard]] double bins_of_nominal(double nominal_m) const noexcept {
    return nominal_m / kNominalRange_m * bins;
  }
  [[nodiscard]] double metres_of_nominal(double nominal_m) const noexcept {
    return nominal_m / kNominalRange_m * range_m;
  }
  // Both as real numbers, so that 0.5 is the middle of the first; may lie outside.
  [[nodiscard]] double bin_at(double from_m) const noexcept { return from_m / range_m * bins; }
  [[nodiscard]] double beam_at(double bearing_rad) const noexcept {
    return (bearing_rad / sector_rad + 0.5) * beams;
  }
};

// Levels are of 255. Chances are those of one ping.
struct WaterKind {
  double near_level = 0.0;       // [-] of water near by, and ...
  double far_level = 0.0;        // [-] ... at full range, before the bottom is heard
  double haze_level = 0.0;       // [-] above it at the head, dying away over a few metres
  double bottom_from = 0.0;      // [-] of the range: where the bottom is first heard, from here ...
  double bottom_to = 0.0;        // [-] ... to here
  double bottom_step = 0.0;      // [-] how many times as bright it is from there on
  double side_lobe = 0.0;        // [-] of the brightest echo of a range, in all beams
  double smear = 0.0;            // [-] of an echo, behind it, ...
  double smear_nominal_m = 0.0;  // ... dying away over so much
  double room_echo = 0.0;  // [-] of the brightest echo of a range, in all beams behind it, ...
  double room_echo_nominal_m = 0.0;  // ... dying away over so much
  double shadow = 0.0;               // [-] of the water, behind what stands in it
  double second_echoes = 0.0;        // [-] begun, of each target
  double mirror_images = 0.0;        // [-] begun, of each target before a wall
  double clouds = 0.0;               // [-] begun
  double rays = 0.0;                 // [-] begun
  double dashed_stripes = 0.0;       // [-] begun
  double particles = 0.0;            // [-] begun, on average
  double outliers = 0.0;             // [-] single cells, on average
  double lost_pings = 0.0;           // [-] that do not come
};

inline constexpr WaterKind kTankWater{.near_level = 2.5,
                                      .far_level = 5.0,
                                      .haze_level = 8.0,
                                      .bottom_from = 0.15,
                                      .bottom_to = 0.35,
                                      .bottom_step = 2.0,
                                      .side_lobe = 0.09,
                                      .smear = 0.38,
                                      .smear_nominal_m = 2.5,
                                      .room_echo = 0.01,
                                      .room_echo_nominal_m = 6.0,
                                      .shadow = 0.9,
                                      .second_echoes = 0.004,
                                      .mirror_images = 0.01,
                                      .outliers = 1.0};

inline constexpr WaterKind kSeaWater{.near_level = 1.5,
                                     .far_level = 5.5,
                                     .haze_level = 4.0,
                                     .bottom_from = 0.35,
                                     .bottom_to = 1.1,
                                     .bottom_step = 2.3,
                                     .side_lobe = 0.09,
                                     .smear = 0.35,
                                     .smear_nominal_m = 1.5,
                                     .room_echo = 0.005,
                                     .room_echo_nominal_m = 3.0,
                                     .shadow = 0.7,
                                     .second_echoes = 0.02,
                                     .mirror_images = 0.02,
                                     .clouds = 0.009,
                                     .rays = 0.012,
                                     .dashed_stripes = 0.01,
                                     .particles = 5.0,
                                     .outliers = 4.0,
                                     .lost_pings = 0.005};

}  // namespace lodesman
