// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/tangent_path.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

TEST_CASE("tangent_path: allocates nothing once it is made", "[low_level][path]") {
  TangentPath planner;
  std::vector<ZonePx> zones;
  for (int i = 0; i < 5; ++i) {
    zones.emplace_back(EllipsePx::with_angle({380.0 + 30.0 * i, 350.0 - 40.0 * i}, 30.0, 9.0, i));
  }
  WallPx wall;
  wall.vertex_count = 2;
  wall.radius = 3.0;
  wall.vertices[0] = {400.0, 120.0};
  wall.vertices[1] = {500.0, 120.0};
  zones.emplace_back(wall);
  const AllocationScope scope;
  const TangentResult result = planner.find(zones, RegionPx::fan(), {433.0, 499.0}, {433.0, 99.0});
  const auto allocations = scope.count();
  REQUIRE(result.reason == PathReason::kFound);
  REQUIRE(result.path.size() > 4);
  REQUIRE(allocations == 0);
}

}  // namespace
}  // namespace lodesman::testing
