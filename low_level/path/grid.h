// SPDX-License-Identifier: Apache-2.0
// Which pixels of the sonar view a path may use: those in the fan whose centre lies in no
// protection zone. Owned by one thread; it allocates when made and never after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "low_level/path/zone.h"
#include "mid_level/messages/sonar_view.h"

namespace lodesman {

// A bit a pixel, in 64-bit words a row. A shape is drawn by its span in each row: worked out from
// the shape's equation, then moved at both ends by the shape's own contains(), so that the result
// is that of asking contains() for every pixel.
class PassableGrid {
 public:
  PassableGrid();  // the fan without an obstacle

  void clear() noexcept;  // back to the fan without an obstacle
  void block_all() noexcept;
  void block(PathPixel pixel) noexcept;
  void block(const EllipsePx& ellipse) noexcept;
  void block(const CapsulePx& capsule) noexcept;
  void block(const WallPx& wall) noexcept;
  void block(const ZonePx& zone) noexcept;

  // False outside the view.
  [[nodiscard]] bool passable(int column, int row) const noexcept {
    return column >= 0 && column < kViewColumns && row >= 0 && row < kViewRows &&
           (three_bits(column, row) & 2U) != 0;
  }
  [[nodiscard]] std::uint32_t free_pixels() const noexcept;

  // The nine pixels round one of the view, as bits: 0-2 the row above from left to right, 3-5 its
  // own row (4: itself), 6-8 the row below. Pixels outside the view are not passable.
  [[nodiscard]] std::uint32_t around(int column, int row) const noexcept {
    return three_bits(column, row - 1) | three_bits(column, row) << 3 |
           three_bits(column, row + 1) << 6;
  }

 private:
  // Column c is bit c + 1, and a blocked row lies above row 0 and below the last: the neighbours
  // of every pixel exist.
  static constexpr std::size_t kWordsPerRow = 14;
  static_assert(kWordsPerRow * 64 >= kViewColumns + 2);

  struct Span {
    int first = 0;
    int last = -1;
  };

  [[nodiscard]] static std::size_t row_start(int row) noexcept {
    return static_cast<std::size_t>(row + 1) * kWordsPerRow;
  }
  // The pixel and its neighbours to the left (bit 0) and right (bit 2).
  [[nodiscard]] std::uint32_t three_bits(int column, int row) const noexcept {
    const auto bit = static_cast<std::size_t>(column);
    const std::size_t word = row_start(row) + bit / 64;
    const unsigned shift = bit % 64;
    const std::uint64_t low = words_[word] >> shift;
    const std::uint64_t high = words_[word + 1] << 1 << (63 - shift);
    return static_cast<std::uint32_t>((low | high) & 7U);
  }

  template <class Shape>
  void block_row(const Shape& shape, int row, double low, double high) noexcept;
  void block_interior(const WallPx& wall) noexcept;
  void block_span(int row, Span span) noexcept;

  std::array<Span, kViewRows> fan_{};
  std::vector<std::uint64_t> fan_words_;
  std::vector<std::uint64_t> words_;
};

}  // namespace lodesman
