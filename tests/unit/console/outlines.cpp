// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/outlines.h"

#include <cmath>

#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::console;

namespace {

[[nodiscard]] Obstacle wall(ObstacleShape shape, const std::vector<Vertex>& vertices) {
  Obstacle o;
  o.shape = shape;
  o.protection_first_m = 0.5;
  o.vertex_count = static_cast<std::uint32_t>(vertices.size());
  std::copy(vertices.begin(), vertices.end(), o.vertices.begin());
  return o;
}

}  // namespace

TEST_CASE("outlines: an ellipse's lie on its edge and on its zone's", "[console]") {
  Obstacle o;
  o.centre_x_m = 3.0;
  o.centre_y_m = -1.0;
  o.semi_axis_first_m = 2.0;
  o.semi_axis_second_m = 1.0;
  o.angle_rad = 0.7;
  o.protection_first_m = o.protection_second_m = 4.0;
  for (const Vertex& point : outline_of(o)) {
    CHECK(edge_distance_m(o, WorldPoint{{point.x_m, point.y_m}}) == Approx(0.0).margin(1e-6));
  }
  for (const Vertex& point : zone_of(o)) {
    CHECK(std::hypot(point.x_m - 3.0, point.y_m + 1.0) == Approx(4.0));
  }
}

TEST_CASE("outlines: round a wall or a convex polygon the zone is as far off as it protects",
          "[console]") {
  const Obstacle walls[] = {
      wall(ObstacleShape::kPolyline, {{0.0, 0.0}, {4.0, 0.0}}),
      wall(ObstacleShape::kPolygon, {{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}}),
      wall(ObstacleShape::kPolygon, {{4.0, 3.0}, {4.0, 0.0}, {0.0, 0.0}}),  // the other way round
  };
  for (const Obstacle& o : walls) {
    const auto zone = zone_of(o);
    REQUIRE(zone.size() > o.vertex_count);
    for (const Vertex& point : zone) {
      CHECK(edge_distance_m(o, WorldPoint{{point.x_m, point.y_m}}) == Approx(0.5));
    }
  }
}

TEST_CASE("outlines: a wall without a zone has none, and an outline there and back", "[console]") {
  Obstacle o = wall(ObstacleShape::kPolyline, {{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}});
  o.protection_first_m = 0.0;
  CHECK(zone_of(o).empty());
  CHECK(outline_of(o).size() == 4);
}
