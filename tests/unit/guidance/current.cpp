// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/current.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace lodesman;
using Vec = Eigen::Vector2d;

TEST_CASE("current: what is steered leads along the course, at the speed asked for",
          "[high_level][guidance]") {
  for (double course = -3.0; course <= 3.0; course += 0.5) {
    const Vec direction{std::sin(course), std::cos(course)};
    for (const Vec& current : {Vec{0.0, 0.0}, Vec{0.15, 0.0}, Vec{-0.1, 0.12}}) {
      const Vec through = velocity_for_course(direction, 0.22, current);
      CHECK(through.norm() == Approx(0.22));
      const Vec over = through + current;
      CHECK(over.x() * direction.y() - over.y() * direction.x() == Approx(0.0).margin(1e-12));
      CHECK(through.dot(direction) >= 0.0);
    }
  }
}

TEST_CASE("current: against one that is too strong it goes straight across",
          "[high_level][guidance]") {
  const Vec through = velocity_for_course({0.0, 1.0}, 0.2, {0.5, 0.0});
  CHECK(through.x() == Approx(-0.2));
  CHECK(through.y() == Approx(0.0).margin(1e-12));
}
