// SPDX-License-Identifier: Apache-2.0
// Which pixels of the sonar view a path may use: those in the fan whose centre lies in no
// protection zone. Owned by one thread; it allocates when made and never after.
#pragma once

#include <cstdint>
#include <vector>

#include "low_level/path/bit_lines.h"
#include "low_level/path/zone.h"
#include "mid_level/geometry/sonar_view.h"

namespace lodesman {

// A bit a pixel, twice: by rows and by columns, so that a search runs along either 64 pixels at a
// time. A shape is drawn by its span in each line. The span is worked out from the shape's
// equation and, where an end comes too near a pixel's centre to be sure of, moved by the shape's
// own contains(): the result is that of asking contains() for every pixel.
class PassableGrid {
 public:
  // The fan without an obstacle.
  explicit PassableGrid(const FanShape& fan = {});

  void clear() noexcept;  // back to the fan without an obstacle
  void block_all() noexcept;
  void block(PathPixel pixel) noexcept;
  void block(const EllipsePx& ellipse) noexcept;
  void block(const CapsulePx& capsule) noexcept;
  void block(const WallPx& wall) noexcept;
  void block(const ZonePx& zone) noexcept;

  [[nodiscard]] const FanShape& fan() const noexcept { return fan_; }
  // False outside the view.
  [[nodiscard]] bool passable(int column, int row) const noexcept {
    return column >= 0 && column < fan_.columns && row >= 0 && row < fan_.rows &&
           rows_.is_free(row, column);
  }
  [[nodiscard]] std::uint32_t free_pixels() const noexcept;

  // The nine pixels round one of the view, as bits: 0-2 the row above from left to right, 3-5 its
  // own row (4: itself), 6-8 the row below. Pixels outside the view are not passable.
  [[nodiscard]] std::uint32_t around(int column, int row) const noexcept {
    const auto three = [&](int r) {
      return static_cast<std::uint32_t>(rows_.window(r, column - 1) & 7U);
    };
    return three(row - 1) | three(row) << 3 | three(row + 1) << 6;
  }

  // A line a row, a place a column; and the reverse. Both hold the same pixels.
  [[nodiscard]] const BitLines& rows() const noexcept { return rows_; }
  [[nodiscard]] const BitLines& columns() const noexcept { return columns_; }

 private:
  void block_row_span(int row, LineSpan span) noexcept;
  void block_capsule_rows(const CapsulePx& capsule) noexcept;
  void block_interior_rows(const WallPx& wall) noexcept;
  void copy_to_columns(LineSpan rows, LineSpan columns) noexcept;

  FanShape fan_;
  BitLines rows_;
  BitLines columns_;
};

}  // namespace lodesman
