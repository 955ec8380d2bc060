// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/frames.h"

#include <random>

#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("frames: eq. 3 sees a goal to the east on the starboard side of a boat heading north",
          "[mid_level][base]") {
  const VehiclePose pose{{{1.0, 2.0}}, Heading{}};
  const auto goal = pose.to_vehicle({{4.0, 6.0}});
  CHECK(goal.xy_m.x() == Approx(3.0));
  CHECK(goal.xy_m.y() == Approx(4.0));
}

TEST_CASE("frames: a boat heading east sees the north on its port side", "[mid_level][base]") {
  const VehiclePose pose{{{0.0, 0.0}}, Heading::clockwise_from_y_rad(to_rad(90.0))};
  const auto north = pose.to_vehicle({{0.0, 5.0}});
  CHECK(north.xy_m.x() == Approx(-5.0));
  CHECK(north.xy_m.y() == Approx(0.0).margin(1e-12));
  const auto ahead = pose.to_world({{0.0, 2.0}});
  CHECK(ahead.xy_m.x() == Approx(2.0));
}

TEST_CASE("frames: to_vehicle undoes to_world at any pose (eqs 3-6)", "[mid_level][base]") {
  std::mt19937_64 random{20};
  std::uniform_real_distribution<double> metre{-1000.0, 1000.0};
  std::uniform_real_distribution<double> angle{-10.0, 10.0};
  for (int i = 0; i < 1000; ++i) {
    const VehiclePose pose{{{metre(random), metre(random)}},
                           Heading::clockwise_from_y_rad(angle(random))};
    const VehiclePoint p{{metre(random), metre(random)}};
    const auto back = pose.to_vehicle(pose.to_world(p));
    CHECK((back.xy_m - p.xy_m).norm() < 1e-9);
    const double direction = angle(random);
    CHECK(wrap_to_pi(pose.angle_to_vehicle_rad(pose.angle_to_world_rad(direction)) - direction) ==
          Approx(0.0).margin(1e-12));
  }
}
