// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/contrast.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/sonar/synthetic.h"

namespace lodesman {
namespace {

using testing::empty_ping;
using testing::light;
using testing::light_disc;
using testing::shipped_options;

std::unique_ptr<SonarObstacles> detect(const SonarPing& ping) {
  auto out = std::make_unique<SonarObstacles>();
  ContrastDetector{shipped_options()}.detect(ping, *out);
  return out;
}

// Water of that mean, as it varies in the shared frames.
void speckle(SonarPing& ping, double mean, std::uint32_t seed = 1) {
  std::mt19937 random{seed};
  std::weibull_distribution<double> level{3.6, mean / 0.9};
  for (std::uint32_t i = 0; i < ping.echo_count; ++i) {
    ping.echo[i] = static_cast<std::uint8_t>(std::min(255.0, std::round(level(random))));
  }
}

std::unique_ptr<SonarPing> water(double mean, std::uint32_t beams = 120, std::uint32_t bins = 500) {
  auto ping = empty_ping(30.0, beams, bins);
  speckle(*ping, mean);
  return ping;
}

bool holds(const Obstacle& o, double x_m, double y_m) {
  return o.shape == ObstacleShape::kEllipse ? testing::holds(o, x_m, y_m) : encloses(o, {x_m, y_m});
}

bool any_holds(const SonarObstacles& seen, double x_m, double y_m) {
  return std::any_of(seen.obstacles.begin(), seen.obstacles.begin() + seen.count,
                     [&](const Obstacle& o) { return holds(o, x_m, y_m); });
}

bool is_sound(const Obstacle& o) {
  const bool ellipse = o.shape == ObstacleShape::kEllipse;
  return sane(o) && o.fits() && o.vertex_count <= kMaxVertices &&
         (ellipse ? o.protection_first_m >= o.semi_axis_first_m : o.protection_first_m >= 0.0);
}

}  // namespace

TEST_CASE("contrast: water alone is free, however bright, and keeps its number and time",
          "[low_level][sonar]") {
  for (const double mean : {0.0, 1.5, 8.0, 60.0}) {
    const auto ping = water(mean);
    ping->number = 7;
    ping->captured = Time{Duration{9}};
    const auto seen = detect(*ping);
    CHECK(seen->count == 0);
    CHECK(seen->frame == 7);
    CHECK(seen->captured == ping->captured);
    CHECK(seen->range_m == Approx(30.0));
  }
}

TEST_CASE("contrast: a disc is found where it lies, at any gain, left and right",
          "[low_level][sonar]") {
  for (const double mean : {2.0, 10.0, 40.0}) {
    for (const double bearing_deg : {-40.0, 0.0, 25.0}) {
      const auto ping = water(mean);
      light_disc(*ping, 12.0, to_rad(bearing_deg), 0.8,
                 static_cast<std::uint8_t>(std::min(255.0, 6.0 * mean)));
      const auto seen = detect(*ping);
      REQUIRE(seen->count == 1);
      const Obstacle& o = seen->obstacles[0];
      CHECK(o.shape == ObstacleShape::kEllipse);
      CHECK(std::hypot(o.centre_x_m, o.centre_y_m) == Approx(12.0).margin(0.1));
      CHECK(to_deg(std::atan2(o.centre_x_m, o.centre_y_m)) == Approx(bearing_deg).margin(0.6));
      CHECK(o.semi_axis_first_m == Approx(0.8).margin(0.25));
      CHECK(o.protection_first_m > o.semi_axis_first_m);
    }
  }
}

TEST_CASE("contrast: with more beams and bins the same disc lies at the same place",
          "[low_level][sonar]") {
  for (const auto& [beams, bins] : {std::pair{120U, 500U}, std::pair{256U, 703U},
                                    std::pair{512U, 1000U}, std::pair{130U, 999U}}) {
    const auto ping = water(10.0, beams, bins);
    light_disc(*ping, 12.0, to_rad(-30.0), 0.8, 60);
    const auto seen = detect(*ping);
    REQUIRE(seen->count == 1);
    CHECK(seen->obstacles[0].centre_x_m == Approx(-6.0).margin(0.1));
    CHECK(seen->obstacles[0].centre_y_m == Approx(10.39).margin(0.1));
  }
}

TEST_CASE("contrast: what is as bright in most beams is bottom or ring, and no obstacle",
          "[low_level][sonar]") {
  const auto ping = water(8.0);
  light(*ping, 40, [](double x, double y) { return std::abs(std::hypot(x, y) - 14.0) < 0.4; });
  CHECK(detect(*ping)->count == 0);
  light_disc(*ping, 14.0, 0.0, 0.8, 220);
  CHECK(detect(*ping)->count == 1);
}

TEST_CASE("contrast: a wall all round is no ring of the bottom's", "[low_level][sonar]") {
  for (const double mean : {0.0, 4.0}) {
    const auto ping = water(mean);
    light(*ping, 180, [](double x, double y) { return std::abs(std::hypot(x, y) - 6.0) < 0.15; });
    const auto seen = detect(*ping);
    REQUIRE(seen->count == 1);
    for (const double bearing_deg : {-50.0, 0.0, 30.0}) {
      CHECK(holds(seen->obstacles[0], 6.0 * std::sin(to_rad(bearing_deg)),
                  6.0 * std::cos(to_rad(bearing_deg))));
    }
  }
}

TEST_CASE("contrast: in a fan of thirty degrees what fills a range is a wall",
          "[low_level][sonar]") {
  const auto ping = empty_ping(10.0, 60, 500);
  ping->make_image(60, 500, to_rad(30.0));
  speckle(*ping, 40.0);
  light(*ping, 200, [](double, double y) { return y > 6.0 && y < 6.5; });
  const auto seen = detect(*ping);
  REQUIRE(seen->count == 1);
  CHECK(holds(seen->obstacles[0], 0.0, 6.2));
  CHECK(holds(seen->obstacles[0], 1.4, 6.2));
  CHECK_FALSE(holds(seen->obstacles[0], 0.0, 5.8));
}

TEST_CASE("contrast: a wall is one polygon along it, and the water before it is free",
          "[low_level][sonar]") {
  const auto ping = water(8.0);
  const auto to_wall_m = [](double x, double y) { return (x + y - 20.0) / std::sqrt(2.0); };
  light(*ping, 90, [&](double x, double y) { return std::abs(to_wall_m(x, y) - 0.3) < 0.3; });
  const auto seen = detect(*ping);
  REQUIRE(seen->count == 1);
  const Obstacle& wall = seen->obstacles[0];
  REQUIRE(wall.shape == ObstacleShape::kPolygon);
  CHECK(wall.vertex_count <= kMaxVertices);
  for (double x = 0.0; x < 11.0; x += 0.5) {
    CHECK(holds(wall, x + 0.2, 20.2 - x));
    CHECK_FALSE(holds(wall, x - 0.4, 19.6 - x));
  }
}

TEST_CASE("contrast: specks are none, and a stripe along one bearing is none",
          "[low_level][sonar]") {
  const auto ping = water(10.0);
  std::mt19937 random{5};
  for (int i = 0; i < 60; ++i) {
    ping->echo[random() % ping->echo_count] = 255;
  }
  for (std::uint32_t beam = 58; beam < 61; ++beam) {
    for (std::uint32_t bin = 0; bin < ping->bins; ++bin) {
      ping->echo[beam * ping->bins + bin] = bin % 5 < 3 ? 180 : 30;
    }
  }
  CHECK(detect(*ping)->count == 0);
  light_disc(*ping, 10.0, to_rad(1.0), 1.0, 250);
  const auto seen = detect(*ping);
  REQUIRE(seen->count >= 1);
  CHECK(any_holds(*seen, 0.5, 10.0));
}

TEST_CASE("contrast: of however many echoes none is left out", "[low_level][sonar]") {
  const auto ping = water(4.0);
  std::vector<std::array<double, 2>> places;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 14; ++column) {
      const double range_m = 6.0 + 4.0 * row + 1.3 * (column % 3);
      const double bearing_deg = 8.0 * column - 52.0;
      light_disc(*ping, range_m, to_rad(bearing_deg), 0.3, 200);
      places.push_back(
          {range_m * std::sin(to_rad(bearing_deg)), range_m * std::cos(to_rad(bearing_deg))});
    }
  }
  REQUIRE(places.size() > kMaxObstacles);
  const auto seen = detect(*ping);
  CHECK(seen->count <= kMaxObstacles);
  CHECK(seen->dropped == 0);
  for (const auto& [x_m, y_m] : places) {
    CAPTURE(x_m, y_m, seen->count);
    CHECK(any_holds(*seen, x_m, y_m));
  }
}

TEST_CASE("contrast: a ping that is blinded is no free water", "[low_level][sonar]") {
  const auto ping = empty_ping();
  light(*ping, 230, [](double, double) { return true; });
  const auto seen = detect(*ping);
  REQUIRE(seen->count >= 1);
  CHECK(any_holds(*seen, 0.0, 5.0));
  CHECK(any_holds(*seen, 10.0, 20.0));
}

TEST_CASE("contrast: any bytes and any size give sound obstacles, and nothing is allocated",
          "[low_level][sonar]") {
  std::mt19937 random{20240607};
  ContrastDetector detector{shipped_options()};
  const auto seen = std::make_unique<SonarObstacles>();
  for (int round = 0; round < 48; ++round) {
    const auto pick = [&](std::uint32_t most) {
      return 1 + static_cast<std::uint32_t>(random() % most);
    };
    const auto ping =
        empty_ping(0.1 * pick(3000), round % 3 == 0 ? pick(kMaxBeams) : pick(8), pick(kMaxBins));
    ping->make_image(ping->beams, ping->bins, std::numbers::pi * pick(100) / 100.0);
    const std::uint32_t period = pick(40);
    const std::uint32_t ceiling = pick(255);
    for (std::uint32_t i = 0; i < ping->echo_count; ++i) {
      const bool lit = round % 2 == 0 || i / period % 2 == 0;
      ping->echo[i] = static_cast<std::uint8_t>(lit ? random() % (ceiling + 1) : 0);
    }
    const testing::AllocationScope scope;
    detector.detect(*ping, *seen);
    const std::uint64_t allocations = scope.count();
    CHECK(allocations == 0);
    REQUIRE(seen->count <= kMaxObstacles);
    CHECK(std::all_of(seen->obstacles.begin(), seen->obstacles.begin() + seen->count, is_sound));
  }
}

TEST_CASE("contrast: a ping that breaks its own ranges gives none", "[low_level][sonar]") {
  const auto ping = empty_ping();
  light_disc(*ping, 10.0, 0.0, 1.0);
  SECTION("no beams") { ping->beams = 0; }
  SECTION("too many beams") { ping->beams = kMaxBeams + 1; }
  SECTION("another count") { ping->echo_count -= 1; }
  SECTION("no range") { ping->range_m = std::nan(""); }
  SECTION("a sector round the head") { ping->sector_rad = 4.0; }
  SECTION("a profile") { ping->kind = PingKind::kProfile; }
  CHECK(detect(*ping)->count == 0);
}

}  // namespace lodesman
