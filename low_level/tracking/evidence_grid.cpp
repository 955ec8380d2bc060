// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/evidence_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace lodesman {
namespace {

constexpr std::uint32_t kLastTick = 0x7ffffff0;  // [ms] 24 days
constexpr double kRimCells = 2.0;                // of the window that no beam is walked in
// Samples of the fan are no farther apart than this across and along it: half of the diagonal of
// one is half a cell, so that every cell whose centre is in the fan has one.
constexpr double kSampleCells = 1.0 / std::numbers::sqrt2;
constexpr int kFixedBits = 20;  // of a cell's fraction, in a walk
constexpr double kFixedOne = 1 << kFixedBits;

// A wall's corners in cells from the window's corner; an ellipse is a wall of as many as there are.
struct CellShape {
  bool open = false;  // a polyline
  std::uint32_t count = 0;
  std::array<std::array<double, 2>, kMaxVertices> corners{};  // u, v
};

// Where a line v enters and leaves the shape, in turn. A polyline's sides count there and back.
struct LineCrossings {
  std::array<double, 2 * kMaxVertices> u{};
  std::size_t count = 0;
};

void cross_sides(const CellShape& shape, double line, LineCrossings& out) noexcept {
  for (std::uint32_t i = shape.open ? 1 : 0; i < shape.count; ++i) {
    const auto& a = shape.corners[i == 0 ? shape.count - 1 : i - 1];
    const auto& b = shape.corners[i];
    if ((a[1] > line) != (b[1] > line)) {
      const double u = a[0] + (b[0] - a[0]) * (line - a[1]) / (b[1] - a[1]);
      for (int times = shape.open ? 2 : 1; times > 0; --times) {
        out.u[out.count++] = u;
      }
    }
  }
  std::sort(out.u.begin(), out.u.begin() + static_cast<std::ptrdiff_t>(out.count));
}

// Calls fill(line, first, last) with the cells whose centres are inside, line by line; where a part
// of it is so thin that it has none, with the cell of its middle, so that no thin wall has holes.
template <class Fill>
void sweep_shape(const CellShape& shape, Fill fill) noexcept {
  const auto clipped = [](double at) { return std::clamp(at, -1.0, EvidenceGrid::kSide + 1.0); };
  double low = EvidenceGrid::kSide;
  double high = 0.0;
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    low = std::min(low, clipped(shape.corners[i][1]));
    high = std::max(high, clipped(shape.corners[i][1]));
  }
  const int end = std::min(EvidenceGrid::kSide, static_cast<int>(std::ceil(high)));
  for (int line = std::max(0, static_cast<int>(std::floor(low))); line < end; ++line) {
    LineCrossings at;
    cross_sides(shape, line + 0.5, at);
    for (std::size_t i = 0; i + 1 < at.count; i += 2) {
      const int first = static_cast<int>(std::ceil(clipped(at.u[i]) - 0.5));
      const int last = static_cast<int>(std::ceil(clipped(at.u[i + 1]) - 0.5)) - 1;
      const int middle = static_cast<int>(std::floor(clipped(0.5 * (at.u[i] + at.u[i + 1]))));
      fill(line, first <= last ? first : middle, first <= last ? last : middle);
    }
  }
}

bool is_sound_shape(const Obstacle& shape) noexcept {
  if (shape.shape == ObstacleShape::kEllipse) {
    return shape.fits() && EvidenceGrid::is_place(shape.centre_x_m, shape.centre_y_m) &&
           EvidenceGrid::is_place(shape.semi_axis_first_m, shape.semi_axis_second_m) &&
           std::isfinite(shape.angle_rad);
  }
  return shape.fits() && shape.vertex_count <= kMaxVertices &&
         std::all_of(shape.vertices.begin(), shape.vertices.begin() + shape.vertex_count,
                     [](const Vertex& at) { return EvidenceGrid::is_place(at.x_m, at.y_m); });
}

CellShape in_cells(const Obstacle& shape, int column0, int row0) noexcept {
  CellShape out;
  const auto add = [&](double x_m, double y_m) {
    out.corners[out.count++] = {x_m / EvidenceGrid::kCell_m - column0,
                                y_m / EvidenceGrid::kCell_m - row0};
  };
  out.open = shape.shape == ObstacleShape::kPolyline;
  if (shape.shape != ObstacleShape::kEllipse) {
    for (std::uint32_t i = 0; i < shape.vertex_count; ++i) {
      add(shape.vertices[i].x_m, shape.vertices[i].y_m);
    }
    return out;
  }
  const double sine = std::sin(shape.angle_rad);
  const double cosine = std::cos(shape.angle_rad);
  for (std::size_t i = 0; i < kMaxVertices; ++i) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / kMaxVertices;
    const double first = shape.semi_axis_first_m * std::cos(turn);
    const double second = shape.semi_axis_second_m * std::sin(turn);
    add(shape.centre_x_m + first * sine + second * cosine,
        shape.centre_y_m + first * cosine - second * sine);
  }
  return out;
}

// The cells of a shape; a shape that is none has none.
void rasterise(const Obstacle& shape, int column0, int row0,
               EvidenceGrid::WindowCells& cells) noexcept {
  if (!is_sound_shape(shape)) {
    return;
  }
  CellShape in_window = in_cells(shape, column0, row0);
  sweep_shape(in_window, [&](int v, int first, int last) { cells.add_run(v, first, last); });
  // Across, for parts that are too flat for a row's middle.
  for (auto& corner : in_window.corners) {
    std::swap(corner[0], corner[1]);
  }
  sweep_shape(in_window, [&](int u, int first, int last) {
    if (first == last) {
      cells.add_run(first, u, u);
    }
  });
  const bool ellipse = shape.shape == ObstacleShape::kEllipse;
  for (std::uint32_t i = 0; i < (ellipse ? 1 : shape.vertex_count); ++i) {
    const Vertex at = ellipse ? Vertex{shape.centre_x_m, shape.centre_y_m} : shape.vertices[i];
    const int u = EvidenceGrid::cell(at.x_m) - column0;
    cells.add_run(EvidenceGrid::cell(at.y_m) - row0, u, u);
  }
}

// A unit vector, or what turns one: clockwise.
struct Turn {
  double north = 1.0;
  double east = 0.0;

  static Turn by(double rad) noexcept { return {std::cos(rad), std::sin(rad)}; }
  Turn operator*(const Turn& by) const noexcept {
    return {north * by.north - east * by.east, north * by.east + east * by.north};
  }
};

// Whether any of the cells is about to be occupied no more.
bool any_falls(const std::int8_t* __restrict evidence, const std::uint8_t* __restrict marks,
               std::size_t count) noexcept {
  std::uint8_t falls = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool above = evidence[i] >= EvidenceGrid::kOccupiedAt;
    const bool below = evidence[i] < EvidenceGrid::kOccupiedAt + EvidenceGrid::kMiss;
    falls = static_cast<std::uint8_t>(falls | (above && below ? marks[i] : 0));
  }
  return falls != 0;
}

void lower_marked(std::int8_t* __restrict evidence, std::uint32_t* __restrict seen,
                  const std::uint8_t* __restrict marks, std::size_t count,
                  std::uint32_t stamp) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const auto lowered = static_cast<std::int8_t>(evidence[i] - marks[i]);
    evidence[i] = std::max(lowered, std::int8_t{EvidenceGrid::kMostFree});
  }
  for (std::size_t i = 0; i < count; ++i) {
    seen[i] = marks[i] != 0 ? stamp : seen[i];
  }
}

}  // namespace

EvidenceGrid::EvidenceGrid() : evidence_(kCells), seen_(kCells), marks_(kCells) {}

void EvidenceGrid::forget() noexcept {
  std::fill(evidence_.begin(), evidence_.end(), std::int8_t{0});
  std::fill(seen_.begin(), seen_.end(), 0U);
  tile_counts_.fill(0);
}

void EvidenceGrid::forget_box(int column, int row, int columns, int rows) noexcept {
  for (int j = row; j < row + rows; ++j) {
    for (int i = column; i < column + columns; ++i) {
      set_evidence(i, j, 0);
      seen_[slot(i, j)] = 0;
    }
  }
}

// The window's middle to that place. What leaves it is forgotten, and its slots are those of what
// comes in.
void EvidenceGrid::roll_to(const Eigen::Vector2d& p) noexcept {
  const int east = cell(p.x()) - kSide / 2 - column0_;
  const int north = cell(p.y()) - kSide / 2 - row0_;
  if (std::abs(east) >= kSide || std::abs(north) >= kSide) {
    forget();
  } else {
    forget_box(east > 0 ? column0_ : column0_ + kSide + east, row0_, std::abs(east), kSide);
    forget_box(column0_, north > 0 ? row0_ : row0_ + kSide + north, kSide, std::abs(north));
  }
  column0_ += east;
  row0_ += north;
}

// Never back.
void EvidenceGrid::advance_clock(double at_s) noexcept {
  if (!std::isfinite(at_s)) {
    return;
  }
  const double tick = std::isnan(epoch_s_) ? kLastTick : (at_s - epoch_s_) * 1e3 + 1.0;
  if (tick >= kLastTick) {  // all that was seen was seen before
    std::for_each(seen_.begin(), seen_.end(), [](std::uint32_t& seen) { seen = seen > 0 ? 1 : 0; });
    epoch_s_ = at_s;
    tick_ = 1;
  } else if (tick > tick_) {
    tick_ = static_cast<std::uint32_t>(tick);
  }
}

void EvidenceGrid::look(const Look& look) noexcept {
  const Eigen::Vector2d& head = look.pose.p_WV.xy_m;
  if (!is_place(head.x(), head.y()) || !std::isfinite(look.pose.heading.rad())) {
    return;
  }
  roll_to(head);
  tick_ += 1;
  advance_clock(look.at_s);
  if (look.is_fan()) {
    mark_fan(look);
    take_marks();
  }
}

// Each beam in parts: the farther away, the more lines beside each other it takes.
void EvidenceGrid::mark_fan(const Look& look) noexcept {
  // More lines than a beam that is the widest takes in the window's corner.
  constexpr std::size_t kMostLines = 80;
  struct Lines {
    Turn first;  // from the beam's middle
    Turn next;
    bool known = false;
  };
  std::array<Lines, kMostLines> table;
  const double width_rad = look.beam_step_rad;
  const double part = kSampleCells / width_rad;  // [-] cells of range, for one line more
  const double near = std::min(look.nearest_m / kCell_m, static_cast<double>(kSide));
  Turn middle = Turn::by(look.pose.heading.rad() + look.first_bearing_rad);
  const Turn next_beam = Turn::by(width_rad);
  const double head_u = look.pose.p_WV.xy_m.x() / kCell_m - column0_;
  const double head_v = look.pose.p_WV.xy_m.y() / kCell_m - row0_;
  marked_ = {kSide, kSide, -1, -1};
  for (const float clear_m : look.clear_m) {
    // To the window's rim at most, which a beam's sides cross a little earlier than its middle.
    const double steepest = std::max(std::abs(middle.north), std::abs(middle.east));
    const double rim = (0.5 * kSide - kRimCells) / std::min(1.0, steepest + 0.5 * width_rad);
    const double seen_m = std::min(static_cast<double>(clear_m), look.farthest_m);
    const double end = std::min(seen_m / kCell_m - 0.5, rim);
    double from = near;
    for (auto count = 1 + static_cast<std::size_t>(near / part); from < end; ++count) {
      Lines& lines = table[count];
      if (!lines.known) {
        const double apart_rad = width_rad / static_cast<double>(count);
        lines = {Turn::by(0.5 * (apart_rad - width_rad)), Turn::by(apart_rad), true};
      }
      const double to = std::min(end, std::max(from, static_cast<double>(count) * part));
      Turn along = middle * lines.first;
      for (std::size_t line = 0; to > from && line < count; ++line, along = along * lines.next) {
        mark_line({head_u, head_v}, {along.east, along.north}, from, to);
      }
      from = to;
    }
    middle = middle * next_beam;
  }
}

// From range to range, in cells: the middles of its samples.
void EvidenceGrid::mark_line(const Eigen::Vector2d& head, const Eigen::Vector2d& along, double from,
                             double to) noexcept {
  const auto steps = static_cast<std::int32_t>((to - from) / kSampleCells) + 1;
  const double step = (to - from) / steps;
  const Eigen::Vector2d start = (head + (from + 0.5 * step) * along) * kFixedOne;
  const Eigen::Vector2d stride = step * kFixedOne * along;
  auto u = static_cast<std::int32_t>(start.x());
  auto v = static_cast<std::int32_t>(start.y());
  const auto du = static_cast<std::int32_t>(stride.x());
  const auto dv = static_cast<std::int32_t>(stride.y());
  const std::int32_t last_u = u + (steps - 1) * du;
  const std::int32_t last_v = v + (steps - 1) * dv;
  marked_.u0 = std::min(marked_.u0, std::min(u, last_u) >> kFixedBits);
  marked_.v0 = std::min(marked_.v0, std::min(v, last_v) >> kFixedBits);
  marked_.u1 = std::max(marked_.u1, std::max(u, last_u) >> kFixedBits);
  marked_.v1 = std::max(marked_.v1, std::max(v, last_v) >> kFixedBits);
  std::uint8_t* marks = marks_.data();
  for (std::int32_t i = 0; i < steps; ++i, u += du, v += dv) {
    marks[(v >> kFixedBits) * kSide + (u >> kFixedBits)] = kMiss;
  }
}

void EvidenceGrid::take_marks() noexcept {
  const int columns = marked_.u1 - marked_.u0 + 1;
  const int column = column0_ + marked_.u0;
  for (int v = marked_.v0; v <= marked_.v1; ++v) {
    const int row = row0_ + v;
    const int first = std::min(columns, kSide - remainder_of(column, kSide));
    const auto mark = static_cast<std::size_t>(v * kSide + marked_.u0);
    lower_run(mark, static_cast<std::size_t>(first), column, row);
    lower_run(mark + static_cast<std::size_t>(first), static_cast<std::size_t>(columns - first),
              column + first, row);
    std::fill_n(marks_.data() + mark, columns, std::uint8_t{0});
  }
}

// Cells beside each other in their slots too.
void EvidenceGrid::lower_run(std::size_t mark, std::size_t count, int column, int row) noexcept {
  if (count == 0) {
    return;
  }
  const std::size_t at = slot(column, row);
  const std::uint8_t* marks = marks_.data() + mark;
  if (any_falls(evidence_.data() + at, marks, count)) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::int8_t evidence = evidence_[at + i];
      if (marks[i] != 0 && evidence >= kOccupiedAt && evidence < kOccupiedAt + kMiss) {
        std::int16_t& occupied = count_around(column + static_cast<int>(i), row);
        occupied = static_cast<std::int16_t>(occupied - 1);
      }
    }
  }
  lower_marked(evidence_.data() + at, seen_.data() + at, marks, count, 2 * tick_);
}

void EvidenceGrid::add(const Obstacle& shape, double at_s) noexcept {
  advance_clock(at_s);
  WindowCells cells;
  rasterise(shape, column0_, row0_, cells);
  cells.for_each([&](int u, int v) {
    std::uint32_t& seen = seen_[slot(column0_ + u, row0_ + v)];
    if (seen == 2 * tick_ + 1) {
      return;  // another shape of this ping holds it too
    }
    // An echo weighs more than a beam that passed by it: the look is taken back.
    const int gain = kHit + (seen == 2 * tick_ ? kMiss : 0);
    const int raised = std::min(evidence(column0_ + u, row0_ + v) + gain, kMostOccupied);
    set_evidence(column0_ + u, row0_ + v, raised);
    seen = 2 * tick_ + 1;
  });
}

void EvidenceGrid::clear(const Obstacle& shape) noexcept {
  WindowCells cells;
  rasterise(shape, column0_, row0_, cells);
  cells.for_each([&](int u, int v) {
    for (int row = row0_ + v - 1; row <= row0_ + v + 1; ++row) {
      for (int column = column0_ + u - 1; column <= column0_ + u + 1; ++column) {
        if (holds(column, row)) {
          set_evidence(column, row, std::min(evidence(column, row), kFreeAt));
        }
      }
    }
  });
}

EvidenceGrid::Shares EvidenceGrid::shares_under(const Obstacle& shape) const noexcept {
  WindowCells cells;
  rasterise(shape, column0_, row0_, cells);
  int occupied = 0;
  int free = 0;
  int all = 0;
  cells.for_each([&](int u, int v) {
    const int value = evidence(column0_ + u, row0_ + v);
    occupied += value >= kOccupiedAt ? 1 : 0;
    free += value <= kFreeAt ? 1 : 0;
    ++all;
  });
  if (all == 0) {
    return {};
  }
  return {1.0 * occupied / all, 1.0 * free / all, 1.0 * (all - occupied - free) / all};
}

EvidenceGrid::TileRows EvidenceGrid::occupied_cells(int tile_x, int tile_y) const noexcept {
  TileRows rows{};
  const int first = std::max(tile_x * kTile, column0_);
  const int end = std::min(tile_x * kTile + kTile, column0_ + kSide);
  for (int j = 0; j < kTile && first < end; ++j) {
    const int row = tile_y * kTile + j;
    const std::int8_t* line = evidence_.data() + slot(0, row);
    int at = remainder_of(first, kSide);
    unsigned bits = 0;
    for (int i = first - tile_x * kTile; i < end - tile_x * kTile; ++i) {
      bits |= (line[at] >= kOccupiedAt ? 1U : 0U) << i;
      at = at + 1 < kSide ? at + 1 : 0;
    }
    rows[static_cast<std::size_t>(j)] =
        static_cast<std::uint16_t>(row >= row0_ && row < row0_ + kSide ? bits : 0);
  }
  return rows;
}

}  // namespace lodesman
