// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/dead_reckoning.h"

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;

namespace {

const DeadReckoningOptions kPaper{milliseconds{200}, SpeedTable::proportional(0.01375)};

DeadReckoning sailed(double heading_deg, int surge_ref, Duration tick, Duration whole) {
  DeadReckoning reckoning{kPaper, {{1.0, 2.0}}};
  for (Duration t{}; t <= whole; t += tick) {
    reckoning.advance(Time{t}, surge_ref, Heading::clockwise_from_y_rad(to_rad(heading_deg)));
  }
  return reckoning;
}

}  // namespace

TEST_CASE("dead reckoning: eqs 24-25 go k SurgeRef along the measured heading",
          "[high_level][estimate]") {
  const auto east = sailed(90, 16, milliseconds{50}, std::chrono::seconds{10});
  CHECK(east.position().xy_m.x() == Approx(1.0 + 0.22 * 10.0));
  CHECK(east.position().xy_m.y() == Approx(2.0));
  const auto north_west = sailed(-45, 16, milliseconds{50}, std::chrono::seconds{10});
  CHECK(north_west.position().xy_m.x() == Approx(1.0 - 2.2 * std::sqrt(0.5)));
  CHECK(north_west.position().xy_m.y() == Approx(2.0 + 2.2 * std::sqrt(0.5)));
}

TEST_CASE("dead reckoning: how often it is asked changes nothing", "[high_level][estimate]") {
  const auto often = sailed(30, 16, milliseconds{10}, std::chrono::seconds{6});
  const auto seldom = sailed(30, 16, milliseconds{200}, std::chrono::seconds{6});
  CHECK((often.position().xy_m - seldom.position().xy_m).norm() == Approx(0.0).margin(1e-9));
}

TEST_CASE("dead reckoning: a long silence is not made up for", "[high_level][estimate]") {
  DeadReckoning reckoning{kPaper, {}};
  reckoning.advance(Time{}, 16, {});
  reckoning.advance(Time{std::chrono::hours{1}}, 16, {});
  CHECK(reckoning.position().xy_m.y() <= Approx(0.22 * 0.2 * 10));
}

TEST_CASE("dead reckoning: a fix draws the estimate by its share", "[high_level][estimate]") {
  DeadReckoning reckoning{kPaper, {}};
  reckoning.correct({{4.0, -2.0}}, 0.25);
  CHECK(reckoning.position().xy_m.x() == Approx(1.0));
  reckoning.correct({{4.0, -2.0}}, 1.0);
  CHECK(reckoning.position().xy_m.y() == Approx(-2.0));
}

TEST_CASE("dead reckoning: between two steps the position is carried on to the time asked for",
          "[high_level][estimate]") {
  DeadReckoning reckoning{kPaper, {}};
  reckoning.advance(Time{}, 16, {});
  reckoning.advance(Time{milliseconds{300}}, 16, {});
  CHECK(reckoning.position().xy_m.y() == Approx(0.22 * 0.2));
  CHECK(reckoning.position_at(Time{milliseconds{300}}, 16, {}).xy_m.y() == Approx(0.22 * 0.3));
  CHECK(reckoning.position().xy_m.y() == Approx(0.22 * 0.2));
}
