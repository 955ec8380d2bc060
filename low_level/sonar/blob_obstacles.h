// SPDX-License-Identifier: Apache-2.0
// Obstacles from blobs, whatever kind of ping they were found in: an ellipse round each, or several
// along one that is long or bent; the nearest are kept. One thread; allocates nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "low_level/sonar/blob.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

inline constexpr std::uint32_t kMaxJoin = 8;

// Of a profile alone.
struct ProfileOptions {
  std::uint32_t min_points;    // [-] >= 1; of fewer returns side by side none is an obstacle
  double least_incidence_rad;  // [rad] (0, pi / 2) at which a surface is still seen as one
  double range_noise_m;        // [m] > 0 standard deviation of a return
};

// Every value comes from the configuration; the ranges are checked there.
struct SegmentationOptions {
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
  ProfileOptions profile;
};

// How bright the cells of a blob are.
struct BlobStrength {
  std::span<const std::uint8_t> echo;
  std::uint32_t cells_of_echo;  // [-] cells in a row that share one echo
  double least;                 // a piece of a blob whose brightest cell is fainter is none
};

class BlobObstacles {
 public:
  explicit BlobObstacles(const SegmentationOptions& options);

  void begin() noexcept;
  // At least one cell of the grid. Reorders them.
  void add(const PolarGrid& grid, std::span<std::uint32_t> cells,
           const BlobStrength& strength) noexcept;
  // Nearest first; of more than kMaxObstacles the farthest were dropped, and counted.
  void write(SonarObstacles& out) noexcept;

 private:
  struct Found {
    BlobEllipse ellipse;
    double peak = 0.0;
  };

  [[nodiscard]] bool must_split(const BlobEllipse& ellipse) const noexcept;
  void keep_nearest(const Found& found) noexcept;

  double longest_m_;
  double min_fill_;
  double enclosed_fraction_;
  double margin_m_;
  std::array<Found, kMaxObstacles> found_{};  // a heap, the farthest first
  std::uint32_t found_count_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace lodesman
