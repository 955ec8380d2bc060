// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/jump_points.h"

#include "tests/support/catch.h"
#include "tests/unit/path/reference_search.h"

namespace lodesman::testing {
namespace {

TEST_CASE("jump points: each pixel has one, and clear() forgets them", "[low_level][path]") {
  JumpPoints points{1000};
  for (int i = 0; i < 1000; ++i) {
    REQUIRE(points.at(pixel(i % 40, i / 40)) == i);
  }
  for (int i = 0; i < 1000; ++i) {
    REQUIRE(points.at(pixel(i % 40, i / 40)) == i);
    REQUIRE(same(points[i].pixel, pixel(i % 40, i / 40)));
  }
  points[7].cost = 10;
  points.clear();
  REQUIRE(points.count() == 0);
  const std::int32_t again = points.at(pixel(7, 0));
  REQUIRE(again == 0);
  REQUIRE(points[again].cost == JumpPoint{}.cost);
}

TEST_CASE("jump points: arrivals are kept one behind the other, as long as there is room",
          "[low_level][path]") {
  JumpPoints points{3};
  std::int32_t first = JumpPoints::kNone;
  for (const std::int32_t from : {4, 5, 6}) {
    REQUIRE(points.arrive(from, first));
  }
  REQUIRE_FALSE(points.arrive(7, first));
  int expected = 6;
  for (std::int32_t i = first; i != JumpPoints::kNone; i = points.arrival(i).next) {
    REQUIRE(points.arrival(i).from == expected--);
  }
  REQUIRE(expected == 3);
}

}  // namespace
}  // namespace lodesman::testing
