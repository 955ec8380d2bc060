// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "low_level/path/path_search.h"
#include "tests/support/catch.h"
#include "tests/unit/path/reference_search.h"

namespace lodesman::testing {
namespace {

constexpr PathPixel kApex{kApexColumn, kApexRow};

TEST_CASE("ties: an obstacle dead ahead is always passed to starboard", "[low_level][path]") {
  PassableGrid grid;
  PathSearch search;
  for (const double radius : {1.0, 8.0, 25.0, 58.3, 65.0}) {
    for (const double row : {400.0, 300.5, 250.0}) {
      CAPTURE(radius, row);
      std::vector<EllipsePx> discs{{{433.0, row}, radius, radius},
                                   {{433.0 - 3.5 * radius, row}, radius, radius},
                                   {{433.0 + 3.5 * radius, row}, radius, radius}};
      std::vector<PathPixel> first;
      for (int order = 0; order < 3; ++order) {
        grid.clear();
        for (const EllipsePx& disc : discs) {
          grid.block(disc);
        }
        const SearchResult result = search.search(grid, kApex, pixel(433, 60));
        REQUIRE(result.reason == PathReason::kFound);
        const auto [left, right] =
            std::minmax_element(result.path.begin(), result.path.end(),
                                [](PathPixel l, PathPixel r) { return l.column < r.column; });
        REQUIRE(left->column == kApexColumn);
        REQUIRE(right->column > kApexColumn + radius - 1.0);
        if (first.empty()) {
          first.assign(result.path.begin(), result.path.end());
        }
        REQUIRE(same(result.path, first));
        std::rotate(discs.begin(), discs.begin() + 1, discs.end());
      }
    }
  }
}

TEST_CASE("ties: in open water the path never leaves the straight line to the goal by a pixel",
          "[low_level][path]") {
  PassableGrid grid;
  PathSearch search;
  for (int row = 5; row < 490; row += 53) {
    for (int column = 20; column < kViewColumns; column += 59) {
      const PathPixel goal = pixel(column, row);
      const int across = column - kApexColumn;
      const int ahead = kApexRow - row;
      // Beyond 45 degrees the fan, one pixel wide at the apex, makes the path begin beside the
      // line.
      if (!in_fan(column, row) || std::abs(across) > ahead) {
        continue;
      }
      CAPTURE(column, row);
      const SearchResult result = search.search(grid, kApex, goal);
      REQUIRE(result.reason == PathReason::kFound);
      require_walkable(grid, result.path, kApex, goal, result.cost_10_14);
      for (const PathPixel p : result.path) {
        const double off = (p.column - kApexColumn) * ahead - (kApexRow - p.row) * across;
        REQUIRE(std::abs(off) / std::hypot(across, ahead) <= 1.0);
      }
    }
  }
}

TEST_CASE("ties: the rule holds on a whole view with obstacles", "[low_level][path]") {
  PassableGrid grid;
  PathSearch search;
  grid.block(EllipsePx::with_angle({440.0, 330.0}, 80.0, 25.0, 0.4));
  grid.block(EllipsePx::with_angle({400.0, 220.0}, 50.0, 35.0, -0.7));
  grid.block(EllipsePx::with_angle({520.0, 240.0}, 40.0, 20.0, 1.2));
  for (const PathPixel goal : {pixel(433, 100), pixel(300, 120), pixel(600, 90), pixel(470, 170)}) {
    CAPTURE(goal.column, goal.row);
    const Window view;
    const auto expected = path_by_rule(grid, view, dijkstra(grid, view, goal), kApex, goal);
    REQUIRE(same(search.search(grid, kApex, goal).path, expected));
  }
}

}  // namespace
}  // namespace lodesman::testing
