// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/areas.h"

#include <memory>

#include "tests/support/catch.h"

using namespace lodesman;

namespace {

MissionArea square(AreaKind kind, double half_m) {
  MissionArea area;
  area.kind = kind;
  for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    area.corners[area.corner_count++] = {x * half_m, y * half_m};
  }
  return area;
}

}  // namespace

TEST_CASE("areas: inside the fence and outside what is to be kept out of", "[high_level]") {
  const MissionArea fence = square(AreaKind::kFence, 10.0);
  const MissionArea keep_out = square(AreaKind::kKeepOut, 2.0);
  CHECK(allows(fence, {{9.0, -9.0}}));
  CHECK_FALSE(allows(fence, {{11.0, 0.0}}));
  CHECK(allows(keep_out, {{3.0, 0.0}}));
  CHECK_FALSE(allows(keep_out, {{1.0, 1.0}}));
}

TEST_CASE("areas: they are walls at rest among the tracks, and give way to none", "[high_level]") {
  const std::array areas{square(AreaKind::kFence, 10.0), square(AreaKind::kKeepOut, 2.0)};
  const auto water = std::make_unique<Tracks>();
  water->count = kMaxObstacles;
  const Time now{from_seconds(5)};
  add_areas(areas, now, {}, *water);
  CHECK(water->count == kMaxObstacles);
  CHECK(water->dropped == 2);
  const Track& fence = water->tracks[kMaxObstacles - 2];
  CHECK(fence.shape.shape == ObstacleShape::kPolyline);
  CHECK(fence.shape.vertex_count == 5);  // closed
  CHECK(fence.last_seen == now);
  const Track& keep_out = water->tracks[kMaxObstacles - 1];
  CHECK(keep_out.shape.shape == ObstacleShape::kPolygon);
  CHECK(keep_out.shape.vertex_count == 4);
  CHECK(keep_out.id != fence.id);
  CHECK_FALSE(keep_out.surely_moves());
}
