// SPDX-License-Identifier: Apache-2.0
// Obstacles from blobs, whatever kind of ping they were found in: an ellipse round each, or several
// along one that is long or bent; the nearest are kept. One thread; allocates nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "low_level/sonar/blob.h"
#include "low_level/sonar/segmentation_options.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

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
  // One that is no blob, with nothing but its shape.
  void add(const Obstacle& shape, double nearest_m, double peak) noexcept;
  // Nearest first; of more than kMaxObstacles the farthest were dropped, and counted.
  void write(SonarObstacles& out) noexcept;

 private:
  struct Found {
    double nearest_m = 0.0;
    Obstacle obstacle;
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
