// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/world_path_finder.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

// The plane of the search: metres in units of the sonar view's pixel at 30 m, because the tangents'
// tolerances are meant for that size, with rows downwards; the start is its origin.
constexpr double kUnit_m = 0.06;

[[nodiscard]] PointPx to_plane(const PathRequest& request, double x_m, double y_m) noexcept {
  return {(x_m - request.start_x_m) / kUnit_m, -(y_m - request.start_y_m) / kUnit_m};
}

[[nodiscard]] ZonePx zone_of(const PathRequest& request, const PathZone& zone,
                             double give_m) noexcept {
  const Obstacle& shape = zone.shape;
  if (shape.shape == ObstacleShape::kEllipse) {
    // The first axis points clockwise from +y; in the plane angles count from +column to +row.
    const PointPx centre = to_plane(request, shape.centre_x_m, shape.centre_y_m);
    return EllipsePx{centre, std::max(1e-3, shape.protection_first_m - give_m) / kUnit_m,
                     std::max(1e-3, shape.protection_second_m - give_m) / kUnit_m,
                     std::sin(shape.angle_rad), -std::cos(shape.angle_rad)};
  }
  WallPx wall;
  wall.vertex_count = std::min<std::uint32_t>(shape.vertex_count, kMaxVertices);
  for (std::uint32_t i = 0; i < wall.vertex_count; ++i) {
    wall.vertices[i] = to_plane(request, shape.vertices[i].x_m, shape.vertices[i].y_m);
  }
  wall.radius = std::max(1e-3, shape.protection_first_m - give_m) / kUnit_m;
  wall.closed = shape.shape == ObstacleShape::kPolygon;
  return wall;
}

}  // namespace

void WorldPathFinder::find_path(const PathRequest& request, SonarPath& out) noexcept {
  out.narrow = false;
  out.sides_changed = false;
  draw(request, false);
  const bool asks_for_sides =
      std::any_of(sides_.begin(), sides_.begin() + static_cast<std::ptrdiff_t>(zone_count_),
                  [](const BendSides& sides) { return !sides.port || !sides.starboard; });
  TangentResult result = search(request, true);
  take(request, result, out);
  if (asks_for_sides) {
    const TangentResult any = search(request, false);
    const bool kept = out.reason == PathReason::kFound &&
                      out.length_m <= any.length_px * kUnit_m + request.side_gain_m;
    if (!kept && any.reason == PathReason::kFound) {
      take(request, any, out);
      out.sides_changed = true;
    }
  }
  if (out.reason != PathReason::kNoPath && out.reason != PathReason::kStartBlocked &&
      out.reason != PathReason::kGoalBlocked) {
    return;
  }
  draw(request, true);
  result = search(request, false);
  if (result.reason == PathReason::kFound) {
    take(request, result, out);
    out.narrow = true;
  }
}

void WorldPathFinder::draw(const PathRequest& request, bool give) noexcept {
  zone_count_ = std::min<std::size_t>(request.zone_count, kMaxObstacles);
  for (std::size_t i = 0; i < zone_count_; ++i) {
    const PathZone& zone = request.zones[i];
    zones_[i] = zone_of(request, zone, give ? zone.give_m : 0.0);
    sides_[i] = {zone.may_keep_to_port, zone.may_keep_to_starboard};
  }
}

TangentResult WorldPathFinder::search(const PathRequest& request, bool keep_sides) noexcept {
  constexpr double kReach = kPathReach_m / kUnit_m;
  const std::span<const ZonePx> zones{zones_.data(), zone_count_};
  const std::span<const BendSides> sides{sides_.data(), keep_sides ? zone_count_ : 0};
  return tangents_.find(zones, RegionPx::rectangle({-kReach, -kReach}, {kReach, kReach}),
                        to_plane(request, request.start_x_m, request.start_y_m),
                        to_plane(request, request.goal_x_m, request.goal_y_m), sides);
}

void WorldPathFinder::take(const PathRequest& request, const TangentResult& result,
                           SonarPath& out) noexcept {
  out.reason = result.reason;
  out.length_m = result.length_px * kUnit_m;
  out.expansions = result.tried;
  out.point_count = 0;
  if (result.path.size() > kMaxPathPoints) {
    out.reason = PathReason::kLimit;
    return;
  }
  for (const PointPx& p : result.path) {
    out.points[out.point_count++] = {request.start_x_m + p.column * kUnit_m,
                                     request.start_y_m - p.row * kUnit_m};
  }
}

}  // namespace lodesman
