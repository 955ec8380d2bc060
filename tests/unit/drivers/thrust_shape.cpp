// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/thrust_shape.h"

#include <cmath>
#include <functional>
#include <limits>

#include "mid_level/base/random_stream.h"
#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

namespace lodesman {
namespace {

using std::chrono::milliseconds;

constexpr Time kStart{std::chrono::seconds{100}};
constexpr Duration kPeriod = milliseconds{50};

[[nodiscard]] ThrustShapeOptions curve(std::initializer_list<ThrustCurvePoint> points) {
  ThrustShapeOptions options;
  for (const ThrustCurvePoint& point : points) {
    options.curve.at(options.curve_points++) = point;
  }
  return options;
}

[[nodiscard]] ThrustShapeOptions gentle() {
  ThrustShapeOptions options = curve({{-1.0, -0.6}, {-0.2, -0.1}, {0.3, 0.4}, {1.0, 0.9}});
  options.deadband = 0.06;
  options.slew_per_s = 1.5;
  options.zero_pause = milliseconds{300};
  return options;
}

// What the shape without memory makes of a share: the first call of a new one without a limit.
[[nodiscard]] double at_once(ThrustShapeOptions options, double share) {
  options.slew_per_s = 0.0;
  return ThrustShape{options}.shape(share, kStart);
}

// Random commands that hold for a while; `check(wanted, given, before)` at each step.
void sail(const ThrustShapeOptions& options, std::uint64_t seed,
          const std::function<void(double, double, double, Time)>& check) {
  RandomStream chance{"thrust shape", seed};
  ThrustShape shape{options};
  Time now = kStart;
  double wanted = 0.0;
  double before = shape.shape(0.0, now);
  for (int i = 0; i < 4000; ++i) {
    now += kPeriod;
    if (chance.uniform() < 0.1) {
      wanted = chance.uniform() < 0.2 ? 0.0 : 2.4 * chance.uniform() - 1.2;
    }
    const double given = shape.shape(wanted, now);
    check(wanted, given, before, now);
    before = given;
  }
}

TEST_CASE("thrust shape: as it stands it changes nothing", "[drivers]") {
  ThrustShape shape{{}};
  for (const double share : {0.0, 1.0, -1.0, 0.008, -0.5, 0.5, 0.0}) {
    CHECK(shape.shape(share, kStart) == Approx(share).margin(1e-15));
  }
}

TEST_CASE("thrust shape: what is no share of thrust is none", "[drivers]") {
  ThrustShape shape{{}};
  CHECK(shape.shape(7.0, kStart) == Approx(1.0));
  CHECK(shape.shape(-std::numeric_limits<double>::infinity(), kStart) == Approx(-1.0));
  CHECK(shape.shape(std::numeric_limits<double>::quiet_NaN(), kStart) == Approx(0.0).margin(0.0));
}

TEST_CASE("thrust shape: a curve goes through its points and through zero", "[drivers]") {
  const ThrustShapeOptions options = curve({{-0.8, -0.4}, {0.2, 0.5}, {0.6, 0.9}});
  const std::pair<double, double> rows[] = {{-1.0, -0.4}, {-0.8, -0.4}, {-0.4, -0.2},
                                            {0.0, 0.0},   {0.1, 0.25},  {0.2, 0.5},
                                            {0.4, 0.7},   {0.6, 0.9},   {1.0, 0.9}};
  for (const auto& [in, out] : rows) {
    INFO(in);
    CHECK(at_once(options, in) == Approx(out).margin(1e-12));
  }
  const ThrustShapeOptions ahead_only = curve({{1.0, 0.5}});
  CHECK(at_once(ahead_only, 0.5) == Approx(0.25));
  CHECK(at_once(ahead_only, -0.5) == Approx(-0.5));
}

TEST_CASE("thrust shape: curves that cannot be are refused", "[drivers]") {
  const ThrustShapeOptions bad[] = {curve({{0.5, 0.5}, {0.5, 0.6}}),
                                    curve({{0.5, 0.5}, {0.6, 0.4}}),
                                    curve({{0.5, -0.1}}),
                                    curve({{0.0, 0.1}}),
                                    curve({{0.5, 1.1}}),
                                    curve({{std::numeric_limits<double>::quiet_NaN(), 0.5}})};
  for (const ThrustShapeOptions& options : bad) {
    CHECK_THROWS_AS(ThrustShape{options}, StartupError);
  }
  ThrustShapeOptions options;
  options.curve_points = 9;
  CHECK_THROWS_AS(ThrustShape{options}, StartupError);
  options = {};
  options.deadband = 1.0;
  CHECK_THROWS_AS(ThrustShape{options}, StartupError);
  options = {};
  options.slew_per_s = -1.0;
  CHECK_THROWS_AS(ThrustShape{options}, StartupError);
  options = {};
  options.zero_pause = milliseconds{-1};
  CHECK_THROWS_AS(ThrustShape{options}, StartupError);
}

TEST_CASE("thrust shape: without memory it rises with the command and keeps its sign",
          "[drivers]") {
  double before = -2.0;
  for (int i = -1000; i <= 1000; ++i) {
    const double share = i / 1000.0;
    const double given = at_once(gentle(), share);
    CHECK(given >= before);
    CHECK(given * share >= 0.0);
    CHECK((i == 0) == (std::abs(given) < 1e-12));
    before = given;
  }
}

TEST_CASE("thrust shape: T10, neutral is never delayed, nor is less of the same", "[drivers]") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    int stops = 0;
    sail(gentle(), seed, [&](double wanted, double given, double before, Time) {
      const double aim = at_once(gentle(), wanted);
      if (std::abs(aim) < 1e-12) {
        REQUIRE(std::abs(given) < 1e-12);
        stops += std::abs(before) > 0.0 ? 1 : 0;
      } else if (aim * before > 0.0 && std::abs(aim) <= std::abs(before)) {
        REQUIRE(given == Approx(aim));
      }
      REQUIRE(std::abs(given) <= std::abs(aim) + 1e-12);
    });
    CHECK(stops > 10);
  }
}

TEST_CASE("thrust shape: T10, thrust grows no faster than it may", "[drivers]") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    int limited = 0;
    sail(gentle(), seed, [&](double wanted, double given, double before, Time) {
      const double step = 1.5 * to_seconds(kPeriod);
      const double from = given * before > 0.0 ? std::abs(before) : 0.0;
      REQUIRE(std::abs(given) <= std::max(from, 0.06) + step + 1e-12);
      limited += std::abs(given) < std::abs(at_once(gentle(), wanted)) - 1e-9 ? 1 : 0;
    });
    CHECK(limited > 100);
  }
}

TEST_CASE("thrust shape: T11, between ahead and astern it pauses at zero", "[drivers]") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    int reversals = 0;
    double direction = 0.0;
    Time stood_since = kStart;
    sail(gentle(), seed, [&](double, double given, double before, Time now) {
      if (std::abs(given) < 1e-12) {
        stood_since = std::abs(before) < 1e-12 ? stood_since : now;
        return;
      }
      REQUIRE(given * before >= 0.0);
      if (given * direction < 0.0) {
        REQUIRE(now - stood_since >= milliseconds{300});
        ++reversals;
      }
      direction = given;
    });
    CHECK(reversals > 10);
  }
}

TEST_CASE("thrust shape: T11, a speed controller that wants its pause gets astern", "[drivers]") {
  ThrustShape shape{gentle()};
  static_cast<void>(shape.shape(1.0, kStart));
  Time now = kStart;
  double given = 1.0;
  int steps = 0;
  for (; given >= 0.0 && steps < 100; ++steps) {
    given = shape.shape(-1.0, now += kPeriod);
  }
  CHECK(steps == 7);  // six of them at zero
  CHECK(given < 0.0);
}

TEST_CASE("thrust shape: between nothing and the least that turns the propeller lies nothing",
          "[drivers]") {
  int least = 0;
  sail(gentle(), 3, [&](double, double given, double, Time) {
    REQUIRE((std::abs(given) < 1e-12 || std::abs(given) >= 0.06 - 1e-12));
    least += std::abs(given) > 0.0 && std::abs(given) < 0.15 ? 1 : 0;
  });
  CHECK(least > 10);
}

TEST_CASE("thrust shape: a long silence is no time to grow in, nor is time that runs back",
          "[drivers]") {
  ThrustShapeOptions options;
  options.slew_per_s = 1.0;
  ThrustShape shape{options};
  static_cast<void>(shape.shape(0.0, kStart));
  CHECK(shape.shape(1.0, kStart + std::chrono::hours{1}) == Approx(0.2));
  CHECK(shape.shape(1.0, kStart) == Approx(0.2));
}

}  // namespace
}  // namespace lodesman
