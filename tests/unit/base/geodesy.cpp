// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/geodesy.h"

#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("geodesy: a minute of latitude is a nautical mile to the north", "[mid_level][base]") {
  const LocalFrame frame{{35.0, 139.0}};
  const auto north = frame.to_world({35.0 + 1.0 / 60.0, 139.0});
  CHECK(north.xy_m.y() == Approx(1849.0).epsilon(1e-3));
  CHECK(north.xy_m.x() == Approx(0.0).margin(1e-6));
  CHECK(frame.to_world({35.0, 139.001}).xy_m.x() > 0.0);
}

TEST_CASE("geodesy: to_world undoes to_geo over a harbour", "[mid_level][base]") {
  const LocalFrame frame{{35.0, 139.0}};
  for (double x = -500.0; x <= 500.0; x += 125.0) {
    for (double y = -500.0; y <= 500.0; y += 125.0) {
      const auto back = frame.to_world(frame.to_geo({{x, y}}));
      CHECK((back.xy_m - Eigen::Vector2d{x, y}).norm() < 0.02);
    }
  }
}
