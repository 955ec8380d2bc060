// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/drift.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;
using Vec = Eigen::Vector2d;

namespace {

// Sails north through the water in a current to the east for so long; what is known of it then.
Vec known_after(DriftEstimate& drift, double from_s, double to_s, double current_m_s,
                double speed_m_s = 0.22, double yaw_rate_rad_s = 0.0) {
  Vec known = Vec::Zero();
  for (int tick = 0; tick * 0.05 < to_s - from_s; ++tick) {
    const double t_s = from_s + tick * 0.05;
    known = drift.follow(Time{from_seconds(t_s)}, {{current_m_s * t_s, speed_m_s * t_s}},
                         {0.0, speed_m_s}, yaw_rate_rad_s);
  }
  return known;
}

}  // namespace

TEST_CASE("drift: it is learnt in its time", "[high_level][estimate]") {
  DriftEstimate drift{milliseconds{10000}};
  const Vec known = known_after(drift, 1.0, 11.05, 0.1);
  const double learnt_m_s = 0.1 * (1.0 - std::exp(-1.0));
  CHECK(known.x() == Approx(learnt_m_s - 0.03 * 0.03 / learnt_m_s).epsilon(0.01));
  CHECK(known.y() == Approx(0.0).margin(1e-9));
  CHECK(known_after(drift, 11.05, 80.0, 0.1).x() == Approx(0.1 - 0.009).epsilon(0.01));
}

TEST_CASE("drift: the slip of a hull that turns is hardly taken for a current",
          "[high_level][estimate]") {
  DriftEstimate turning{milliseconds{4000}};
  CHECK(known_after(turning, 1.0, 6.0, 0.2, 1.12, 0.35).norm() < 0.02);
  CHECK(known_after(turning, 6.0, 11.0, 0.2, 1.12, -0.35).norm() < 0.04);
  DriftEstimate straight{milliseconds{4000}};
  CHECK(known_after(straight, 1.0, 6.0, 0.2, 1.12).norm() > 0.1);
  DriftEstimate slow{milliseconds{4000}};
  CHECK(known_after(slow, 1.0, 6.0, 0.2, 0.11, 0.35).norm() > 0.1);
}

TEST_CASE("drift: what may be an error of the speed through the water is no current",
          "[high_level][estimate]") {
  DriftEstimate drift{milliseconds{10000}};
  CHECK(known_after(drift, 1.0, 80.0, 0.028).norm() == Approx(0.0).margin(1e-12));
}

TEST_CASE("drift: a jump of the position after a silence is no current", "[high_level][estimate]") {
  DriftEstimate drift{milliseconds{10000}};
  (void)known_after(drift, 1.0, 5.0, 0.0);
  const Vec known = drift.follow(Time{from_seconds(9.0)}, {{50.0, 50.0}}, {0.0, 0.22}, 0.0);
  CHECK(known.norm() == Approx(0.0).margin(1e-9));
}

TEST_CASE("drift: a position that is mended at one stroke is no current",
          "[high_level][estimate]") {
  DriftEstimate drift{milliseconds{10000}};
  (void)known_after(drift, 1.0, 5.0, 0.0);
  const double last_s = 4.95;
  const Vec known = drift.follow(Time{from_seconds(last_s + 0.05)},
                                 {{30.0, 0.22 * (last_s + 0.05)}}, {0.0, 0.22}, 0.0);
  CHECK(known.norm() == Approx(0.0).margin(1e-9));
}
