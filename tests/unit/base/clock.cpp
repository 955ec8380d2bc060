// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/clock.h"

#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("time: seconds become nanoseconds and back, rounded to the nearest",
          "[mid_level][base]") {
  CHECK(from_seconds(1.6).count() == 1'600'000'000);
  CHECK(from_seconds(-0.25).count() == -250'000'000);
  CHECK(to_seconds(Duration{1'500'000'000}) == Approx(1.5));
}

TEST_CASE("clock: the simulated clock stands where it was put", "[mid_level][base]") {
  SimClock clock;
  clock.advance_to(Time{Duration{5}});
  clock.advance_to(Time{Duration{5}});
  CHECK(clock.now() == Time{Duration{5}});
}
