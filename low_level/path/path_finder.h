// SPDX-License-Identifier: Apache-2.0
// Answers a PathRequest: obstacles and a goal in the vehicle frame in, a path in the sonar view
// out (the paper's steps 7-10). Owned by one thread; it allocates when made and never after.
#pragma once

#include <optional>

#include "low_level/path/grid.h"
#include "low_level/path/path_search.h"
#include "mid_level/geometry/sonar_view.h"
#include "mid_level/messages/path.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

// The pixel whose centre is nearest to a point of the vehicle frame (halves go to starboard and
// astern); nothing where that is no pixel of the view.
[[nodiscard]] std::optional<PathPixel> nearest_pixel(const SonarView& view,
                                                     const VehiclePoint& point) noexcept;

class PathFinder {
 public:
  explicit PathFinder(SearchLimits limits = {}) : search_{Geometry::k4, limits} {}

  // Fills all of `out` but plan_time_ns, which is the caller's to measure, and the pixels after
  // pixel_count. The path starts at the apex. An obstacle that cannot be drawn (zone.h) blocks
  // the whole view: no path is better than one through it. A range that is not above zero has no
  // view, and so any goal is out of it.
  void find_path(const SonarObstacles& obstacles, const PathRequest& request,
                 SonarPath& out) noexcept;

  // As the last find_path() left it.
  [[nodiscard]] const PassableGrid& grid() const noexcept { return grid_; }

 private:
  void draw(const SonarObstacles& obstacles, const SonarView& view) noexcept;

  PassableGrid grid_;
  PathSearch search_;
};

}  // namespace lodesman
