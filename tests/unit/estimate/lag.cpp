// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/lag.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;

TEST_CASE("lag: it comes within 1/e in its time, however often it is asked",
          "[high_level][estimate]") {
  for (const milliseconds tick : {milliseconds{10}, milliseconds{100}, milliseconds{2000}}) {
    Lag lag{milliseconds{2000}};
    double value = lag.follow(Time{}, 5.0);
    CHECK(value == Approx(0.0).margin(1e-12));
    for (Duration t = tick; t <= milliseconds{2000}; t += tick) {
      value = lag.follow(Time{t}, 5.0);
    }
    CHECK(value == Approx(5.0 * (1.0 - std::exp(-1.0))));
  }
}

TEST_CASE("lag: without a time it does as it is told", "[high_level][estimate]") {
  Lag lag{Duration::zero()};
  CHECK(lag.follow(Time{}, 0.22) == Approx(0.22));
  CHECK(lag.follow(Time{milliseconds{50}}, -1.0) == Approx(-1.0));
}
