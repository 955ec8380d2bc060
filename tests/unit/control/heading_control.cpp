// SPDX-License-Identifier: Apache-2.0
#include "high_level/control/heading_control.h"

#include "tests/support/catch.h"

using namespace lodesman;

namespace {
Heading deg(double value) { return Heading::clockwise_from_y_rad(to_rad(value)); }
}  // namespace

TEST_CASE("heading control: a boat that points left of its reference turns right (eq. 9)",
          "[high_level][control]") {
  CHECK(head_ref(deg(-10), deg(0), 2.0) == 20);
  CHECK(head_ref(deg(10), deg(0), 2.0) == -20);
  CHECK(head_ref(deg(0), deg(0), 2.0) == 0);
}

TEST_CASE("heading control: it takes the short way round through north", "[high_level][control]") {
  CHECK(head_ref(deg(350), deg(10), 2.0) == 40);
  CHECK(head_ref(deg(10), deg(350), 2.0) == -40);
}

TEST_CASE("heading control: HeadRef is a whole number from -100 to 100", "[high_level][control]") {
  CHECK(head_ref(deg(0), deg(170), 2.0) == 100);
  CHECK(head_ref(deg(0), deg(-170), 2.0) == -100);
  CHECK(head_ref(deg(0), deg(1.3), 1.0) == 1);
  CHECK(head_ref(deg(0), deg(1.7), 1.0) == 2);
}
