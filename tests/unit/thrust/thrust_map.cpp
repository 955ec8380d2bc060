// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/thrust_map.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("thrust map: the paper's worked example, -45 and +55, gives 156 and 37",
          "[low_level][thrust]") {
  CHECK(map_thrust(-45, 55) == ThrustCommand{156, 37});
}

TEST_CASE("thrust map: no reference stops both thrusters", "[low_level][thrust]") {
  CHECK(map_thrust(0, 0) == ThrustCommand{128, 128});
  CHECK(kNeutralThrust == ThrustCommand{128, 128});
}

TEST_CASE("thrust map: what eq. 13 takes to 256 is clamped to 255", "[low_level][thrust]") {
  CHECK(map_thrust(100, 100) == ThrustCommand{255, 128});
  CHECK(map_thrust(-100, -100) == ThrustCommand{0, 128});
  CHECK(map_thrust(1000, 1000) == map_thrust(100, 100));
  CHECK(map_thrust(-1000, 0) == map_thrust(-100, 0));
}

TEST_CASE("thrust map: a positive HeadRef drives the left thruster harder, which turns right",
          "[low_level][thrust]") {
  const ThrustCommand right_turn = map_thrust(16, 10);
  CHECK(right_turn.left > right_turn.right);
}

TEST_CASE("thrust map: monotone, odd about 128 to one count, left and right mirrored",
          "[low_level][thrust]") {
  for (int surge = -100; surge <= 100; ++surge) {
    for (int head = -100; head <= 100; ++head) {
      const ThrustCommand here = map_thrust(surge, head);
      const ThrustCommand mirrored = map_thrust(surge, -head);
      CHECK(here.left == mirrored.right);
      const ThrustCommand astern = map_thrust(-surge, -head);
      CHECK(std::abs((here.left - 128) + (astern.left - 128)) <= 1);
      if (surge < 100) {
        CHECK(map_thrust(surge + 1, head).left >= here.left);
      }
    }
  }
}

TEST_CASE("thrust map: thrust, the square of the offset, is linear in the references",
          "[low_level][thrust]") {
  for (int reference = -198; reference <= 198; ++reference) {
    const int surge = reference / 2;
    const int head = reference - surge;
    const double offset = map_thrust(surge, head).left - 128.0;
    const double thrust = std::copysign(offset * offset, offset);
    const double linear = 12.8 * 12.8 * reference / 2.0;
    const double one_count = 2.0 * std::abs(offset) + 1.0;  // what truncation takes away
    CHECK(std::abs(thrust - linear) <= one_count);
  }
}
