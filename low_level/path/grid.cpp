// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "low_level/path/ellipse_raster.h"
#include "low_level/path/line_ends.h"

namespace lodesman {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// The places of the fan in each line of the view. Lines that cross the fan cross it once.
template <class Holds>
std::vector<LineSpan> outlines_of(int lines, int length, Holds holds) {
  std::vector<LineSpan> outlines(static_cast<std::size_t>(lines));
  for (int line = 0; line < lines; ++line) {
    LineSpan& span = outlines[static_cast<std::size_t>(line)];
    span = {length, -1};
    for (int place = 0; place < length; ++place) {
      if (holds(line, place)) {
        span = {std::min(span.first, place), place};
      }
    }
    if (span.last < 0) {
      span = {};
    }
  }
  return outlines;
}

// Turns a square of bits about its diagonal: bit c of word r becomes bit r of word c. Halves are
// exchanged, then quarters within the halves, down to single bits.
void transpose(std::array<std::uint64_t, 64>& square) noexcept {
  std::uint64_t mask = 0x00000000FFFFFFFFU;
  for (unsigned size = 32; size != 0; size /= 2, mask ^= mask << size) {
    for (unsigned i = 0; i < 64; i = (i + size + 1) & ~size) {
      const std::uint64_t moved = (square[i] >> size ^ square[i + size]) & mask;
      square[i] ^= moved << size;
      square[i + size] ^= moved;
    }
  }
}

}  // namespace

PassableGrid::PassableGrid(const FanShape& fan)
    : fan_{fan},
      rows_{fan.columns, outlines_of(fan.rows, fan.columns,
                                     [&](int row, int column) { return fan.holds(column, row); })},
      columns_{fan.rows, outlines_of(fan.columns, fan.rows,
                                     [&](int column, int row) { return fan.holds(column, row); })} {
}

void PassableGrid::clear() noexcept {
  rows_.clear();
  columns_.clear();
}

void PassableGrid::block_all() noexcept {
  rows_.block_all();
  columns_.block_all();
}

void PassableGrid::block(PathPixel pixel) noexcept {
  if (!fan_.holds(pixel.column, pixel.row)) {
    return;
  }
  const LineSpan row{pixel.row, pixel.row};
  const LineSpan column{pixel.column, pixel.column};
  rows_.announce(row, column);
  rows_.block(pixel.row, column);
  columns_.announce(column, row);
  columns_.block(pixel.column, row);
}

void PassableGrid::block(const EllipsePx& ellipse) noexcept { draw(ellipse, rows_, columns_); }

void PassableGrid::block(const CapsulePx& capsule) noexcept {
  block(WallPx{{capsule.from, capsule.to}, 2, capsule.radius, false});
}

void PassableGrid::block(const WallPx& wall) noexcept {
  Range rows;
  Range columns;
  for (std::uint32_t i = 0; i < wall.vertex_count; ++i) {
    const PointPx& vertex = wall.vertices[i];
    rows.include(vertex.row - wall.radius, vertex.row + wall.radius);
    columns.include(vertex.column - wall.radius, vertex.column + wall.radius);
  }
  const LineSpan row_bounds = lines_between(rows.low, rows.high, fan_.rows);
  const LineSpan column_bounds = lines_between(columns.low, columns.high, fan_.columns);
  rows_.announce(row_bounds, column_bounds);
  for (std::uint32_t i = 0; i < wall.edge_count(); ++i) {
    block_capsule_rows(wall.edge(i));
  }
  if (wall.closed) {
    block_interior_rows(wall);
  }
  copy_to_columns(row_bounds, column_bounds);
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
  for (int row = 0; row < fan_.rows; ++row) {
    for (int i = 0; i < rows_.words_per_line(); ++i) {
      count += std::popcount(rows_.word(row, i));
    }
  }
  return static_cast<std::uint32_t>(count);
}

void PassableGrid::block_capsule_rows(const CapsulePx& capsule) noexcept {
  const double top = std::min(capsule.from.row, capsule.to.row) - capsule.radius;
  const double bottom = std::max(capsule.from.row, capsule.to.row) + capsule.radius;
  const LineSpan rows = lines_between(top, bottom, fan_.rows);
  for (int row = rows.first; row <= rows.last; ++row) {
    const Range range = capsule_range(capsule, row);
    block_row_span(row, exact_span(rows_.outline(row), range.low, range.high,
                                   [&](int column) { return capsule.contains(column, row); }));
  }
}

void PassableGrid::block_interior_rows(const WallPx& wall) noexcept {
  double top = kInfinity;
  double bottom = -kInfinity;
  for (std::uint32_t i = 0; i < wall.vertex_count; ++i) {
    top = std::min(top, wall.vertices[i].row);
    bottom = std::max(bottom, wall.vertices[i].row);
  }
  const LineSpan rows = lines_between(top, bottom, fan_.rows);
  for (int row = rows.first; row <= rows.last; ++row) {
    std::array<Crossing, kMaxVertices> crossings;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < wall.edge_count(); ++i) {
      if (const std::optional<Crossing> crossing = crossing_of(wall.edge(i), row)) {
        crossings[count++] = *crossing;
      }
    }
    std::sort(crossings.begin(), crossings.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Crossing& l, const Crossing& r) { return l.column < r.column; });
    const LineSpan fan = rows_.outline(row);
    int winding = 0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      winding += crossings[i].winding;
      if (winding != 0) {  // from this crossing on, up to the pixel before the next
        block_row_span(row, {first_from(crossings[i].column, fan.first, fan.last + 1),
                             first_from(crossings[i + 1].column, fan.first, fan.last + 1) - 1});
      }
    }
  }
}

void PassableGrid::block_row_span(int row, LineSpan span) noexcept {
  if (span.first <= span.last) {
    rows_.block(row, span);
  }
}

// Takes what is blocked in some rows and columns over into the columns.
void PassableGrid::copy_to_columns(LineSpan rows, LineSpan columns) noexcept {
  columns_.announce(columns, rows);
  for (int top = rows.first & ~63; top <= rows.last; top += 64) {
    for (int left = columns.first & ~63; left <= columns.last; left += 64) {
      std::array<std::uint64_t, 64> square{};
      for (int i = 0; i < std::min(64, fan_.rows - top); ++i) {
        square[static_cast<std::size_t>(i)] = rows_.word(top + i, left / 64);
      }
      transpose(square);
      for (int i = 0; i < std::min(64, fan_.columns - left); ++i) {
        columns_.keep(left + i, top / 64, square[static_cast<std::size_t>(i)]);
      }
    }
  }
}

}  // namespace lodesman
