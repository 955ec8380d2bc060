// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/blob_obstacles.h"

#include <algorithm>
#include <cmath>

#include "mid_level/base/check.h"

namespace lodesman {
namespace {

// 2^8 pieces: a blob as long as the view's arc at 30 m (63 m) still comes out in quarter metres.
constexpr std::uint32_t kMaxSplits = 8;

}  // namespace

BlobObstacles::BlobObstacles(const SegmentationOptions& options)
    : longest_m_{options.max_obstacle_length_m},
      min_fill_{options.min_fill},
      enclosed_fraction_{options.enclosed_fraction},
      margin_m_{options.protection_margin_m} {
  LODESMAN_CHECK(options.max_obstacle_length_m > 0.0 && options.protection_margin_m >= 0.0);
  LODESMAN_CHECK(options.enclosed_fraction >= 0.5 && options.enclosed_fraction <= 0.99);
}

void BlobObstacles::begin() noexcept {
  found_count_ = 0;
  dropped_ = 0;
}

bool BlobObstacles::must_split(const BlobEllipse& ellipse) const noexcept {
  const double length_m = 2.0 * ellipse.first_m;
  return length_m > longest_m_ || (length_m > 0.5 * longest_m_ && ellipse.fill < min_fill_);
}

// One ellipse round a long or bent wall would cover free water, so the blob is halved across its
// longer axis until each piece is short: several ellipses along the wall, as in Fig. 9b.
void BlobObstacles::add(const PolarGrid& grid, std::span<std::uint32_t> cells,
                        const BlobStrength& strength) noexcept {
  struct Piece {
    std::span<std::uint32_t> cells;
    std::uint32_t splits;
  };
  std::array<Piece, kMaxSplits + 1> pieces{};  // each level leaves one sibling waiting
  std::size_t waiting = 0;
  pieces[waiting++] = {cells, 0};
  while (waiting > 0) {
    const Piece piece = pieces[--waiting];
    const BlobEllipse moments = moment_ellipse(grid, piece.cells);
    const BlobEllipse ellipse = enclose(grid, piece.cells, moments, enclosed_fraction_);
    if (piece.splits < kMaxSplits && must_split(ellipse)) {
      // One cell may be longer than the longest obstacle (few beams, far away): then no cut helps.
      const std::size_t behind = split_across(grid, piece.cells, ellipse);
      if (behind > 0 && behind < piece.cells.size()) {
        pieces[waiting++] = {piece.cells.first(behind), piece.splits + 1};
        pieces[waiting++] = {piece.cells.subspan(behind), piece.splits + 1};
        continue;
      }
    }
    std::uint8_t peak = 0;
    for (const std::uint32_t cell : piece.cells) {
      peak = std::max(peak, strength.echo[cell / strength.cells_of_echo]);
    }
    // A piece without an echo of its own is but the smoothing's fringe of the piece beside it.
    if (piece.splits == 0 || peak >= strength.least) {
      Obstacle shape;
      put_ellipse(ellipse, shape);
      add(shape, ellipse.nearest_m, static_cast<double>(peak));
    }
  }
}

void BlobObstacles::add(const Obstacle& shape, double nearest_m, double peak) noexcept {
  Found found{nearest_m, shape};
  found.obstacle.protection_first_m = shape.semi_axis_first_m + margin_m_;
  found.obstacle.protection_second_m = shape.semi_axis_second_m + margin_m_;
  found.obstacle.peak = peak;
  keep_nearest(found);
}

void BlobObstacles::keep_nearest(const Found& found) noexcept {
  const auto nearer = [](const Found& a, const Found& b) { return a.nearest_m < b.nearest_m; };
  if (found_count_ == kMaxObstacles) {
    ++dropped_;
    if (!nearer(found, found_[0])) {
      return;
    }
    std::pop_heap(found_.begin(), found_.end(), nearer);
    --found_count_;
  }
  found_[found_count_++] = found;
  std::push_heap(found_.begin(), found_.begin() + found_count_, nearer);
}

void BlobObstacles::write(SonarObstacles& out) noexcept {
  std::sort(found_.begin(), found_.begin() + found_count_,
            [](const Found& a, const Found& b) { return a.nearest_m < b.nearest_m; });
  for (std::uint32_t i = 0; i < found_count_; ++i) {
    out.obstacles[i] = found_[i].obstacle;
  }
  out.count = found_count_;
  out.dropped = dropped_;
}

}  // namespace lodesman
