// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/map_search.h"

#include <cmath>
#include <cstdlib>
#include <queue>
#include <random>
#include <set>
#include <tuple>

#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

[[nodiscard]] PassableMap map_of(const std::vector<std::string>& rows) {
  PassableMap map{static_cast<int>(rows[0].size()), static_cast<int>(rows.size())};
  for (int row = 0; row < map.height(); ++row) {
    for (int column = 0; column < map.width(); ++column) {
      const auto& text = rows[static_cast<std::size_t>(row)];
      map.set({column, row}, text[static_cast<std::size_t>(column)] == '.');
    }
  }
  return map;
}

// The rule of a step, written out anew.
[[nodiscard]] bool may_step(const PassableMap& map, MapCell from, MapCell to) {
  return map.passable(to) && map.passable({from.column, to.row}) &&
         map.passable({to.column, from.row});
}

// Dijkstra in floating point; a negative cost where there is no way.
[[nodiscard]] double reference_cost(const PassableMap& map, MapCell start, MapCell goal,
                                    double diagonal) {
  using Open = std::tuple<double, int, int>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  std::set<std::pair<int, int>> done;
  open.emplace(0.0, start.column, start.row);
  while (!open.empty()) {
    const auto [cost, column, row] = open.top();
    open.pop();
    if (!done.emplace(column, row).second) {
      continue;
    }
    if (MapCell{column, row} == goal) {
      return cost;
    }
    for (int dc = -1; dc <= 1; ++dc) {
      for (int dr = -1; dr <= 1; ++dr) {
        if ((dc != 0 || dr != 0) && may_step(map, {column, row}, {column + dc, row + dr})) {
          open.emplace(cost + (dc != 0 && dr != 0 ? diagonal : 1.0), column + dc, row + dr);
        }
      }
    }
  }
  return -1.0;
}

void require_walkable(const PassableMap& map, const MapSearchResult& result) {
  int straight = 0;
  int diagonal = 0;
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    const MapCell from = result.path[i - 1];
    const MapCell to = result.path[i];
    const int length = std::abs(from.column - to.column) + std::abs(from.row - to.row);
    REQUIRE(std::max(std::abs(from.column - to.column), std::abs(from.row - to.row)) == 1);
    REQUIRE(may_step(map, from, to));
    ++(length == 2 ? diagonal : straight);
  }
  REQUIRE(straight == result.straight_steps);
  REQUIRE(diagonal == result.diagonal_steps);
}

TEST_CASE("map search: no corner is cut", "[low_level][path]") {
  const PassableMap map = map_of({"..#", "...", "#.."});
  MapSearch search{3, 3, MapCosts::kSqrt2};
  const MapSearchResult result = search.search(map, {1, 0}, {2, 1});
  REQUIRE(result.reason == PathReason::kFound);
  REQUIRE(result.cost(MapCosts::kSqrt2) == Approx(2.0));
  REQUIRE(result.cost_10_14() == 20);
}

TEST_CASE("map search: every reason is told", "[low_level][path]") {
  const PassableMap map = map_of({".#.", ".#."});
  MapSearch search{3, 2, MapCosts::kPaper};
  REQUIRE(search.search(map, {1, 0}, {0, 0}).reason == PathReason::kStartBlocked);
  REQUIRE(search.search(map, {-1, 0}, {0, 0}).reason == PathReason::kStartBlocked);
  REQUIRE(search.search(map, {0, 0}, {1, 1}).reason == PathReason::kGoalBlocked);
  REQUIRE(search.search(map, {0, 0}, {2, 2}).reason == PathReason::kGoalBlocked);
  REQUIRE(search.search(map, {0, 0}, {2, 1}).reason == PathReason::kNoPath);
  REQUIRE(search.search(map, {0, 0}, {0, 1}, 1).reason == PathReason::kLimit);
  const MapSearchResult here = search.search(map, {0, 0}, {0, 0});
  REQUIRE(here.reason == PathReason::kFound);
  REQUIRE(here.path.size() == 1);
  REQUIRE(here.cost_10_14() == 0);
}

TEST_CASE("map search: random maps have the cost of a plain Dijkstra", "[low_level][path]") {
  std::mt19937 random{20};
  for (int round = 0; round < 60; ++round) {
    PassableMap map{17, 13};
    for (int row = 0; row < map.height(); ++row) {
      for (int column = 0; column < map.width(); ++column) {
        map.set({column, row}, random() % 10 >= 3);
      }
    }
    map.set({0, 0}, true);
    map.set({16, 12}, true);
    for (const MapCosts costs : {MapCosts::kPaper, MapCosts::kSqrt2}) {
      MapSearch search{17, 13, costs};
      const double diagonal = costs == MapCosts::kPaper ? 1.4 : std::sqrt(2.0);
      const double expected = reference_cost(map, {0, 0}, {16, 12}, diagonal);
      const MapSearchResult result = search.search(map, {0, 0}, {16, 12});
      CAPTURE(round);
      REQUIRE((result.reason == PathReason::kFound) == (expected >= 0.0));
      if (expected >= 0.0) {
        REQUIRE(result.cost(costs) == Approx(expected).epsilon(1e-12));
        require_walkable(map, result);
      }
    }
  }
}

}  // namespace
}  // namespace lodesman::testing
