// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/known_obstacles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lodesman {
namespace {

struct Seen {
  double distance_m = 0.0;  // [m] of the protection zone's nearest point, at the least
  std::size_t index = 0;    // in the world's list; breaks ties, so that the order is one order
};

bool nearer(const Seen& a, const Seen& b) noexcept {
  return a.distance_m < b.distance_m || (a.distance_m <= b.distance_m && a.index < b.index);
}

double distance_to_segment_m(const Vertex& a, const Vertex& b) noexcept {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  const double length_squared = dx * dx + dy * dy;
  const double part = length_squared > 0.0
                          ? std::clamp(-(a.x_m * dx + a.y_m * dy) / length_squared, 0.0, 1.0)
                          : 0.0;
  return std::hypot(a.x_m + part * dx, a.y_m + part * dy);
}

// Whether the segment crosses the +y axis: an odd number of crossings means that the polygon holds
// the vehicle's origin.
bool crosses_ahead(const Vertex& a, const Vertex& b) noexcept {
  if ((a.x_m > 0.0) == (b.x_m > 0.0)) {
    return false;
  }
  return a.y_m - a.x_m * (b.y_m - a.y_m) / (b.x_m - a.x_m) > 0.0;
}

double distance_to_wall_m(const Obstacle& wall) noexcept {
  const std::uint32_t count = std::min<std::uint32_t>(wall.vertex_count, kMaxVertices);
  const bool closed = wall.shape == ObstacleShape::kPolygon;
  double nearest_m = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i + 1 == count && !closed && count > 1) {
      break;
    }
    const Vertex& a = wall.vertices[i];
    const Vertex& b = wall.vertices[(i + 1) % count];
    nearest_m = std::min(nearest_m, distance_to_segment_m(a, b));
    inside = inside != (closed && crosses_ahead(a, b));
  }
  return inside ? 0.0 : nearest_m;
}

double distance_m(const Obstacle& seen) noexcept {
  if (seen.shape == ObstacleShape::kEllipse) {
    // The longer semi-axis all round: an ellipse may be kept a little too long, never lost.
    return std::hypot(seen.centre_x_m, seen.centre_y_m) -
           std::max(seen.protection_first_m, seen.protection_second_m);
  }
  return distance_to_wall_m(seen) - seen.protection_first_m;
}

}  // namespace

Obstacle to_vehicle(const VehiclePose& pose, const Obstacle& in_world) noexcept {
  Obstacle seen = in_world;
  if (in_world.shape == ObstacleShape::kEllipse) {
    const VehiclePoint centre = pose.to_vehicle({{in_world.centre_x_m, in_world.centre_y_m}});
    seen.centre_x_m = centre.xy_m.x();
    seen.centre_y_m = centre.xy_m.y();
    seen.angle_rad = pose.angle_to_vehicle_rad(in_world.angle_rad);
  }
  seen.vertex_count = std::min<std::uint32_t>(in_world.vertex_count, kMaxVertices);
  for (std::uint32_t i = 0; i < seen.vertex_count; ++i) {
    const VehiclePoint p = pose.to_vehicle({{in_world.vertices[i].x_m, in_world.vertices[i].y_m}});
    seen.vertices[i] = {p.xy_m.x(), p.xy_m.y()};
  }
  return seen;
}

void see_known_obstacles(std::span<const MovingObstacle> world, const KnownView& view,
                         SonarObstacles& out) noexcept {
  const auto look = [&](std::size_t i) {
    return to_vehicle(view.pose, world[i].at(view.scenario_time_s));
  };
  std::array<Seen, kMaxObstacles> kept{};  // a heap, the farthest first
  std::size_t count = 0;
  out.dropped = 0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (!world[i].exists(view.scenario_time_s)) {
      continue;
    }
    const Seen seen{distance_m(look(i)), i};
    if (!(seen.distance_m <= view.range_m)) {
      continue;
    }
    if (count == kept.size()) {
      ++out.dropped;
      if (!nearer(seen, kept[0])) {
        continue;
      }
      std::pop_heap(kept.begin(), kept.end(), nearer);
      --count;
    }
    kept[count++] = seen;
    std::push_heap(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count), nearer);
  }
  std::sort(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count), nearer);
  for (std::size_t i = 0; i < count; ++i) {
    out.obstacles[i] = look(kept[i].index);
  }
  out.frame = view.frame;
  out.captured = view.captured;
  out.range_m = view.range_m;
  out.count = static_cast<std::uint32_t>(count);
}

Obstacle to_world(const VehiclePose& pose, const Obstacle& in_vehicle) noexcept {
  Obstacle placed = in_vehicle;
  const WorldPoint centre = pose.to_world({{in_vehicle.centre_x_m, in_vehicle.centre_y_m}});
  placed.centre_x_m = centre.xy_m.x();
  placed.centre_y_m = centre.xy_m.y();
  placed.angle_rad = pose.angle_to_world_rad(in_vehicle.angle_rad);
  placed.vertex_count = std::min<std::uint32_t>(in_vehicle.vertex_count, kMaxVertices);
  for (std::uint32_t i = 0; i < placed.vertex_count; ++i) {
    const WorldPoint p = pose.to_world({{in_vehicle.vertices[i].x_m, in_vehicle.vertices[i].y_m}});
    placed.vertices[i] = {p.xy_m.x(), p.xy_m.y()};
  }
  return placed;
}

}  // namespace lodesman
