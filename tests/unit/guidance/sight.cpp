// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/sight.h"

#include "tests/support/catch.h"
#include "tests/unit/guidance/support.h"

namespace lodesman::testing {

TEST_CASE("sight: a frame that does not come is missed, and in the end all of it is lost",
          "[high_level][guidance]") {
  SightWatch watch{std::chrono::seconds{2}};
  CHECK(watch.look(at_s(10.0), at_s(9.9)) == Sight::kNew);
  CHECK(watch.look(at_s(10.1), at_s(10.0)) == Sight::kNew);
  CHECK(watch.look(at_s(10.5), at_s(10.0)) == Sight::kNew);
  CHECK(watch.look(at_s(10.51), at_s(10.0)) == Sight::kLate);
  CHECK(watch.look(at_s(12.0), at_s(10.0)) == Sight::kLate);
  CHECK(watch.look(at_s(12.01), at_s(10.0)) == Sight::kLost);
  CHECK(watch.look(at_s(30.1), at_s(30.0)) == Sight::kNew);
}

TEST_CASE("sight: a slow sonar is late by its own measure", "[high_level][guidance]") {
  SightWatch watch{std::chrono::seconds{2}};
  CHECK(watch.look(at_s(10.0), at_s(10.0)) == Sight::kNew);
  CHECK(watch.look(at_s(10.4), at_s(10.4)) == Sight::kNew);
  CHECK(watch.look(at_s(11.4), at_s(10.4)) == Sight::kNew);
  CHECK(watch.look(at_s(11.41), at_s(10.4)) == Sight::kLate);
  // Never later than half of what it is lost after.
  CHECK(watch.look(at_s(12.3), at_s(12.3)) == Sight::kNew);
  CHECK(watch.look(at_s(13.31), at_s(12.3)) == Sight::kLate);
}

TEST_CASE("sight: how long a silence lasted says nothing of how often frames come",
          "[high_level][guidance]") {
  SightWatch watch{std::chrono::seconds{2}};
  CHECK(watch.look(at_s(10.0), at_s(10.0)) == Sight::kNew);
  CHECK(watch.look(at_s(40.0), at_s(40.0)) == Sight::kNew);
  CHECK(watch.look(at_s(40.51), at_s(40.0)) == Sight::kLate);
}

TEST_CASE("sight: an old frame of a program before is no sight", "[high_level][guidance]") {
  SightWatch watch{std::chrono::seconds{2}};
  CHECK(watch.look(at_s(10.0), at_s(5.0)) == Sight::kLost);
}

}  // namespace lodesman::testing
