// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/raw_difference.h"

#include <limits>
#include <memory>

#include "mid_level/messages/path.h"
#include "mid_level/messages/vehicle.h"
#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("raw difference: messages that are the same have none, measured times left out",
          "[recording]") {
  SonarPath recorded;
  SonarPath replayed;
  recorded.plan_time_ns = 1;
  replayed.plan_time_ns = 2;
  CHECK_FALSE(first_difference(recorded, replayed).has_value());
}

TEST_CASE("raw difference: the first field that differs is named, with both values",
          "[recording]") {
  VehicleState recorded;
  VehicleState replayed;
  replayed.y_m = 0.5;
  replayed.heading_rad = 1.0;
  const auto difference = first_difference(recorded, replayed);
  REQUIRE(difference.has_value());
  CHECK(difference->path == "y_m");
  CHECK(difference->recorded == "0");
  CHECK(difference->replayed == "0.5");
}

TEST_CASE("raw difference: one bit of a number is a difference, another NaN is none",
          "[recording]") {
  VehicleState recorded;
  VehicleState replayed;
  replayed.x_m = -0.0;
  CHECK(first_difference(recorded, replayed).has_value());
  recorded.x_m = std::numeric_limits<double>::quiet_NaN();
  replayed.x_m = -recorded.x_m;
  CHECK_FALSE(first_difference(recorded, replayed).has_value());
}

TEST_CASE("raw difference: in a list its element is named, or how many there are", "[recording]") {
  const auto recorded = std::make_unique<Plan>();
  const auto replayed = std::make_unique<Plan>();
  recorded->waypoint_count = replayed->waypoint_count = 3;
  replayed->waypoints[2].x_m = 1.0;
  replayed->waypoints[3].x_m = 1.0;  // no part of it
  auto difference = first_difference(*recorded, *replayed);
  REQUIRE(difference.has_value());
  CHECK(difference->path == "waypoints[2].x_m");
  replayed->waypoint_count = 2;
  difference = first_difference(*recorded, *replayed);
  REQUIRE(difference.has_value());
  CHECK(difference->recorded == "3");
  CHECK(difference->replayed == "2");
}
