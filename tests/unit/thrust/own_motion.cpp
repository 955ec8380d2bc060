// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/own_motion.h"

#include <cmath>

#include "tests/support/catch.h"
#include "tests/unit/thrust/a_hull.h"

using namespace lodesman;
using lodesman::testing::a_hull;

namespace {

[[nodiscard]] ReckonedMotion sailed(ReckonedMotion from, const SurgeAndHead& thrust, double for_s) {
  const ReckoningModel model{a_hull()};
  for (double left_s = for_s; left_s > 1e-9; left_s -= ReckoningModel::kStepMax_s) {
    from = model.advanced(from, thrust, ReckoningModel::kStepMax_s);
  }
  return from;
}

}  // namespace

TEST_CASE("own motion: it settles at the speed of the boat's own table", "[low_level][thrust]") {
  for (const int surge_ref : {8, 31, 57, 91, 100}) {
    const double settled_m_s = sailed({}, {surge_ref, 0}, 60.0).surge_m_s;
    CHECK(settled_m_s == Approx(a_hull().speeds.speed_m_s(surge_ref)).epsilon(1e-3));
  }
}

TEST_CASE("own motion: it coasts as a hull with linear and quadratic drag does",
          "[low_level][thrust]") {
  ReckonedMotion from;
  from.surge_m_s = 1.12;
  const ReckonedMotion to = sailed(from, {}, 3.0);
  // In closed form: u = a / ((a / u0 + b) exp(a t / m) - b).
  const double a = 41.3;
  const double b = 6.5;
  const double expected_m_s = a / ((a / 1.12 + b) * std::exp(a * 3.0 / 95.0) - b);
  CHECK(to.surge_m_s == Approx(expected_m_s).epsilon(1e-3));
  CHECK(to.y_m > 1.0);
  CHECK(to.x_m == Approx(0.0).margin(1e-12));
}

TEST_CASE("own motion: astern gives its share of the thrust ahead", "[low_level][thrust]") {
  HullResponse hull = a_hull();
  hull.astern_share = 0.5;
  const ReckoningModel weak{hull};
  const ReckoningModel strong{a_hull()};
  const double weak_m_s = weak.advanced({}, {-100, 0}, 0.01).surge_m_s;
  const double strong_m_s = strong.advanced({}, {-100, 0}, 0.01).surge_m_s;
  CHECK(weak_m_s == Approx(strong_m_s / 2.0).epsilon(0.01));
  CHECK(weak.advanced({}, {100, 0}, 0.01).surge_m_s == Approx(-strong_m_s).epsilon(0.01));
}

TEST_CASE("own motion: a turn to starboard leads to the right", "[low_level][thrust]") {
  const ReckonedMotion to = sailed({}, {57, 50}, 4.0);
  CHECK(to.yaw_rate_rad_s > 0.1);
  CHECK(to.heading_rad > 0.2);
  CHECK(to.x_m > 0.1);
}
