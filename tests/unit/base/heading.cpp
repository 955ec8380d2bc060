// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/heading.h"

#include <random>

#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("heading: a turn to the right is positive and never longer than half a circle",
          "[mid_level][base]") {
  const auto heading = [](double deg) { return Heading::clockwise_from_y_rad(to_rad(deg)); };
  CHECK(to_deg(heading(0).turn_to_rad(heading(90))) == Approx(90));
  CHECK(to_deg(heading(350).turn_to_rad(heading(10))) == Approx(20));
  CHECK(to_deg(heading(10).turn_to_rad(heading(350))) == Approx(-20));
  CHECK(std::abs(to_deg(heading(90).turn_to_rad(heading(270)))) == Approx(180));
}

TEST_CASE("heading: a displacement to the east heads 90 degrees", "[mid_level][base]") {
  CHECK(to_deg(Heading::of_displacement(1, 0).rad()) == Approx(90));
  CHECK(to_deg(Heading::of_displacement(-1, -1).rad()) == Approx(-135));
  CHECK(to_deg(Heading::of_displacement(0, 0).rad()) == Approx(0).margin(1e-12));
}

TEST_CASE("heading: wrapping is idempotent and files show 0 to 360 degrees", "[mid_level][base]") {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> angle{-1000.0, 1000.0};
  for (int i = 0; i < 1000; ++i) {
    const double rad = angle(random);
    const double wrapped = wrap_to_pi(rad);
    CHECK(std::abs(wrapped) <= std::numbers::pi);
    CHECK(wrap_to_pi(wrapped) == Approx(wrapped));
    CHECK(compass_deg(rad) >= 0.0);
    CHECK(compass_deg(rad) < 360.0);
  }
  CHECK(compass_deg(-1e-18) < 360.0);
}
