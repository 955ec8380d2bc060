// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/path/reference_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <tuple>
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

std::array<PathPixel, 8> neighbours(PathPixel of) {
  std::array<PathPixel, 8> all;
  std::size_t count = 0;
  for (int row = of.row - 1; row <= of.row + 1; ++row) {
    for (int column = of.column - 1; column <= of.column + 1; ++column) {
      if (row != of.row || column != of.column) {
        all[count++] = pixel(column, row);
      }
    }
  }
  return all;
}

// The pixels through which the straight line of a knight's step passes, its ends among them.
bool knight_may_step(const PassableGrid& grid, PathPixel from, int columns, int rows) {
  for (int i = 0; i < 8; ++i) {
    const double share = (i + 0.5) / 8.0;
    if (!grid.passable(static_cast<int>(std::lround(from.column + share * columns)),
                       static_cast<int>(std::lround(from.row + share * rows)))) {
      return false;
    }
  }
  return true;
}

// Pixels in order of their cost to the goal, a list a cost. `for_steps(at, take)` calls take(next,
// cost) for each step.
template <class ForSteps>
std::vector<int> costs_to(const PassableGrid& grid, const Window& window, PathPixel goal,
                          ForSteps for_steps) {
  std::vector<int> cost(static_cast<std::size_t>(window.columns * window.rows), kUnreached);
  std::vector<std::vector<PathPixel>> open(1);
  if (grid.passable(goal.column, goal.row)) {
    cost[window.index(goal)] = 0;
    open[0].push_back(goal);
  }
  for (std::size_t so_far = 0; so_far < open.size(); ++so_far) {
    for (std::size_t i = 0; i < open[so_far].size(); ++i) {
      const PathPixel at = open[so_far][i];
      if (cost[window.index(at)] != static_cast<int>(so_far)) {
        continue;  // reached more cheaply since
      }
      for_steps(at, [&](PathPixel next, int step) {
        if (!window.holds(next)) {
          return;
        }
        int& known = cost[window.index(next)];
        const int offered = static_cast<int>(so_far) + step;
        if (known == kUnreached || offered < known) {
          known = offered;
          open.resize(std::max(open.size(), static_cast<std::size_t>(offered) + 1));
          open[static_cast<std::size_t>(offered)].push_back(next);
        }
      });
    }
  }
  return cost;
}

// Of a step's end, the smaller the better: its distance from the line between start and goal, then
// whether that is to port, then the way to the goal that is left.
std::tuple<double, bool, double> dislike_of(PathPixel end, PathPixel start, PathPixel goal) {
  const double across = goal.column - start.column;
  const double ahead = start.row - goal.row;
  const double length = std::hypot(across, ahead);
  const double off =
      length > 0.0 ? ((end.column - start.column) * ahead - (start.row - end.row) * across) / length
                   : 0.0;
  return {std::abs(off), off < 0.0, std::hypot(goal.column - end.column, goal.row - end.row)};
}

}  // namespace

std::vector<int> dijkstra(const PassableGrid& grid, const Window& window, PathPixel goal) {
  return costs_to(grid, window, goal, [&](PathPixel at, auto take) {
    for (const PathPixel next : neighbours(at)) {
      if (may_step(grid, at, next)) {
        take(next, step_cost(at, next));
      }
    }
  });
}

std::vector<int> dijkstra_16(const PassableGrid& grid, const Window& window, PathPixel goal) {
  return costs_to(grid, window, goal, [&](PathPixel at, auto take) {
    for (const PathPixel next : neighbours(at)) {
      if (may_step(grid, at, next)) {
        take(next, step_cost(at, next));
      }
    }
    for (const int one : {-1, 1}) {
      for (const int two : {-2, 2}) {
        if (knight_may_step(grid, at, one, two)) {
          take(pixel(at.column + one, at.row + two), 22);
        }
        if (knight_may_step(grid, at, two, one)) {
          take(pixel(at.column + two, at.row + one), 22);
        }
      }
    }
  });
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
    std::vector<std::pair<std::tuple<double, bool, double>, PathPixel>> choices;
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

bool same(std::span<const PathPixel> l, std::span<const PathPixel> r) {
  return std::equal(l.begin(), l.end(), r.begin(), r.end(),
                    [](PathPixel a, PathPixel b) { return same(a, b); });
}

}  // namespace lodesman::testing
