// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/path/reference_search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <queue>
#include <utility>

#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

bool may_step(const PassableGrid& grid, PathPixel from, PathPixel to) {
  return grid.passable(from.column, from.row) && grid.passable(to.column, to.row) &&
         grid.passable(from.column, to.row) && grid.passable(to.column, from.row);
}

int step_cost(PathPixel from, PathPixel to) {
  return from.column != to.column && from.row != to.row ? 14 : 10;
}

std::vector<PathPixel> neighbours(PathPixel of) {
  std::vector<PathPixel> all;
  for (int row = of.row - 1; row <= of.row + 1; ++row) {
    for (int column = of.column - 1; column <= of.column + 1; ++column) {
      if (row != of.row || column != of.column) {
        all.push_back(pixel(column, row));
      }
    }
  }
  return all;
}

// Of a step's end, the smaller the better: its distance from the line between start and goal, and
// a little more where that is to port, and a very little for the way to the goal that is left.
double dislike_of(PathPixel end, PathPixel start, PathPixel goal) {
  const double across = goal.column - start.column;
  const double ahead = start.row - goal.row;
  const double length = std::hypot(across, ahead);
  const double off =
      length > 0.0 ? ((end.column - start.column) * ahead - (start.row - end.row) * across) / length
                   : 0.0;
  const double left = std::hypot(goal.column - end.column, goal.row - end.row);
  return std::abs(off) + (off < -1e-9 ? 1e-6 : 0.0) + 1e-12 * left;
}

}  // namespace

std::vector<int> dijkstra(const PassableGrid& grid, const Window& window, PathPixel goal) {
  std::vector<int> cost(static_cast<std::size_t>(window.columns * window.rows), kUnreached);
  using Entry = std::pair<int, std::pair<int, int>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<bool> done(cost.size(), false);
  if (grid.passable(goal.column, goal.row)) {
    cost[window.index(goal)] = 0;
    open.push({0, {goal.column, goal.row}});
  }
  while (!open.empty()) {
    const auto [so_far, where] = open.top();
    open.pop();
    const PathPixel at = pixel(where.first, where.second);
    if (done[window.index(at)]) {
      continue;
    }
    done[window.index(at)] = true;
    for (const PathPixel next : neighbours(at)) {
      if (!window.holds(next) || !may_step(grid, at, next)) {
        continue;
      }
      int& known = cost[window.index(next)];
      const int offered = so_far + step_cost(at, next);
      if (known == kUnreached || offered < known) {
        known = offered;
        open.push({offered, {next.column, next.row}});
      }
    }
  }
  return cost;
}

std::vector<PathPixel> path_by_rule(const PassableGrid& grid, const Window& window,
                                    const std::vector<int>& cost_to_goal, PathPixel start,
                                    PathPixel goal) {
  if (cost_to_goal[window.index(start)] == kUnreached) {
    return {};
  }
  std::vector<PathPixel> path{start};
  while (!same(path.back(), goal)) {
    const PathPixel at = path.back();
    const int cost = cost_to_goal[window.index(at)];
    std::vector<std::pair<double, PathPixel>> choices;
    for (const PathPixel next : neighbours(at)) {
      if (window.holds(next) && may_step(grid, at, next) &&
          cost_to_goal[window.index(next)] + step_cost(at, next) == cost) {
        choices.emplace_back(dislike_of(next, start, goal), next);
      }
    }
    const auto best =
        std::min_element(choices.begin(), choices.end(),
                         [](const auto& l, const auto& r) { return l.first < r.first; });
    REQUIRE(best != choices.end());
    path.push_back(best->second);
  }
  return path;
}

void require_walkable(const PassableGrid& grid, std::span<const PathPixel> path, PathPixel start,
                      PathPixel goal, std::int32_t cost) {
  REQUIRE(!path.empty());
  REQUIRE(same(path.front(), start));
  REQUIRE(same(path.back(), goal));
  bool walkable = grid.passable(start.column, start.row);
  int sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int dx = std::abs(path[i].column - path[i - 1].column);
    const int dy = std::abs(path[i].row - path[i - 1].row);
    walkable = walkable && std::max(dx, dy) == 1 && may_step(grid, path[i - 1], path[i]);
    sum += step_cost(path[i - 1], path[i]);
  }
  REQUIRE(walkable);
  REQUIRE(sum == cost);
}

PathPixel pixel(int column, int row) {
  return {static_cast<std::int16_t>(column), static_cast<std::int16_t>(row)};
}

bool same(PathPixel l, PathPixel r) { return l.column == r.column && l.row == r.row; }

bool same(std::span<const PathPixel> l, std::span<const PathPixel> r) {
  return std::equal(l.begin(), l.end(), r.begin(), r.end(),
                    [](PathPixel a, PathPixel b) { return same(a, b); });
}

}  // namespace lodesman::testing
