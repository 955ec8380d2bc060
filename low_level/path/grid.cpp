// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lodesman {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The next whole number up, within [low, high]. What is not a number gives the widest span: a
// first pixel falls to `low`, a last one to `high`.
int first_from(double value, int low, int high) noexcept {
  if (!(value > low)) {
    return low;
  }
  return value >= high ? high : static_cast<int>(std::ceil(value));
}
int last_from(double value, int low, int high) noexcept {
  if (!(value < high)) {
    return high;
  }
  return value <= low ? low : static_cast<int>(std::ceil(value));
}

struct Range {
  double low = kInfinity;
  double high = -kInfinity;

  void include(double from, double to) noexcept {
    low = std::min(low, from);
    high = std::max(high, to);
  }
  // Keeps the x with at_least <= slope * x + offset <= at_most.
  void keep(double slope, double offset, double at_least, double at_most) noexcept {
    if (slope > 0.0) {
      low = std::max(low, (at_least - offset) / slope);
      high = std::min(high, (at_most - offset) / slope);
    } else if (slope < 0.0) {
      low = std::max(low, (at_most - offset) / slope);
      high = std::min(high, (at_least - offset) / slope);
    } else if (offset < at_least || offset > at_most) {
      low = kInfinity;
    }
  }
};

// The rows that a shape between two heights can touch, and one more to each side for rounding.
struct Rows {
  int first;
  int end;
};
Rows rows_between(double top, double bottom) noexcept {
  return {first_from(top - 1.0, 0, kViewRows), last_from(bottom + 2.0, 0, kViewRows)};
}

// Where a capsule crosses a row: its two discs, and the rectangle between them.
Range capsule_range(const CapsulePx& capsule, int row) noexcept {
  const double along_x = capsule.to.column - capsule.from.column;
  const double along_y = capsule.to.row - capsule.from.row;
  Range range;
  for (const PointPx& end : {capsule.from, capsule.to}) {
    const double off = row - end.row;
    // A row that just misses the disc is kept as well: contains() has the last word.
    if (std::abs(off) <= capsule.radius + 1.0) {
      const double half = std::sqrt(std::max(capsule.radius * capsule.radius - off * off, 0.0));
      range.include(end.column - half, end.column + half);
    }
  }
  const double length_squared = along_x * along_x + along_y * along_y;
  const double reach = capsule.radius * std::sqrt(length_squared);
  const double off = row - capsule.from.row;
  Range rectangle{-kInfinity, kInfinity};
  rectangle.keep(along_x, off * along_y, 0.0, length_squared);
  rectangle.keep(along_y, -off * along_x, -reach, reach);
  if (length_squared > 0.0 && rectangle.low <= rectangle.high) {
    range.include(capsule.from.column + rectangle.low, capsule.from.column + rectangle.high);
  }
  return range;
}

}  // namespace

PassableGrid::PassableGrid()
    : fan_words_((kViewRows + 2) * kWordsPerRow + 1, 0), words_(fan_words_.size(), 0) {
  for (int row = 0; row < kViewRows; ++row) {
    Span& span = fan_[static_cast<std::size_t>(row)];
    span = {kApexColumn, kApexColumn};  // no row of the fan is without its middle
    while (in_fan(span.first - 1, row)) {
      --span.first;
    }
    while (in_fan(span.last + 1, row)) {
      ++span.last;
    }
    for (int column = span.first; column <= span.last; ++column) {
      const auto bit = static_cast<std::size_t>(column + 1);
      fan_words_[row_start(row) + bit / 64] |= std::uint64_t{1} << (bit % 64);
    }
  }
  clear();
}

void PassableGrid::clear() noexcept {
  std::copy(fan_words_.begin(), fan_words_.end(), words_.begin());
}

void PassableGrid::block_all() noexcept { std::fill(words_.begin(), words_.end(), 0); }

void PassableGrid::block(PathPixel pixel) noexcept {
  if (in_fan(pixel.column, pixel.row)) {
    block_span(pixel.row, {pixel.column, pixel.column});
  }
}

void PassableGrid::block(const EllipsePx& ellipse) noexcept {
  // With dx, dy from the centre: (dx cos + dy sin)^2 / a^2 + (dy cos - dx sin)^2 / b^2 <= 1, in
  // dx a quadratic square * dx^2 + 2 * slope * dy * dx + ... whose discriminant is
  // square - (dy / (a b))^2.
  const double cos_a = ellipse.cos_theta / ellipse.a;
  const double sin_a = ellipse.sin_theta / ellipse.a;
  const double cos_b = ellipse.cos_theta / ellipse.b;
  const double sin_b = ellipse.sin_theta / ellipse.b;
  const double square = cos_a * cos_a + sin_b * sin_b;
  const double slope = cos_a * sin_a - sin_b * cos_b;
  const double height = ellipse.a * ellipse.b * std::sqrt(square);
  const Rows rows = rows_between(ellipse.centre.row - height, ellipse.centre.row + height);
  for (int row = rows.first; row < rows.end; ++row) {
    const double dy = row - ellipse.centre.row;
    const double scaled = dy / (ellipse.a * ellipse.b);
    const double half = std::sqrt(std::max(square - scaled * scaled, 0.0)) / square;
    const double middle = ellipse.centre.column - slope * dy / square;
    block_row(ellipse, row, middle - half, middle + half);
  }
}

void PassableGrid::block(const CapsulePx& capsule) noexcept {
  const double top = std::min(capsule.from.row, capsule.to.row) - capsule.radius;
  const double bottom = std::max(capsule.from.row, capsule.to.row) + capsule.radius;
  const Rows rows = rows_between(top, bottom);
  for (int row = rows.first; row < rows.end; ++row) {
    const Range range = capsule_range(capsule, row);
    block_row(capsule, row, range.low, range.high);
  }
}

void PassableGrid::block(const WallPx& wall) noexcept {
  for (std::uint32_t i = 0; i < wall.edge_count(); ++i) {
    block(wall.edge(i));
  }
  if (wall.closed) {
    block_interior(wall);
  }
}

void PassableGrid::block(const ZonePx& zone) noexcept {
  if (const auto* ellipse = std::get_if<EllipsePx>(&zone)) {
    block(*ellipse);
  } else if (const auto* wall = std::get_if<WallPx>(&zone)) {
    block(*wall);
  }
}

std::uint32_t PassableGrid::free_pixels() const noexcept {
  int count = 0;
  for (const std::uint64_t word : words_) {
    count += std::popcount(word);
  }
  return static_cast<std::uint32_t>(count);
}

// Blocks the shape's pixels in a row, given about where they begin and end.
template <class Shape>
void PassableGrid::block_row(const Shape& shape, int row, double low, double high) noexcept {
  const Span fan = fan_[static_cast<std::size_t>(row)];
  int first = first_from(low - 1.0, fan.first, fan.last + 1);
  int last = last_from(high + 1.0, fan.first - 1, fan.last);
  while (first <= last && !shape.contains(first, row)) {
    ++first;
  }
  if (first > last) {
    return;
  }
  while (!shape.contains(last, row)) {  // ends at `first`, which is inside
    --last;
  }
  while (first > fan.first && shape.contains(first - 1, row)) {
    --first;
  }
  while (last < fan.last && shape.contains(last + 1, row)) {
    ++last;
  }
  block_span(row, {first, last});
}

void PassableGrid::block_interior(const WallPx& wall) noexcept {
  double top = kInfinity;
  double bottom = -kInfinity;
  for (std::uint32_t i = 0; i < wall.vertex_count; ++i) {
    top = std::min(top, wall.vertices[i].row);
    bottom = std::max(bottom, wall.vertices[i].row);
  }
  const Rows rows = rows_between(top, bottom);
  for (int row = rows.first; row < rows.end; ++row) {
    std::array<Crossing, kMaxVertices> crossings;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < wall.edge_count(); ++i) {
      if (const std::optional<Crossing> crossing = crossing_of(wall.edge(i), row)) {
        crossings[count++] = *crossing;
      }
    }
    std::sort(crossings.begin(), crossings.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Crossing& l, const Crossing& r) { return l.column < r.column; });
    const Span fan = fan_[static_cast<std::size_t>(row)];
    int winding = 0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      winding += crossings[i].winding;
      if (winding != 0) {  // from this crossing on, up to the pixel before the next
        block_span(row, {first_from(crossings[i].column, fan.first, fan.last + 1),
                         first_from(crossings[i + 1].column, fan.first, fan.last + 1) - 1});
      }
    }
  }
}

void PassableGrid::block_span(int row, Span span) noexcept {
  if (span.first > span.last) {
    return;
  }
  const auto first = static_cast<std::size_t>(span.first + 1);
  const auto last = static_cast<std::size_t>(span.last + 1);
  const std::uint64_t from_first = ~std::uint64_t{0} << (first % 64);
  const std::uint64_t to_last = ~std::uint64_t{0} >> (63 - last % 64);
  std::uint64_t* words = words_.data() + row_start(row);
  if (first / 64 == last / 64) {
    words[first / 64] &= ~(from_first & to_last);
    return;
  }
  words[first / 64] &= ~from_first;
  for (std::size_t i = first / 64 + 1; i < last / 64; ++i) {
    words[i] = 0;
  }
  words[last / 64] &= ~to_last;
}

}  // namespace lodesman
