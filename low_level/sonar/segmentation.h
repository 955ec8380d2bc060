// SPDX-License-Identifier: Apache-2.0
// Section 5 of the paper: a fixed threshold on the ping, an ellipse round each bright blob and a
// protection ellipse round that. One thread owns a Segmenter; the DeltaT task calls it once a ping.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "low_level/sonar/blob.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

inline constexpr std::uint32_t kMaxJoin = 8;

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
};

// The paper leaves the filtering to the DeltaT head and thresholds what it delivers. Heads (and
// published frames) without those filters are noisier, so a 3 x 3 box on the polar ping stands
// for them here, and `min_blob_bins` for the head's "Remove Short Outliers".
//
// A stripe along one bearing is electrical interference, not an object: no surface is lit from the
// head to the edge of the view. Its beams take the mean of the beams beside them, or their own
// excess over their own usual level where that is more, so an obstacle wider than the stripe or
// much brighter is still seen. A wider bright sector is left alone: hiding it could hide a wall.
class Segmenter {
 public:
  explicit Segmenter(const SegmentationOptions& options);

  // Obstacles nearest first; of more than kMaxObstacles the farthest are dropped and counted.
  // A ping that breaks its own ranges gives none. Bounded: each bin is visited once a split
  // level. Allocates nothing.
  void segment(const SonarPing& ping, SonarObstacles& out) noexcept;

 private:
  struct Found {
    BlobEllipse ellipse;
    double peak = 0.0;
  };

  void copy_without_stripes(const SonarPing& ping) noexcept;
  void replace_stripe(const SonarPing& ping, std::uint32_t first, std::uint32_t end) noexcept;
  void mark_bright(const SonarPing& ping) noexcept;
  [[nodiscard]] std::size_t grow_blob(const SonarPing& ping, std::uint32_t seed) noexcept;
  void add_blob(std::size_t size) noexcept;
  [[nodiscard]] bool must_split(const BlobEllipse& ellipse) const noexcept;
  void keep_nearest(const Found& found) noexcept;
  void write(SonarObstacles& out) noexcept;

  SegmentationOptions options_;
  PolarGrid grid_;
  std::vector<std::uint8_t> echo_;            // the ping without its stripes
  std::vector<std::uint8_t> bright_;          // 1: bright and in no blob yet
  std::vector<std::uint32_t> cells_;          // of the blob at hand; also the queue it grows by
  std::array<Found, kMaxObstacles> found_{};  // a heap, the farthest first
  std::uint32_t found_count_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace lodesman
