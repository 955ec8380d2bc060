// SPDX-License-Identifier: Apache-2.0
#include "tests/support/random_frames.h"

#include <iostream>

#include "low_level/path/path_search.h"
#include "tests/support/catch.h"
#include "tests/unit/path/reference_search.h"

namespace lodesman::testing {
namespace {

// A quarter of the sonar's fan each way, so that a plain Dijkstra can keep up.
constexpr FanShape kSmallFan{218, 126, 109, 125, 125};
constexpr Window kSmallView{0, 0, kSmallFan.columns, kSmallFan.rows};

int differing_bits(const PassableGrid& grid) {
  int differing = 0;
  for (int row = 0; row < grid.fan().rows; ++row) {
    for (int column = 0; column < grid.fan().columns; ++column) {
      differing += grid.rows().is_free(row, column) == grid.columns().is_free(column, row) ? 0 : 1;
    }
  }
  return differing;
}

// Draws a frame: its obstacles, every fourth time with a wall in their way.
void draw(const RandomFrame& frame, std::mt19937& random, PassableGrid& grid) {
  frame.draw(grid);
  if (random() % 4 != 0) {
    return;
  }
  WallPx wall;
  wall.vertex_count = 2 + random() % 4;
  wall.radius = 0.5 + static_cast<double>(random() % 3);
  wall.closed = random() % 2 == 0;
  for (std::uint32_t i = 0; i < wall.vertex_count; ++i) {
    wall.vertices[i] = {static_cast<double>(random() % 218), static_cast<double>(random() % 110)};
  }
  grid.block(wall);
}

struct Tally {
  int found = 0;
  int none = 0;
};

// Asks for a path in so many frames of all kinds, and has Dijkstra and the rule judge it.
Tally judge(unsigned seed, int obstacles_times, int count) {
  std::cout << "seed " << seed << '\n';
  FrameMaker frames{seed, kSmallFan, obstacles_times};
  std::mt19937 random{seed};
  PassableGrid grid{kSmallFan};
  PathSearch search{Geometry::k4, {}, kSmallFan};
  Tally tally;
  for (int i = 0; i < count; ++i) {
    const RandomFrame frame = frames.make(static_cast<FrameKind>(i % 8));
    draw(frame, random, grid);
    CAPTURE(i, kFrameKindNames[static_cast<std::size_t>(i % 8)]);
    REQUIRE(differing_bits(grid) == 0);
    const SearchResult result = search.search(grid, frame.start, frame.goal);
    if (!grid.passable(frame.start.column, frame.start.row) ||
        !grid.passable(frame.goal.column, frame.goal.row)) {
      continue;
    }
    const std::vector<int> costs = dijkstra(grid, kSmallView, frame.goal);
    if (costs[kSmallView.index(frame.start)] == kUnreached) {
      REQUIRE(result.reason == PathReason::kNoPath);
      ++tally.none;
      continue;
    }
    REQUIRE(result.reason == PathReason::kFound);
    REQUIRE(result.cost_10_14 == costs[kSmallView.index(frame.start)]);
    require_walkable(grid, result.path, frame.start, frame.goal, result.cost_10_14);
    REQUIRE(same(result.path, path_by_rule(grid, kSmallView, costs, frame.start, frame.goal)));
    ++tally.found;
  }
  return tally;
}

TEST_CASE("search: on 2000 random frames it agrees with Dijkstra, and its path with the rule",
          "[low_level][path]") {
  const Tally tally = judge(866500, 1, 2000);
  REQUIRE(tally.found > 1300);
  REQUIRE(tally.none > 200);
}

TEST_CASE("search: on 1000 random frames with ten times the obstacles it does too",
          "[low_level][path]") {
  const Tally tally = judge(866501, 10, 1000);
  REQUIRE(tally.found > 600);
}

TEST_CASE("search: between random pixels of a frame it agrees with Dijkstra too",
          "[low_level][path]") {
  constexpr unsigned kSeed = 4711;
  std::cout << "seed " << kSeed << '\n';
  FrameMaker frames{kSeed, kSmallFan};
  std::mt19937 random{kSeed};
  PassableGrid grid{kSmallFan};
  PathSearch search{Geometry::k4, {}, kSmallFan};
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    const RandomFrame frame = frames.make(static_cast<FrameKind>(i % 8));
    draw(frame, random, grid);
    const std::vector<int> costs = dijkstra(grid, kSmallView, frame.goal);
    for (int j = 0; j < 40; ++j) {
      const PathPixel start =
          pixel(static_cast<int>(random() % 218), static_cast<int>(random() % 126));
      if (!grid.passable(start.column, start.row) ||
          !grid.passable(frame.goal.column, frame.goal.row)) {
        continue;
      }
      CAPTURE(i, j, start.column, start.row);
      const SearchResult result = search.search(grid, start, frame.goal);
      const int cost = costs[kSmallView.index(start)];
      REQUIRE((result.reason == PathReason::kFound) == (cost != kUnreached));
      if (cost != kUnreached) {
        REQUIRE(result.cost_10_14 == cost);
        REQUIRE(same(result.path, path_by_rule(grid, kSmallView, costs, start, frame.goal)));
        ++found;
      }
    }
  }
  REQUIRE(found > 600);
}

TEST_CASE("search: in 8-geometry it agrees with Dijkstra on knight's steps", "[low_level][path]") {
  constexpr unsigned kSeed = 1616;
  std::cout << "seed " << kSeed << '\n';
  FrameMaker frames{kSeed, kSmallFan};
  std::mt19937 random{kSeed};
  PassableGrid grid{kSmallFan};
  PathSearch search{Geometry::k8, {}, kSmallFan};
  PathSearch paper{Geometry::k4, {}, kSmallFan};
  int found = 0;
  for (int i = 0; i < 96; ++i) {
    const RandomFrame frame = frames.make(static_cast<FrameKind>(i % 8));
    frame.draw(grid);
    for (int speck = 0; speck < 20 * (i % 4); ++speck) {
      grid.block(pixel(static_cast<int>(random() % 218), static_cast<int>(random() % 120)));
    }
    CAPTURE(i);
    const SearchResult result = search.search(grid, frame.start, frame.goal);
    const std::vector<int> costs = dijkstra_16(grid, kSmallView, frame.goal);
    if (!grid.passable(frame.goal.column, frame.goal.row)) {
      REQUIRE(result.reason == PathReason::kGoalBlocked);
      continue;
    }
    const int cost = costs[kSmallView.index(frame.start)];
    REQUIRE((result.reason == PathReason::kFound) == (cost != kUnreached));
    if (cost == kUnreached) {
      continue;
    }
    REQUIRE(result.cost_10_14 == cost);
    REQUIRE(cost <= paper.search(grid, frame.start, frame.goal).cost_10_14);
    int sum = 0;
    for (std::size_t k = 1; k < result.path.size(); ++k) {
      const int here = costs[kSmallView.index(result.path[k])];
      const int step = costs[kSmallView.index(result.path[k - 1])] - here;
      REQUIRE((step == 10 || step == 14 || step == 22));
      sum += step;
    }
    REQUIRE(sum == cost);
    REQUIRE(same(result.path.back(), frame.goal));
    ++found;
  }
  REQUIRE(found > 60);
}

TEST_CASE("search: a knight's step needs both pixels that it passes between", "[low_level][path]") {
  PassableGrid grid;
  PathSearch search{Geometry::k8};
  const PathPixel start = pixel(433, 300);
  const PathPixel goal = pixel(435, 299);
  REQUIRE(search.search(grid, start, goal).cost_10_14 == 22);
  for (const PathPixel between : {pixel(434, 300), pixel(434, 299)}) {
    grid.clear();
    grid.block(between);
    REQUIRE(search.search(grid, start, goal).cost_10_14 > 24);
  }
}

}  // namespace
}  // namespace lodesman::testing
