// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/path_finder.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

constexpr PathPixel kApex{kApexColumn, kApexRow};
constexpr PathPixel kOutOfView{-1, -1};

}  // namespace

std::optional<PathPixel> nearest_pixel(const SonarView& view, const VehiclePoint& point) noexcept {
  const double column = std::floor(view.column_of(point.xy_m.x()) + 0.5);
  const double row = std::floor(view.row_of(point.xy_m.y()) + 0.5);
  // Written so that what is not a number lies outside.
  if (!(column >= 0.0 && column < kViewColumns && row >= 0.0 && row < kViewRows)) {
    return std::nullopt;
  }
  return PathPixel{static_cast<std::int16_t>(column), static_cast<std::int16_t>(row)};
}

void PathFinder::find_path(const SonarObstacles& obstacles, const PathRequest& request,
                           SonarPath& out) noexcept {
  SearchResult result{PathReason::kGoalOutOfView, 0, 0, {}};
  if (obstacles.range_m > 0.0 && std::isfinite(obstacles.range_m)) {
    const SonarView view{obstacles.range_m};
    draw(obstacles, view);
    const VehiclePoint goal{{request.goal_x_m, request.goal_y_m}};
    result = search_.search(grid_, kApex, nearest_pixel(view, goal).value_or(kOutOfView));
  } else {
    grid_.block_all();
  }
  out.request = request.id;
  out.frame = obstacles.frame;
  out.captured = obstacles.captured;
  out.range_m = obstacles.range_m;
  out.reason = result.reason;
  out.cost_10_14 = result.cost_10_14;
  out.expansions = result.expansions;
  out.pixel_count = static_cast<std::uint32_t>(result.path.size());
  std::copy(result.path.begin(), result.path.end(), out.pixels.begin());
}

void PathFinder::draw(const SonarObstacles& obstacles, const SonarView& view) noexcept {
  grid_.clear();
  const std::size_t count = std::min<std::size_t>(obstacles.count, kMaxObstacles);
  for (std::size_t i = 0; i < count; ++i) {
    if (const std::optional<ZonePx> zone = zone_of(obstacles.obstacles[i], view)) {
      grid_.block(*zone);
    } else {
      grid_.block_all();
    }
  }
}

}  // namespace lodesman
