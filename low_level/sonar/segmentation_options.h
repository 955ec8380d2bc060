// SPDX-License-Identifier: Apache-2.0
// How obstacles are found in pings: every value of [segmentation]. Plain data; any thread.
#pragma once

#include <algorithm>
#include <cstdint>

#include "mid_level/messages/sonar.h"

namespace lodesman {

enum class DetectionMethod : std::uint8_t {
  kContrast,   // against the background that the ping itself shows
  kThreshold,  // section 5 of the paper: a fixed level
};

inline constexpr std::uint32_t kMaxJoin = 8;

// Of a profile alone.
struct ProfileOptions {
  std::uint32_t min_points;    // [-] >= 1; of fewer returns side by side none is an obstacle
  double least_incidence_rad;  // [rad] (0, pi / 2) at which a surface is still seen as one
  double range_noise_m;        // [m] > 0 standard deviation of a return
};

// A cell is never taken for an echo with less; side lobes and smears have it in the calmest water.
inline constexpr double kLeastExcess = 0.85;

// Of contrast alone. A cell's excess is its brightness over its background, less 1.
struct ContrastOptions {
  double most_excess;  // [kLeastExcess, 100] with so much a cell may belong to an echo, however
                       // noisy the water
  double sigmas;       // (0, 100] ... and with so many times what the background varies by
  double seed;         // [1, 100] times that: an echo holds one cell so bright
  double side_lobe;    // [0, 1) of the brightest cell of its range, above the background
  // What is bright over more than this is bottom or ring; in a fan that is narrower it is a wall.
  double ring_sector_rad;  // [rad] (0, pi]
  // The sum of its cells' excesses, in those that a cell needs, from which on an echo is one: many
  // faint cells or a few bright ones.
  double min_energy;         // [-] > 0
  std::uint32_t join_beams;  // [-] [1, 16] cells so far apart are one echo
  std::uint32_t join_bins;   // [-] [1, 64]
};

// Every value comes from the configuration; the ranges are checked there.
struct SegmentationOptions {
  DetectionMethod method;
  double threshold;             // [-] (0, 255] smoothed echoes from here on are bright
  double min_range_m;           // [m] >= 0; the head's own ring-down lies nearer
  std::uint32_t min_blob_bins;  // [-] >= 1; smaller blobs are short outliers
  // Bright bins this far apart belong to one blob: 1 and 1 are the eight neighbours.
  std::uint32_t join_beams;      // [-] [1, kMaxJoin]
  std::uint32_t join_bins;       // [-] [1, kMaxJoin]
  double max_obstacle_length_m;  // [m] > 0; a longer ellipse is split across its length
  double min_fill;               // [-] [0, 1] an ellipse emptier than this is split from half that
  double enclosed_fraction;      // [-] [0.5, 0.99] of a blob's area that its ellipse holds
  double protection_margin_m;    // [m] >= 0; protection semi-axes less the obstacle's
  // Interference: at most stripe_max_beams adjacent beams of which more than stripe_fraction of
  // the bins are bright.
  double stripe_fraction;          // [-] (0, 1]; 1: none is interference
  std::uint32_t stripe_max_beams;  // [-] [0, kMaxBeams]
  ContrastOptions contrast;
  ProfileOptions profile;
};

// [m] From where on anything is heard at that range setting: with a shorter one the head sends
// shorter pulses, and its ring-down is over sooner than at min_range_m.
[[nodiscard]] inline double heard_from_m(double min_range_m, double range_m) noexcept {
  constexpr double kMostRingDown = 0.25;  // [-] of the range setting
  return std::min(min_range_m, kMostRingDown * range_m);
}

}  // namespace lodesman
