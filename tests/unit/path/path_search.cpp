// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/path_search.h"

#include <algorithm>
#include <iostream>
#include <random>
#include <string>

#include "tests/support/catch.h"
#include "tests/unit/path/reference_search.h"

namespace lodesman::testing {
namespace {

constexpr PathPixel kApex{kApexColumn, kApexRow};

// A walled window of random obstacles somewhere in the fan, all else being as it was.
Window random_window(std::mt19937& random, PassableGrid& grid) {
  const auto between = [&random](int low, int high) {
    return std::uniform_int_distribution<int>{low, high}(random);
  };
  const Window window{between(380, 450), between(150, 330), between(3, 32), between(3, 32)};
  grid.clear();
  for (int row = window.row - 1; row <= window.row + window.rows; ++row) {
    for (int column = window.column - 1; column <= window.column + window.columns; ++column) {
      if (!window.holds(pixel(column, row))) {
        grid.block(pixel(column, row));
      }
    }
  }
  const int blocked = window.columns * window.rows * between(0, 45) / 100;
  for (int i = 0; i < blocked; ++i) {
    grid.block(pixel(window.column + between(0, window.columns - 1),
                     window.row + between(0, window.rows - 1)));
  }
  return window;
}

PathPixel random_pixel(std::mt19937& random, const Window& window) {
  std::uniform_int_distribution<int> column{window.column, window.column + window.columns - 1};
  std::uniform_int_distribution<int> row{window.row, window.row + window.rows - 1};
  return pixel(column(random), row(random));
}

// Corridors one pixel wide, to and fro between rows 100 and 400, joined at alternating ends.
void draw_corridors(PassableGrid& grid) {
  grid.clear();
  for (int column = 282; column <= 584; ++column) {
    grid.block(pixel(column, 99));
    grid.block(pixel(column, 401));
  }
  for (int row = 100; row <= 400; ++row) {
    grid.block(pixel(282, row));
    grid.block(pixel(584, row));
  }
  for (int row = 101; row <= 399; row += 2) {
    const int gap = row % 4 == 1 ? 283 : 583;
    for (int column = 283; column <= 583; ++column) {
      if (column != gap) {
        grid.block(pixel(column, row));
      }
    }
  }
}

TEST_CASE("search: on random grids the path is the one that the rule and Dijkstra give",
          "[low_level][path]") {
  constexpr unsigned kSeed = 20251;
  std::cout << "seed " << kSeed << '\n';
  std::mt19937 random{kSeed};
  PassableGrid grid;
  PathSearch search;
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const Window window = random_window(random, grid);
    const PathPixel start = random_pixel(random, window);
    const PathPixel goal = random_pixel(random, window);
    CAPTURE(i, start.column, start.row, goal.column, goal.row);
    const SearchResult result = search.search(grid, start, goal);
    const std::vector<int> costs = dijkstra(grid, window, goal);
    if (!grid.passable(start.column, start.row)) {
      REQUIRE(result.reason == PathReason::kStartBlocked);
    } else if (!grid.passable(goal.column, goal.row)) {
      REQUIRE(result.reason == PathReason::kGoalBlocked);
    } else if (costs[window.index(start)] == kUnreached) {
      REQUIRE(result.reason == PathReason::kNoPath);
    } else {
      REQUIRE(result.reason == PathReason::kFound);
      REQUIRE(result.cost_10_14 == costs[window.index(start)]);
      require_walkable(grid, result.path, start, goal, result.cost_10_14);
      REQUIRE(same(result.path, path_by_rule(grid, window, costs, start, goal)));
      ++found;
    }
  }
  REQUIRE(found > 150);
}

TEST_CASE("search: each reason is given, and a blocked start comes before a goal out of view",
          "[low_level][path]") {
  PassableGrid grid;
  PathSearch search{GENERATE(Geometry::k4, Geometry::k8)};
  const PathPixel goal = pixel(433, 100);
  REQUIRE(search.search(grid, kApex, goal).reason == PathReason::kFound);
  REQUIRE(search.search(grid, kApex, pixel(0, 499)).reason == PathReason::kGoalOutOfView);
  REQUIRE(search.search(grid, kApex, pixel(433, -1)).reason == PathReason::kGoalOutOfView);
  REQUIRE(search.search(grid, kApex, pixel(-1, -1)).reason == PathReason::kGoalOutOfView);
  REQUIRE(search.search(grid, pixel(-1, -1), goal).reason == PathReason::kStartBlocked);

  grid.block(EllipsePx{{433.0, 100.0}, 10.0, 10.0});
  REQUIRE(search.search(grid, kApex, goal).reason == PathReason::kGoalBlocked);
  grid.clear();
  for (int column = 0; column < kViewColumns; ++column) {
    grid.block(pixel(column, 300));
  }
  const SearchResult none = search.search(grid, kApex, goal);
  REQUIRE(none.reason == PathReason::kNoPath);
  REQUIRE(none.expansions > 0);
  REQUIRE(none.path.empty());

  grid.block(kApex);
  REQUIRE(search.search(grid, kApex, goal).reason == PathReason::kStartBlocked);
  REQUIRE(search.search(grid, kApex, pixel(0, 499)).reason == PathReason::kStartBlocked);
}

TEST_CASE("search: a start that is the goal is a path of one pixel", "[low_level][path]") {
  PassableGrid grid;
  PathSearch search{GENERATE(Geometry::k4, Geometry::k8)};
  const SearchResult result = search.search(grid, kApex, kApex);
  REQUIRE(result.reason == PathReason::kFound);
  REQUIRE(result.cost_10_14 == 0);
  REQUIRE(result.path.size() == 1);
}

TEST_CASE("search: a clear way straight ahead takes nothing but the goal from the open list",
          "[low_level][path]") {
  PassableGrid grid;
  PathSearch search;
  const SearchResult result = search.search(grid, kApex, pixel(433, 100));
  REQUIRE(result.cost_10_14 == 3990);
  REQUIRE(result.path.size() == 400);
  REQUIRE(result.expansions == 1);
}

TEST_CASE("search: no diagonal step passes a blocked corner", "[low_level][path]") {
  PassableGrid grid;
  PathSearch search;
  grid.block(pixel(434, 300));
  const SearchResult one = search.search(grid, pixel(433, 300), pixel(434, 299));
  REQUIRE(one.cost_10_14 == 20);
  REQUIRE(one.path.size() == 3);
  grid.block(pixel(433, 299));
  REQUIRE(search.search(grid, pixel(433, 300), pixel(434, 299)).cost_10_14 > 20);
}

TEST_CASE("search: a search that meets its bound of expansions ends with kLimit",
          "[low_level][path]") {
  const Geometry geometry = GENERATE(Geometry::k4, Geometry::k8);
  PassableGrid grid;
  grid.block(EllipsePx{{433.0, 300.0}, 60.0, 60.0});
  const PathPixel goal = pixel(433, 100);
  const std::uint32_t needed = PathSearch{geometry}.search(grid, kApex, goal).expansions;
  REQUIRE(needed > 1);
  PathSearch enough{geometry, SearchLimits{needed}};
  REQUIRE(enough.search(grid, kApex, goal).reason == PathReason::kFound);

  PathSearch limited{geometry, SearchLimits{needed - 1}};
  const SearchResult result = limited.search(grid, kApex, goal);
  REQUIRE(result.reason == PathReason::kLimit);
  REQUIRE(result.expansions == needed - 1);
  REQUIRE(result.cost_10_14 == 0);
  REQUIRE(result.path.empty());
  REQUIRE(limited.search(grid, kApex, pixel(433, 498)).reason == PathReason::kFound);
}

TEST_CASE("search: a path of kMaxPathPixels is given, and a longer one is kLimit",
          "[low_level][path]") {
  PassableGrid grid;
  PathSearch search;
  draw_corridors(grid);
  const PathPixel goal = pixel(433, 100);
  REQUIRE(search.search(grid, pixel(433, 400), goal).reason == PathReason::kLimit);

  // Down one corridor after another the path grows; in one of them it becomes just too long.
  int row = 100;
  while (search.search(grid, pixel(433, row), goal).reason == PathReason::kFound) {
    row += 2;
    REQUIRE(row <= 400);
  }
  std::size_t longest = 0;
  for (int column = 283; column <= 583; ++column) {
    for (const int tried : {row - 2, row}) {
      const SearchResult result = search.search(grid, pixel(column, tried), goal);
      REQUIRE(result.reason != PathReason::kNoPath);
      longest = std::max(longest, result.path.size());
    }
  }
  REQUIRE(longest == kMaxPathPixels);
}

TEST_CASE("search: what was searched before changes nothing", "[low_level][path]") {
  PassableGrid grid;
  grid.block(EllipsePx{{433.0, 300.0}, 60.0, 60.0});
  PathSearch fresh;
  PathSearch used;
  for (const int column : {300, 500, 433}) {
    REQUIRE(used.search(grid, kApex, pixel(column, 150)).reason == PathReason::kFound);
  }
  const SearchResult first = fresh.search(grid, kApex, pixel(440, 90));
  const SearchResult later = used.search(grid, kApex, pixel(440, 90));
  REQUIRE(first.cost_10_14 == later.cost_10_14);
  REQUIRE(first.expansions == later.expansions);
  REQUIRE(same(first.path, later.path));
}

TEST_CASE("search: guides in a straight line lead to the very edge of the view",
          "[low_level][path]") {
  PassableGrid grid;
  for (const LineSpan rows : {LineSpan{200, 300}, LineSpan{400, 450}}) {
    for (int row = rows.first; row <= rows.last; ++row) {
      for (int column = 420; column < 440; ++column) {
        grid.block(pixel(column, row));
      }
    }
  }
  const Window view;
  for (const int column : {430, 433, 440, 445}) {
    const PathPixel goal = pixel(column, 0);
    PathSearch search;
    const SearchResult result = search.search(grid, kApex, goal);
    REQUIRE(result.reason == PathReason::kFound);
    REQUIRE(same(result.path, path_by_rule(grid, view, dijkstra(grid, view, goal), kApex, goal)));
  }
}

}  // namespace
}  // namespace lodesman::testing
