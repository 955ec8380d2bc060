// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/seen_water.h"

#include <cmath>
#include <memory>

#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/tracking/grid_watch.h"

namespace lodesman {
namespace {

using testing::GridWatch;
using testing::stone_at;

[[nodiscard]] std::unique_ptr<Coverage> told_by(GridWatch& watch, double later_s = 0.0) {
  auto water = std::make_unique<Coverage>();
  describe_water(watch.grid(), watch.look().pose.p_WV.xy_m, watch.look().at_s + later_s, 1.0,
                 *water);
  return water;
}

}  // namespace

TEST_CASE("seen water: what the grid knows is told, and the rest is unknown",
          "[low_level][tracking]") {
  GridWatch watch;
  watch.go_to(1000.3, -2000.1);
  watch.see(12.0, 3);
  watch.hit(stone_at(1000.3, -1986.0, 0.6));
  const auto water = told_by(watch);
  CHECK(water->at(1000.3, -1995.0) == WaterState::kFree);
  CHECK(water->at(1003.0, -1995.0) == WaterState::kFree);
  CHECK(water->at(1000.3, -1986.0) == WaterState::kOccupied);
  CHECK(water->at(1000.3, -1983.0) == WaterState::kUnknown);  // beyond what was looked at
  CHECK(water->at(1000.3, -2004.0) == WaterState::kUnknown);  // astern
}

TEST_CASE("seen water: every cell of the grid in a coverage's is looked at",
          "[low_level][tracking]") {
  GridWatch watch;
  watch.see(20.0, 3);
  const auto water = told_by(watch);
  int free = 0;
  for (double x_m = -23.75; x_m < 24.0; x_m += 0.5) {
    for (double y_m = -23.75; y_m < 24.0; y_m += 0.5) {
      if (water->at(x_m, y_m) == WaterState::kFree && std::hypot(x_m, y_m) > 2.0) {
        ++free;
        for (const double dx_m : {-0.12, 0.12}) {
          for (const double dy_m : {-0.12, 0.12}) {
            CHECK(watch.at(x_m + dx_m, y_m + dy_m) == WaterState::kFree);
          }
        }
      }
    }
  }
  CHECK(free > 1000);
}

TEST_CASE("seen water: where the boat is, and nothing can be heard, is free unless it is not",
          "[low_level][tracking]") {
  GridWatch watch;
  watch.see(12.0, 3);
  auto water = told_by(watch);
  CHECK(water->at(0.0, 0.1) == WaterState::kFree);
  CHECK(water->at(0.0, -0.9) == WaterState::kFree);
  CHECK(water->at(0.0, -1.9) == WaterState::kUnknown);
  watch.hit(stone_at(0.0, -0.6, 0.2));
  water = told_by(watch);
  CHECK(water->at(0.0, -0.6) == WaterState::kOccupied);
}

TEST_CASE("seen water: free water grows old, a stone does not", "[low_level][tracking]") {
  GridWatch watch;
  watch.hit(stone_at(3.0, 8.0, 0.6));
  watch.see(7.0, 3);
  watch.hit(stone_at(3.0, 8.0, 0.6));
  CHECK(told_by(watch, 59.0)->at(0.0, 5.0) == WaterState::kFree);
  CHECK(told_by(watch, 61.0)->at(0.0, 5.0) == WaterState::kUnknown);
  CHECK(told_by(watch, 3600.0)->at(3.0, 8.0) == WaterState::kOccupied);
}

TEST_CASE("seen water: before the first ping nothing is known but the boat's own place",
          "[low_level][tracking]") {
  const EvidenceGrid grid;
  Coverage water;
  describe_water(grid, {0.0, 0.0}, 5.0, 1.0, water);
  CHECK(water.at(0.0, 0.5) == WaterState::kFree);
  CHECK(water.at(0.0, 5.0) == WaterState::kUnknown);
}

TEST_CASE("seen water: telling it does not allocate", "[low_level][tracking]") {
  GridWatch watch;
  watch.see(12.0, 3);
  Coverage water;
  const testing::AllocationScope scope;
  describe_water(watch.grid(), {0.0, 0.0}, watch.look().at_s, 1.0, water);
  CHECK(scope.count() == 0);
}

}  // namespace lodesman
