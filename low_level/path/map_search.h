// SPDX-License-Identifier: Apache-2.0
// A* over a map of any size, with the moves of moves.h and a choice of costs; for the bench, where
// maps are not the sonar's fan. Owned by one thread; it allocates, and so is not for the vehicle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "low_level/path/moves.h"
#include "mid_level/messages/path.h"

namespace lodesman {

struct MapCell {
  int column = 0;
  int row = 0;

  friend bool operator==(const MapCell&, const MapCell&) = default;
};

// Which cells of a map may be used.
class PassableMap {
 public:
  static constexpr std::size_t kMaxCells = 1U << 21U;

  // All blocked. Both sides must be above zero and their product at most kMaxCells.
  PassableMap(int width, int height);

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] bool contains(MapCell cell) const noexcept {
    return cell.column >= 0 && cell.column < width_ && cell.row >= 0 && cell.row < height_;
  }
  void set(MapCell cell, bool passable) noexcept { cells_[place_of(cell)] = passable ? 1 : 0; }
  // False outside the map.
  [[nodiscard]] bool passable(MapCell cell) const noexcept {
    return contains(cell) && cells_[place_of(cell)] != 0;
  }
  [[nodiscard]] std::uint32_t free_cells() const noexcept;
  // The nine cells round one of the map, as kMoves wants them.
  [[nodiscard]] std::uint32_t around(MapCell cell) const noexcept;

 private:
  // A blocked cell lies round the map on every side: the neighbours of every cell exist.
  [[nodiscard]] std::size_t place_of(MapCell cell) const noexcept {
    return static_cast<std::size_t>(cell.row + 1) * static_cast<std::size_t>(width_ + 2) +
           static_cast<std::size_t>(cell.column + 1);
  }

  int width_;
  int height_;
  std::vector<std::uint8_t> cells_;
};

enum class MapCosts : std::uint8_t {
  kPaper,  // 1 and 1.4
  kSqrt2,  // 1 and the square root of 2
};

struct MapSearchResult {
  PathReason reason = PathReason::kNoPath;
  std::int32_t straight_steps = 0;
  std::int32_t diagonal_steps = 0;
  std::uint32_t expansions = 0;  // cells taken from the open list
  std::vector<MapCell> path;     // start to goal; empty where not found

  [[nodiscard]] double cost(MapCosts costs) const noexcept;
  // Of the path that was found, whatever costs it is the cheapest under.
  [[nodiscard]] std::int32_t cost_10_14() const noexcept {
    return kStraightCost * straight_steps + kDiagonalCost * diagonal_steps;
  }
};

// Gives a cheapest path; always the same one for the same map, start and goal.
class MapSearch {
 public:
  // For maps of this size.
  MapSearch(int width, int height, MapCosts costs);

  // kStartBlocked and kGoalBlocked also where those do not lie on the map. With
  // `max_expansions` the search ends as kLimit; by default it never does.
  [[nodiscard]] MapSearchResult search(const PassableMap& map, MapCell start, MapCell goal,
                                       std::uint32_t max_expansions = PassableMap::kMaxCells);

 private:
  struct Node {
    std::int64_t cost = 0;       // from the start
    std::uint32_t stamp = 0;     // of the search that reached it: stamp_, or one more once expanded
    std::uint8_t direction = 0;  // of the step that reached it
  };
  struct Open {
    std::int64_t f;
    std::int64_t cost;
    std::uint32_t index;
  };
  // Of equal f the one farther from the start is taken first.
  struct Later {
    bool operator()(const Open& a, const Open& b) const noexcept {
      return a.f != b.f ? a.f > b.f : a.cost != b.cost ? a.cost < b.cost : a.index > b.index;
    }
  };

  [[nodiscard]] std::uint32_t index_of(MapCell cell) const noexcept {
    return static_cast<std::uint32_t>(cell.row * width_ + cell.column);
  }
  [[nodiscard]] MapCell cell_of(std::uint32_t index) const noexcept {
    const auto width = static_cast<std::uint32_t>(width_);
    return {static_cast<int>(index % width), static_cast<int>(index / width)};
  }

  void begin_search() noexcept;
  [[nodiscard]] std::int64_t estimate(MapCell cell, MapCell goal) const noexcept;
  void reach(MapCell cell, MapCell goal, std::int64_t cost, std::uint8_t direction);
  void expand(const PassableMap& map, MapCell cell, MapCell goal);
  void trace(MapCell start, MapCell goal, MapSearchResult& result) const;

  int width_;
  int height_;
  std::int64_t straight_;
  std::int64_t diagonal_;
  std::vector<Node> nodes_;
  std::vector<Open> open_;  // a heap
  std::uint32_t stamp_ = 0;
};

}  // namespace lodesman
