// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/profile.h"

#include <cmath>
#include <random>

#include "mid_level/messages/sane.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/sonar/profiles.h"

namespace lodesman {
namespace {

using testing::covers;
using testing::disc_at;
using testing::kNowhere;
using testing::profile_of;
using testing::seen_in;
using testing::shipped_options;
using testing::Surface;
using testing::uncovered;

TEST_CASE("profile: of a disc the near side is an obstacle, where it lies", "[low_level][sonar]") {
  for (const double bearing_deg : {-50.0, -20.0, 0.0, 35.0, 55.0}) {
    for (const double distance_m : {3.0, 10.0, 25.0}) {
      const double x_m = distance_m * std::sin(to_rad(bearing_deg));
      const double y_m = distance_m * std::cos(to_rad(bearing_deg));
      const auto ping = profile_of({disc_at(x_m, y_m, 1.0)});
      const auto seen = seen_in(*ping);
      INFO(bearing_deg << " deg, " << distance_m << " m");
      REQUIRE(seen->count == 1);
      CHECK(uncovered(*ping, *seen, 0.1) == 0);
      for (std::uint32_t i = 0; i < seen->count; ++i) {
        const Obstacle& o = seen->obstacles[i];
        CHECK(std::hypot(o.centre_x_m - x_m, o.centre_y_m - y_m) < 1.1);
        CHECK(std::hypot(o.centre_x_m, o.centre_y_m) < distance_m);
        CHECK(o.peak == Approx(100.0));
        CHECK(o.semi_axis_first_m < 1.6);
      }
    }
  }
}

// Ranges in steps, as a head gives them.
void quantise(SonarPing& ping) {
  const double step_m = ping.range_m / 500.0;
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    ping.points[beam].range_m = std::round(ping.points[beam].range_m / step_m) * step_m;
  }
}

// An ellipse, its first semi-axis so much clockwise from the head's ahead.
[[nodiscard]] Surface oval(double x_m, double y_m, double first_m, double second_m,
                           double angle_rad) {
  const double s = std::sin(angle_rad);
  const double c = std::cos(angle_rad);
  return [=](double bearing_rad) {
    // In the ellipse's own frame, stretched to a circle of 1.
    const double u = (std::sin(bearing_rad) * s + std::cos(bearing_rad) * c) / first_m;
    const double v = (std::sin(bearing_rad) * c - std::cos(bearing_rad) * s) / second_m;
    const double p = (x_m * s + y_m * c) / first_m;
    const double q = (x_m * c - y_m * s) / second_m;
    const double a = u * u + v * v;
    const double b = u * p + v * q;
    const double root = b * b - a * (p * p + q * q - 1.0);
    return root >= 0.0 && b > 0.0 ? (b - std::sqrt(root)) / a : kNowhere;
  };
}

// How far from the disc lies water that was seen through and that an obstacle takes.
[[nodiscard]] double water_taken_m(const SonarPing& ping, const SonarObstacles& seen, double x_m,
                                   double y_m, double radius_m) {
  double most_m = 0.0;
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    const double r = ping.points[beam].range_m;
    const double b = ping.bearing_rad(beam);
    for (double before_m = 0.0; r > 0.0 && before_m < std::min(r, 2.0); before_m += 0.05) {
      const double there_x_m = (r - before_m) * std::sin(b);
      const double there_y_m = (r - before_m) * std::cos(b);
      if (covers(seen, there_x_m, there_y_m, 0.0)) {
        most_m = std::max(most_m, std::hypot(there_x_m - x_m, there_y_m - y_m) - radius_m);
      }
    }
  }
  return most_m;
}

TEST_CASE("profile: a round stone is one obstacle, at any range, size and number of beams",
          "[low_level][sonar]") {
  for (const double range_m : {10.0, 30.0, 100.0}) {
    for (const std::uint32_t beams : {120U, 240U, 480U}) {
      for (const double radius_m : {0.3, 0.5, 1.0, 1.4}) {
        for (const double share : {0.15, 0.4, 0.7, 0.9}) {
          const double distance_m = std::max(share * range_m, radius_m + 1.5);
          const double spacing_m = distance_m * to_rad(120.0 / beams);
          if (spacing_m > radius_m) {
            continue;  // hardly more than one return
          }
          const double x_m = 0.2 * distance_m;
          const auto ping = profile_of({disc_at(x_m, distance_m, radius_m)}, range_m, beams);
          quantise(*ping);
          const auto seen = seen_in(*ping);
          INFO(beams << " beams, " << radius_m << " m of " << distance_m << " in " << range_m);
          REQUIRE(seen->count == 1);
          const Obstacle& o = seen->obstacles[0];
          const double coarse_m = spacing_m + range_m / 500.0;
          // Between its tangents, which are nearer than its middle.
          const double nearer = 1.0 - std::pow(radius_m / std::hypot(x_m, distance_m), 2.0);
          CHECK(std::hypot(o.centre_x_m - nearer * x_m, o.centre_y_m - nearer * distance_m) <
                0.4 * radius_m + coarse_m);
          CHECK(o.semi_axis_first_m < 1.1 * radius_m + coarse_m);
          CHECK(uncovered(*ping, *seen, 0.1 + coarse_m) == 0);
          CHECK(water_taken_m(*ping, *seen, x_m, distance_m, radius_m) < 0.1 + coarse_m);
        }
      }
    }
  }
}

TEST_CASE("profile: an oval one is one obstacle, whichever way it lies", "[low_level][sonar]") {
  for (const double aspect : {0.3, 0.5, 0.8}) {
    for (double angle_deg = 0.0; angle_deg < 180.0; angle_deg += 15.0) {
      for (const double distance_m : {4.0, 10.0, 20.0}) {
        const auto ping =
            profile_of({oval(0.5, distance_m, 1.3, 1.3 * aspect, to_rad(angle_deg))}, 30.0, 240);
        quantise(*ping);
        const auto seen = seen_in(*ping);
        INFO("aspect " << aspect << " at " << angle_deg << " deg, " << distance_m << " m");
        REQUIRE(seen->count == 1);
        CHECK(uncovered(*ping, *seen, 0.35) <= 2);
        CHECK(seen->obstacles[0].semi_axis_first_m < 1.6);
      }
    }
  }
}

TEST_CASE("profile: a stone stays one in the noise of its returns", "[low_level][sonar]") {
  for (const std::uint32_t beams : {120U, 240U, 480U}) {
    const auto ping = profile_of({disc_at(-3.0, 12.0, 1.0)}, 30.0, beams,
                                 shipped_options().profile.range_noise_m);
    quantise(*ping);
    INFO(beams << " beams");
    CHECK(seen_in(*ping)->count == 1);
  }
}

TEST_CASE("profile: frame, time and range are the ping's", "[low_level][sonar]") {
  const auto ping = profile_of({disc_at(0.0, 10.0, 1.0)});
  const auto seen = seen_in(*ping);
  CHECK(seen->frame == 5);
  CHECK(seen->captured == ping->captured);
  CHECK(seen->range_m == Approx(30.0));
}

TEST_CASE("profile: two discs side by side are two, and the gap between them is free",
          "[low_level][sonar]") {
  const auto ping = profile_of({disc_at(-2.0, 10.0, 0.5), disc_at(2.0, 10.0, 0.5)});
  const auto seen = seen_in(*ping);
  REQUIRE(seen->count == 2);
  CHECK_FALSE(covers(*seen, 0.0, 9.5, 0.5));
}

TEST_CASE("profile: a return alone is an outlier, two side by side are an obstacle",
          "[low_level][sonar]") {
  const auto ping = profile_of({});
  CHECK(seen_in(*ping)->count == 0);
  ping->points[40] = {12.0, 0};
  CHECK(seen_in(*ping)->count == 0);
  ping->points[41] = {12.0, 0};
  CHECK(seen_in(*ping)->count == 1);
  SegmentationOptions options = shipped_options();
  options.profile.min_points = 1;
  ping->points[41] = {};
  CHECK(seen_in(*ping, options)->count == 1);
}

TEST_CASE("profile: what is nearer than the ring-down is none", "[low_level][sonar]") {
  const auto ping = profile_of({});
  const double near_m = shipped_options().min_range_m;
  for (std::uint32_t beam = 50; beam < 60; ++beam) {
    ping->points[beam] = {0.9 * near_m, 50};
  }
  CHECK(seen_in(*ping)->count == 0);
  for (std::uint32_t beam = 50; beam < 60; ++beam) {
    ping->points[beam] = {1.1 * near_m, 50};
  }
  CHECK(seen_in(*ping)->count == 1);
}

TEST_CASE("profile: bearings are the ping's own", "[low_level][sonar]") {
  const auto ping = profile_of({disc_at(0.0, 10.0, 1.0)});
  ping->set_bearings(to_rad(10.0), to_rad(0.5));  // beams 54 to 65 look at 37 to 42.5 degrees
  const auto seen = seen_in(*ping);
  REQUIRE(seen->count == 1);
  const double bearing_rad =
      std::atan2(seen->obstacles[0].centre_x_m, seen->obstacles[0].centre_y_m);
  CHECK(to_deg(bearing_rad) == Approx(39.75).margin(0.3));
}

TEST_CASE("profile: an image is none, nor is a ping that breaks its own ranges",
          "[low_level][sonar]") {
  const auto ping = profile_of({disc_at(0.0, 10.0, 1.0)});
  SECTION("as it is") {
    CHECK(seen_in(*ping)->count > 0);
    return;
  }
  SECTION("an image") { ping->kind = PingKind::kImage; }
  SECTION("no beams") { ping->beams = 0; }
  SECTION("too many beams") { ping->beams = kMaxBeams + 1; }
  SECTION("another count") { ping->point_count = 7; }
  SECTION("no step") { ping->beam_step_rad = 0.0; }
  const auto seen = std::make_unique<SonarObstacles>();
  ProfileDetector{shipped_options()}.detect(*ping, *seen);
  CHECK(seen->count == 0);
}

TEST_CASE("profile: any ranges give sound obstacles, and nothing is allocated",
          "[low_level][sonar]") {
  std::mt19937 random{2026};
  const auto pick = [&](std::uint32_t most) {
    return 1 + static_cast<std::uint32_t>(random() % most);
  };
  ProfileDetector detector{shipped_options()};
  const auto seen = std::make_unique<SonarObstacles>();
  std::uint32_t most = 0;
  for (int round = 0; round < 200; ++round) {
    const auto ping = profile_of({}, pick(300), pick(kMaxBeams));
    for (std::uint32_t beam = 0; beam < ping->beams; ++beam) {
      const bool goes_on = beam > 0 && pick(2) == 1;
      ping->points[beam].range_m = goes_on        ? ping->points[beam - 1].range_m
                                   : pick(3) == 1 ? 0.0
                                                  : ping->range_m * pick(1000) / 1000.0;
      ping->points[beam].intensity = pick(65535);
    }
    {
      const testing::AllocationScope scope;
      detector.detect(*ping, *seen);
      REQUIRE(scope.count() == 0);
    }
    REQUIRE(sane(*seen));
    most = std::max(most, seen->count + seen->dropped);
  }
  CHECK(most > kMaxObstacles);
}

}  // namespace
}  // namespace lodesman
