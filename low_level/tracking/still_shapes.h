// SPDX-License-Identifier: Apache-2.0
// What rests in the water, as convex polygons around the occupied cells of the evidence grid, each
// the same in every ping while its cells are. One thread; allocates when made and never after.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "low_level/tracking/evidence_grid.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

class StillShapes {
 public:
  static constexpr std::uint32_t kMost = 256;          // [-] shapes at a time
  static constexpr std::uint32_t kIdBit = 0x80000000;  // in each id, so that no mover has it

  StillShapes();

  // Nearest first, `most` (and kMost) at most, the shape and its id alone. Each component of
  // occupied cells in a tile is one; a cell that is all of it and was hit once is none. Where there
  // are more, far tiles are taken together, and the farther the larger (3 m, 6 m, ... 96 m), beyond
  // a distance that makes them fit, each as one polygon in cells that are larger by as much. Ids
  // repeat every 3 km.
  [[nodiscard]] std::span<const Obstacle> trace(const EvidenceGrid& grid,
                                                const Eigen::Vector2d& from,
                                                std::uint32_t most) noexcept;

 private:
  // Tiles of 3 m, and with every level of twice the side, each of 12 by 12 (larger) cells.
  static constexpr int kLevels = 6;

  struct Tile {
    EvidenceGrid::TileRows rows{};
    std::uint32_t parts = 0;  // [-] components of the 3 m tiles in it
  };
  struct Level {
    int x0 = 0;  // the first tile in the window
    int y0 = 0;
    int columns = 0;
    int rows = 0;
    std::vector<Tile> tiles;
  };
  struct Part {
    EvidenceGrid::TileRows rows{};
    int level = 0;
    int x = 0;  // of its tile
    int y = 0;
    std::uint32_t code = 0;    // [-] of the level in its id
    std::uint32_t number = 0;  // [-] in its tile
    double away_m = 0.0;
  };

  void lay_levels(const EvidenceGrid& grid) noexcept;
  void read_tiles(const EvidenceGrid& grid) noexcept;
  void take_together() noexcept;
  [[nodiscard]] const Tile* find(int level, int x, int y) const noexcept;
  template <class Visit>
  void visit_parts(double reach_m, Visit visit) const noexcept;
  template <class Visit>
  void visit_tile(int level, int x, int y, double reach_m, Visit& visit) const noexcept;
  [[nodiscard]] std::uint32_t count_parts(double reach_m) const noexcept;
  void list_parts(double reach_m) noexcept;
  void write_parts() noexcept;
  void write_box() noexcept;

  Eigen::Vector2d from_ = Eigen::Vector2d::Zero();
  std::array<Level, kLevels> levels_;
  std::vector<Part> parts_;
  std::vector<Obstacle> shapes_;
};

}  // namespace lodesman
