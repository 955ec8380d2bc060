// SPDX-License-Identifier: Apache-2.0
// Section 5 of the paper: a fixed threshold on the ping, an ellipse round each bright blob and a
// protection ellipse round that. One thread owns a Segmenter; the DeltaT task calls it once a ping.
#pragma once

#include <cstdint>
#include <vector>

#include "low_level/sonar/blob_obstacles.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

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
  void copy_without_stripes(const SonarPing& ping) noexcept;
  void replace_stripe(const SonarPing& ping, std::uint32_t first, std::uint32_t end) noexcept;
  void mark_bright(const SonarPing& ping) noexcept;
  [[nodiscard]] std::size_t grow_blob(const SonarPing& ping, std::uint32_t seed) noexcept;

  SegmentationOptions options_;
  BlobObstacles blobs_;
  PolarGrid grid_;
  std::vector<std::uint8_t> echo_;    // the ping without its stripes
  std::vector<std::uint8_t> bright_;  // 1: bright and in no blob yet
  std::vector<std::uint32_t> cells_;  // of the blob at hand; also the queue it grows by
};

}  // namespace lodesman
