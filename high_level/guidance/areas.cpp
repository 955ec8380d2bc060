// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/areas.h"

#include <algorithm>

namespace lodesman {
namespace {

// A keep-out area is a polygon; a fence is its edge alone, closed.
[[nodiscard]] Obstacle wall_of(const MissionArea& area) noexcept {
  Obstacle wall;
  wall.shape = area.kind == AreaKind::kKeepOut ? ObstacleShape::kPolygon : ObstacleShape::kPolyline;
  const auto corners = std::min<std::uint32_t>(area.corner_count, MissionArea::kMaxCorners);
  std::copy_n(area.corners.begin(), corners, wall.vertices.begin());
  wall.vertex_count = corners;
  if (area.kind == AreaKind::kFence && corners > 0) {
    wall.vertices[wall.vertex_count++] = area.corners[0];
  }
  return wall;
}

}  // namespace

void add_areas(std::span<const MissionArea> areas, Time now, const VehicleState& own,
               Tracks& water) noexcept {
  const double doubt_m2 = std::max(own.position_xx_m2, own.position_yy_m2);
  const auto room = static_cast<std::uint32_t>(kMaxObstacles - std::min(areas.size(), kMaxAreas));
  if (water.count > room) {
    water.dropped += water.count - room;
    water.count = room;
  }
  std::uint32_t id = kFirstAreaId;
  for (const MissionArea& area : areas.first(std::min(areas.size(), kMaxAreas))) {
    Track track;
    track.id = id++;
    track.last_seen = now;
    track.shape = wall_of(area);
    track.shape.id = track.id;
    track.place_xx_m2 = track.place_yy_m2 = doubt_m2;
    water.tracks[water.count++] = track;
  }
}

// Crossings of the ray to +x, counted.
bool allows(const MissionArea& area, const WorldPoint& place) noexcept {
  bool inside = false;
  const double x = place.xy_m.x();
  const double y = place.xy_m.y();
  const auto count = std::min<std::size_t>(area.corner_count, MissionArea::kMaxCorners);
  for (std::size_t i = 0; i < count; ++i) {
    const Vertex& a = area.corners[i];
    const Vertex& b = area.corners[(i + 1) % count];
    if ((a.y_m > y) != (b.y_m > y) && x < a.x_m + (y - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m)) {
      inside = !inside;
    }
  }
  return inside == (area.kind == AreaKind::kFence);
}

}  // namespace lodesman
