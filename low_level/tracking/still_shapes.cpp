// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/still_shapes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lodesman {
namespace {

using TileRows = EvidenceGrid::TileRows;

constexpr int kTile = EvidenceGrid::kTile;
constexpr double kTile_m = kTile * EvidenceGrid::kCell_m;
static_assert(kTile % 2 == 0, "two tiles beside each other fill a row of the next level");
static_assert(2 * (kTile + 1) <= static_cast<int>(kMaxVertices),
              "a hull has a corner at most at each end of each line between rows");

// Distances beyond which 3 m tiles are taken together: each 0.7 of the one before, at last any.
constexpr int kReaches = 26;
constexpr double kFarthestReach_m = 64.0;

// An id: the bit that all have, how large the tile is (0: its components apart), the component's
// number in it, and the tile's place.
constexpr int kPlaceBits = 10;
constexpr int kNumberBits = 6;
constexpr std::uint32_t kBoxCode = 7;  // everything, as one
constexpr std::uint32_t kMostParts = (kTile / 2) * (kTile / 2);
static_assert(kMostParts < 1U << kNumberBits);

std::uint32_t still_id(std::uint32_t code, std::uint32_t number, int x, int y) noexcept {
  constexpr std::uint32_t kPlaces = (1U << kPlaceBits) - 1;
  return StillShapes::kIdBit | code << (kNumberBits + 2 * kPlaceBits) | number << (2 * kPlaceBits) |
         (static_cast<std::uint32_t>(y) & kPlaces) << kPlaceBits |
         (static_cast<std::uint32_t>(x) & kPlaces);
}

double reach_m(int step) noexcept {
  return step + 1 < kReaches ? kFarthestReach_m * std::pow(0.5, 0.5 * step) : 0.0;
}

unsigned widened(unsigned bits) noexcept { return bits | bits << 1 | bits >> 1; }

bool any_cell(const TileRows& rows) noexcept {
  return std::any_of(rows.begin(), rows.end(), [](std::uint16_t bits) { return bits != 0; });
}

// The component (8-connected) of the first cell from the south-west, taken out of `rows`.
TileRows take_component(TileRows& rows) noexcept {
  TileRows taken{};
  std::size_t first = 0;
  while (rows[first] == 0) {
    ++first;
  }
  taken[first] = static_cast<std::uint16_t>(rows[first] & (~rows[first] + 1));  // its lowest bit
  for (bool grown = true; grown;) {
    grown = false;
    const auto grow = [&](std::size_t j) {
      const unsigned below = j > 0 ? taken[j - 1] : 0U;
      const unsigned above = j + 1 < rows.size() ? taken[j + 1] : 0U;
      const unsigned bits = widened(taken[j] | below | above) & rows[j];
      grown = grown || bits != taken[j];
      taken[j] = static_cast<std::uint16_t>(bits);
    };
    for (std::size_t j = first; j < rows.size(); ++j) {
      grow(j);
    }
    for (std::size_t j = rows.size(); j-- > first;) {
      grow(j);
    }
  }
  for (std::size_t j = first; j < rows.size(); ++j) {
    rows[j] = static_cast<std::uint16_t>(rows[j] & ~taken[j]);
  }
  return taken;
}

std::uint32_t count_components(TileRows rows) noexcept {
  std::uint32_t count = 0;
  for (; any_cell(rows); ++count) {
    take_component(rows);
  }
  return count;
}

// Takes out the cells that have none beside them and were hit once.
void drop_lone_hits(const EvidenceGrid& grid, int x, int y, TileRows& rows) noexcept {
  const TileRows all = rows;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const unsigned below = j > 0 ? all[j - 1] : 0U;
    const unsigned above = j + 1 < all.size() ? all[j + 1] : 0U;
    const unsigned here = all[j];
    for (unsigned lone = here & ~(here << 1 | here >> 1 | widened(below | above)); lone != 0;
         lone &= lone - 1) {
      if (grid.is_lone_hit(x * kTile + std::countr_zero(lone), y * kTile + static_cast<int>(j))) {
        rows[j] = static_cast<std::uint16_t>(rows[j] & ~(lone & (~lone + 1)));
      }
    }
  }
}

// A row of half as many cells, each of two beside each other.
unsigned halved(unsigned bits) noexcept {
  bits = (bits | bits >> 1) & 0x5555U;
  bits = (bits | bits >> 1) & 0x3333U;
  bits = (bits | bits >> 2) & 0x0f0fU;
  return (bits | bits >> 4) & 0x00ffU;
}

double gap_to(double at, double low, double high) noexcept {
  return std::max({low - at, at - high, 0.0});
}

// To the nearest of the rows' spans.
double away_from_rows_m(const TileRows& rows, double corner_x_m, double corner_y_m, double cell_m,
                        const Eigen::Vector2d& p) noexcept {
  double least2 = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < rows.size(); ++j) {
    if (rows[j] != 0) {
      const double west = corner_x_m + cell_m * std::countr_zero(rows[j]);
      const double east = corner_x_m + cell_m * std::bit_width(rows[j]);
      const double south = corner_y_m + cell_m * static_cast<double>(j);
      const double dx = gap_to(p.x(), west, east);
      const double dy = gap_to(p.y(), south, south + cell_m);
      least2 = std::min(least2, dx * dx + dy * dy);
    }
  }
  return std::sqrt(least2);
}

struct Corner {
  int x = 0;  // [-] cells from the tile's corner
  int y = 0;
};

// The ends of the lines between rows, each a corner if the hull turns left there.
class Hull {
 public:
  explicit Hull(const TileRows& rows) noexcept {
    for (int y = 0; y <= kTile; ++y) {
      add(rows, y, true);
    }
    chain_ = count_;
    for (int y = kTile; y >= 0; --y) {
      add(rows, y, false);
    }
  }
  [[nodiscard]] std::span<const Corner> corners() const& noexcept {
    return std::span{corners_}.first(count_);
  }

 private:
  void add(const TileRows& rows, int y, bool eastern) noexcept {
    const unsigned below = y > 0 ? rows[static_cast<std::size_t>(y - 1)] : 0U;
    const unsigned above = y < kTile ? rows[static_cast<std::size_t>(y)] : 0U;
    const unsigned bits = below | above;
    if (bits == 0) {
      return;
    }
    const Corner next{eastern ? static_cast<int>(std::bit_width(bits)) : std::countr_zero(bits), y};
    while (count_ >= chain_ + 2 && !turns_left(corners_[count_ - 2], corners_[count_ - 1], next)) {
      --count_;
    }
    corners_[count_++] = next;
  }
  static bool turns_left(const Corner& a, const Corner& b, const Corner& c) noexcept {
    return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) > 0;
  }

  std::array<Corner, kMaxVertices> corners_{};
  std::size_t count_ = 0;
  std::size_t chain_ = 0;  // where this side's corners begin
};

void add_vertex(Obstacle& shape, double x_m, double y_m) noexcept {
  shape.vertices[shape.vertex_count++] = {x_m, y_m};
}

void set_centre(Obstacle& shape) noexcept {
  for (std::uint32_t i = 0; i < shape.vertex_count; ++i) {
    shape.centre_x_m += shape.vertices[i].x_m / shape.vertex_count;
    shape.centre_y_m += shape.vertices[i].y_m / shape.vertex_count;
  }
}

}  // namespace

StillShapes::StillShapes() {
  for (int k = 0; k < kLevels; ++k) {
    const int side = (EvidenceGrid::kSide - 2) / (kTile << k) + 2;  // however the window lies
    levels_[static_cast<std::size_t>(k)].tiles.resize(static_cast<std::size_t>(side * side));
  }
  parts_.reserve(kMost);
  shapes_.reserve(kMost);
}

std::span<const Obstacle> StillShapes::trace(const EvidenceGrid& grid, const Eigen::Vector2d& from,
                                             std::uint32_t most) noexcept {
  most = std::min(most, kMost);
  shapes_.clear();
  parts_.clear();
  if (most == 0) {
    return {};
  }
  from_ = from.allFinite() ? from : Eigen::Vector2d::Zero();
  lay_levels(grid);
  read_tiles(grid);
  constexpr double kNowhere_m = std::numeric_limits<double>::infinity();
  if (count_parts(kNowhere_m) <= most) {
    list_parts(kNowhere_m);
    write_parts();
    return shapes_;
  }
  take_together();
  if (count_parts(0.0) > most) {
    write_box();
    return shapes_;
  }
  int fits = kReaches - 1;
  for (int none = -1; fits - none > 1;) {
    const int middle = (fits + none) / 2;
    (count_parts(reach_m(middle)) <= most ? fits : none) = middle;
  }
  list_parts(reach_m(fits));
  write_parts();
  return shapes_;
}

void StillShapes::lay_levels(const EvidenceGrid& grid) noexcept {
  const int last_x = EvidenceGrid::tile(grid.first_column() + EvidenceGrid::kSide - 1);
  const int last_y = EvidenceGrid::tile(grid.first_row() + EvidenceGrid::kSide - 1);
  for (int k = 0; k < kLevels; ++k) {
    Level& level = levels_[static_cast<std::size_t>(k)];
    level.x0 = EvidenceGrid::tile(grid.first_column()) >> k;
    level.y0 = EvidenceGrid::tile(grid.first_row()) >> k;
    level.columns = (last_x >> k) - level.x0 + 1;
    level.rows = (last_y >> k) - level.y0 + 1;
  }
}

void StillShapes::read_tiles(const EvidenceGrid& grid) noexcept {
  Level& level = levels_[0];
  std::size_t at = 0;
  for (int y = level.y0; y < level.y0 + level.rows; ++y) {
    for (int x = level.x0; x < level.x0 + level.columns; ++x) {
      Tile& tile = level.tiles[at++];
      tile.parts = 0;
      if (grid.occupied_in_tile(x, y) > 0) {
        tile.rows = grid.occupied_cells(x, y);
        drop_lone_hits(grid, x, y, tile.rows);
        tile.parts = count_components(tile.rows);
      }
    }
  }
  std::for_each(level.tiles.begin() + static_cast<std::ptrdiff_t>(at), level.tiles.end(),
                [](Tile& tile) { tile.parts = 0; });
}

// Each level from the one below it.
void StillShapes::take_together() noexcept {
  for (int k = 1; k < kLevels; ++k) {
    const Level& fine = levels_[static_cast<std::size_t>(k - 1)];
    Level& level = levels_[static_cast<std::size_t>(k)];
    std::fill(level.tiles.begin(), level.tiles.end(), Tile{});
    for (int i = 0; i < fine.columns * fine.rows; ++i) {
      const Tile& from = fine.tiles[static_cast<std::size_t>(i)];
      if (from.parts == 0) {
        continue;
      }
      const int x = fine.x0 + i % fine.columns;
      const int y = fine.y0 + i / fine.columns;
      Tile& into = level.tiles[static_cast<std::size_t>(((y >> 1) - level.y0) * level.columns +
                                                        (x >> 1) - level.x0)];
      into.parts += from.parts;
      for (int j = 0; j < kTile; ++j) {
        auto& row = into.rows[static_cast<std::size_t>(j / 2 + (y & 1) * kTile / 2)];
        const unsigned bits = halved(from.rows[static_cast<std::size_t>(j)]);
        row = static_cast<std::uint16_t>(row | bits << ((x & 1) * kTile / 2));
      }
    }
  }
}

// None where nothing is occupied.
const StillShapes::Tile* StillShapes::find(int level, int x, int y) const noexcept {
  const Level& in = levels_[static_cast<std::size_t>(level)];
  const int column = x - in.x0;
  const int row = y - in.y0;
  if (column < 0 || column >= in.columns || row < 0 || row >= in.rows) {
    return nullptr;
  }
  const Tile& tile = in.tiles[static_cast<std::size_t>(row * in.columns + column)];
  return tile.parts > 0 ? &tile : nullptr;
}

// Calls visit(tile, level, x, y, together) with each tile that is one polygon together, and with
// each 3 m tile whose components are apart. A tile of twice the side has to be twice as far.
template <class Visit>
// NOLINTNEXTLINE(misc-no-recursion): as deep as there are levels
void StillShapes::visit_tile(int level, int x, int y, double reach, Visit& visit) const noexcept {
  const Tile* tile = find(level, x, y);
  if (tile == nullptr) {
    return;
  }
  const double side_m = kTile_m * (1 << level);
  const double away_m = std::hypot(gap_to(from_.x(), x * side_m, (x + 1) * side_m),
                                   gap_to(from_.y(), y * side_m, (y + 1) * side_m));
  if (tile->parts > 1 && away_m >= reach * (1 << level)) {
    visit(*tile, level, x, y, true);
  } else if (level == 0) {
    visit(*tile, level, x, y, false);
  } else {
    for (int i = 0; i < 4; ++i) {
      visit_tile(level - 1, 2 * x + (i & 1), 2 * y + (i >> 1), reach, visit);
    }
  }
}

template <class Visit>
void StillShapes::visit_parts(double reach, Visit visit) const noexcept {
  const int top = std::isfinite(reach) ? kLevels - 1 : 0;
  const Level& level = levels_[static_cast<std::size_t>(top)];
  for (int y = level.y0; y < level.y0 + level.rows; ++y) {
    for (int x = level.x0; x < level.x0 + level.columns; ++x) {
      visit_tile(top, x, y, reach, visit);
    }
  }
}

std::uint32_t StillShapes::count_parts(double reach) const noexcept {
  std::uint32_t count = 0;
  visit_parts(reach, [&](const Tile& tile, int, int, int, bool together) {
    count += together ? 1 : tile.parts;
  });
  return count;
}

void StillShapes::list_parts(double reach) noexcept {
  visit_parts(reach, [&](const Tile& tile, int level, int x, int y, bool together) {
    const double cell_m = EvidenceGrid::kCell_m * (1 << level);
    TileRows left = tile.rows;
    for (std::uint32_t number = 0; number < (together ? 1 : tile.parts); ++number) {
      Part part{.rows = together ? left : take_component(left),
                .level = level,
                .x = x,
                .y = y,
                .code = together ? static_cast<std::uint32_t>(level) + 1 : 0,
                .number = number};
      part.away_m =
          away_from_rows_m(part.rows, x * kTile * cell_m, y * kTile * cell_m, cell_m, from_);
      parts_.push_back(part);
    }
  });
}

void StillShapes::write_parts() noexcept {
  std::sort(parts_.begin(), parts_.end(),
            [](const Part& a, const Part& b) { return a.away_m < b.away_m; });
  for (const Part& part : parts_) {
    const double cell_m = EvidenceGrid::kCell_m * (1 << part.level);
    const Hull hull{part.rows};
    Obstacle& shape = shapes_.emplace_back();
    shape.shape = ObstacleShape::kPolygon;
    shape.id = still_id(part.code, part.number, part.x, part.y);
    for (const Corner& corner : hull.corners()) {
      add_vertex(shape, (part.x * kTile + corner.x) * cell_m, (part.y * kTile + corner.y) * cell_m);
    }
    set_centre(shape);
  }
}

// The last resort: a box around all.
void StillShapes::write_box() noexcept {
  list_parts(0.0);  // no more than four, or it is a single cell
  double west = std::numeric_limits<double>::infinity();
  double south = west;
  double east = -west;
  double north = -west;
  for (const Part& part : parts_) {
    const double cell_m = EvidenceGrid::kCell_m * (1 << part.level);
    const Hull hull{part.rows};
    for (const Corner& corner : hull.corners()) {
      west = std::min(west, (part.x * kTile + corner.x) * cell_m);
      east = std::max(east, (part.x * kTile + corner.x) * cell_m);
      south = std::min(south, (part.y * kTile + corner.y) * cell_m);
      north = std::max(north, (part.y * kTile + corner.y) * cell_m);
    }
  }
  Obstacle& shape = shapes_.emplace_back();
  shape.shape = ObstacleShape::kPolygon;
  shape.id = still_id(kBoxCode, 0, 0, 0);
  add_vertex(shape, west, south);
  add_vertex(shape, east, south);
  add_vertex(shape, east, north);
  add_vertex(shape, west, north);
  set_centre(shape);
}

}  // namespace lodesman
