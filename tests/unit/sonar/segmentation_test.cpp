// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/segmentation.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/sonar/synthetic.h"

namespace lodesman {
namespace {

using testing::empty_ping;
using testing::holds;
using testing::light;
using testing::light_disc;
using testing::shipped_options;

std::unique_ptr<SonarObstacles> segment(const SonarPing& ping,
                                        const SegmentationOptions& options = shipped_options()) {
  auto out = std::make_unique<SonarObstacles>();
  Segmenter{options}.segment(ping, *out);
  return out;
}

bool is_sound(const Obstacle& o) {
  return std::isfinite(o.centre_x_m) && std::isfinite(o.centre_y_m) && std::isfinite(o.angle_rad) &&
         std::isfinite(o.semi_axis_first_m) && std::isfinite(o.semi_axis_second_m) &&
         o.semi_axis_second_m > 0.0 && o.semi_axis_first_m >= o.semi_axis_second_m &&
         o.protection_first_m >= o.semi_axis_first_m &&
         o.protection_second_m >= o.semi_axis_second_m && o.vertex_count == 0;
}

}  // namespace

TEST_CASE("segmentation: an empty ping gives no obstacle, and keeps its number and time",
          "[low_level][sonar]") {
  const auto ping = empty_ping();
  ping->number = 7;
  ping->captured = Time{Duration{123}};
  const auto seen = segment(*ping);
  CHECK(seen->count == 0);
  CHECK(seen->dropped == 0);
  CHECK(seen->frame == 7);
  CHECK(seen->captured == ping->captured);
}

TEST_CASE("segmentation: a disc of echoes is found where it lies, left and right",
          "[low_level][sonar]") {
  const double range_m = GENERATE(4.0, 10.0, 20.0, 27.0);
  const double bearing_deg = GENERATE(-45.0, -10.5, 0.0, 10.5, 45.0);
  const auto ping = empty_ping();
  light_disc(*ping, range_m, to_rad(bearing_deg), 0.8, 180);
  const auto seen = segment(*ping);

  REQUIRE(seen->count == 1);
  const Obstacle& o = seen->obstacles[0];
  CHECK(o.shape == ObstacleShape::kEllipse);
  CHECK(std::hypot(o.centre_x_m, o.centre_y_m) == Approx(range_m).margin(0.5 * 30.0 / 500.0));
  CHECK(to_deg(std::atan2(o.centre_x_m, o.centre_y_m)) == Approx(bearing_deg).margin(0.5));
  CHECK((bearing_deg > 0.0) == (o.centre_x_m > 0.01));  // starboard, as displayed, is +x
  CHECK(o.peak == Approx(180.0));
  // The disc, a cell of smoothing on each side, and no more than the corners beyond.
  const double cell_m = std::max(0.06, range_m * to_rad(1.0));
  CHECK(o.semi_axis_second_m >= 0.75);
  CHECK(o.semi_axis_first_m <= 0.8 + 2.0 * cell_m);
  CHECK(o.protection_first_m == Approx(o.semi_axis_first_m + 1.5));
  CHECK(o.protection_second_m == Approx(o.semi_axis_second_m + 1.5));
}

TEST_CASE("segmentation: a slanted bar gives its direction, clockwise from ahead",
          "[low_level][sonar]") {
  const double angle_deg = GENERATE(-60.0, -20.0, 0.0, 35.0, 80.0);
  const auto ping = empty_ping();
  const double s = std::sin(to_rad(angle_deg));
  const double c = std::cos(to_rad(angle_deg));
  light(*ping, 200, [=](double x, double y) {
    const double along = (x - 2.0) * s + (y - 10.0) * c;
    const double across = (x - 2.0) * c - (y - 10.0) * s;
    return std::abs(along) <= 1.2 && std::abs(across) <= 0.3;
  });
  SegmentationOptions whole = shipped_options();
  whole.max_obstacle_length_m = 10.0;
  const auto seen = segment(*ping, whole);
  REQUIRE(seen->count == 1);
  const double turned = to_deg(seen->obstacles[0].angle_rad) - angle_deg;
  CHECK(std::abs(std::remainder(turned, 180.0)) < 4.0);
  CHECK(seen->obstacles[0].semi_axis_first_m == Approx(1.35).margin(0.25));
}

TEST_CASE("segmentation: an ellipse holds most of its blob", "[low_level][sonar]") {
  const auto ping = empty_ping();
  light_disc(*ping, 12.0, 0.2, 1.0);
  const auto seen = segment(*ping);
  REQUIRE(seen->count == 1);
  int inside = 0;
  int all = 0;
  light(*ping, 0, [&](double x, double y) {
    if (std::hypot(x - 12.0 * std::sin(0.2), y - 12.0 * std::cos(0.2)) <= 1.0) {
      ++all;
      inside += holds(seen->obstacles[0], x, y) ? 1 : 0;
    }
    return false;
  });
  CHECK(inside >= 0.95 * all);
}

TEST_CASE("segmentation: a wall gives several ellipses along it, none of them fat",
          "[low_level][sonar]") {
  const auto ping = empty_ping();
  light(*ping, 220, [](double x, double y) { return std::abs(y - 15.0) <= 0.3 && x >= -12.0; });
  const auto seen = segment(*ping);
  REQUIRE(seen->count >= 8);
  CHECK(seen->count <= 24);
  double left = 0.0;
  double right = 0.0;
  for (std::uint32_t i = 0; i < seen->count; ++i) {
    const Obstacle& o = seen->obstacles[i];
    CHECK(2.0 * o.semi_axis_first_m <= 3.0);
    CHECK(o.semi_axis_second_m <= 0.9);
    CHECK(o.centre_y_m == Approx(15.0).margin(0.25));
    left = std::min(left, o.centre_x_m);
    right = std::max(right, o.centre_x_m);
  }
  CHECK(left < -10.0);
  CHECK(right > 20.0);
  for (double x = -11.5; x < 24.0; x += 0.25) {  // the protection zones leave no gap
    CHECK(std::any_of(seen->obstacles.begin(), seen->obstacles.begin() + seen->count,
                      [x](Obstacle o) {
                        o.semi_axis_first_m = o.protection_first_m;
                        o.semi_axis_second_m = o.protection_second_m;
                        return holds(o, x, 15.0);
                      }));
  }
}

TEST_CASE("segmentation: a ring of echoes leaves the water within it free", "[low_level][sonar]") {
  const auto ping = empty_ping();
  light(*ping, 200,
        [](double x, double y) { return std::abs(std::hypot(x, y - 15.0) - 5.0) <= 0.3; });
  const auto seen = segment(*ping);
  REQUIRE(seen->count >= 8);
  for (std::uint32_t i = 0; i < seen->count; ++i) {
    CHECK_FALSE(holds(seen->obstacles[i], 0.0, 15.0));
  }
}

TEST_CASE("segmentation: what is too near, too faint or too small is no obstacle",
          "[low_level][sonar]") {
  SECTION("ring-down of the head") {
    const auto ping = empty_ping();
    light(*ping, 255, [](double x, double y) { return std::hypot(x, y) < 0.9; });
    CHECK(segment(*ping)->count == 0);
  }
  SECTION("just below the threshold") {
    const auto ping = empty_ping();
    light_disc(*ping, 10.0, 0.0, 1.0, 49);
    CHECK(segment(*ping)->count == 0);
  }
  SECTION("at the threshold, the inner bins") {
    const auto ping = empty_ping();
    light_disc(*ping, 10.0, 0.0, 1.0, 50);
    CHECK(segment(*ping)->count == 1);
  }
  SECTION("a single bin: smoothing takes it away") {
    const auto ping = empty_ping();
    ping->echo[60 * 500 + 250] = 255;
    CHECK(segment(*ping)->count == 0);
  }
}

TEST_CASE("segmentation: a blob cut by the fan's edge stays finite and on its side",
          "[low_level][sonar]") {
  const double bearing_deg = GENERATE(-60.0, 60.0);
  const auto ping = empty_ping();
  light_disc(*ping, 29.8, to_rad(bearing_deg), 1.0);
  const auto seen = segment(*ping);
  REQUIRE(seen->count == 1);
  CHECK(is_sound(seen->obstacles[0]));
  CHECK((seen->obstacles[0].centre_x_m > 0.0) == (bearing_deg > 0.0));
}

TEST_CASE("segmentation: of more than kMaxObstacles the nearest are kept and the rest counted",
          "[low_level][sonar]") {
  const auto ping = empty_ping();
  std::uint32_t made = 0;
  for (int row = 0; row < 12; ++row) {
    for (int column = -5; column <= 5; ++column) {
      light_disc(*ping, 6.0 + 2.0 * row, to_rad(10.0 * column), 0.35);
      ++made;
    }
  }
  const auto seen = segment(*ping);
  CHECK(seen->count == kMaxObstacles);
  CHECK(seen->count + seen->dropped == made);
  for (std::uint32_t i = 0; i < seen->count; ++i) {
    CHECK(seen->obstacles[i].centre_y_m < 18.5);  // 64 of 11 in a row: the first six rows
  }
}

TEST_CASE("segmentation: a stripe along one bearing is interference, an obstacle over it is not",
          "[low_level][sonar]") {
  const auto ping = empty_ping();
  std::mt19937 random{5};
  for (std::uint32_t beam = 59; beam <= 60; ++beam) {
    for (std::uint32_t bin = 0; bin < 500; ++bin) {
      ping->echo[beam * 500 + bin] = static_cast<std::uint8_t>(40 + random() % 90);
    }
  }
  CHECK(segment(*ping)->count == 0);
  light_disc(*ping, 12.0, 0.0, 0.8, 230);
  const auto seen = segment(*ping);
  REQUIRE(seen->count == 1);
  CHECK(seen->obstacles[0].centre_y_m == Approx(12.0).margin(0.1));
  CHECK(seen->obstacles[0].centre_x_m == Approx(0.0).margin(0.1));
}

TEST_CASE("segmentation: a wide bright sector is never taken for interference",
          "[low_level][sonar]") {
  const auto ping = empty_ping();
  light(*ping, 255, [](double x, double y) { return std::abs(std::atan2(x, y)) < 0.2; });
  CHECK(segment(*ping)->count > 0);
}

TEST_CASE("segmentation: any bytes and any size give sound obstacles", "[low_level][sonar]") {
  std::mt19937 random{20240607};
  Segmenter segmenter{shipped_options()};
  const auto seen = std::make_unique<SonarObstacles>();
  for (int round = 0; round < 24; ++round) {
    const auto pick = [&](std::uint32_t most) {
      return 1 + static_cast<std::uint32_t>(random() % most);
    };
    const auto ping =
        empty_ping(0.1 * pick(3000), round % 3 == 0 ? pick(kMaxBeams) : pick(8), pick(kMaxBins));
    ping->make_image(ping->beams, ping->bins, std::numbers::pi * pick(100) / 100.0);
    const std::uint32_t ceiling = pick(255);
    for (std::uint32_t i = 0; i < ping->echo_count; ++i) {
      ping->echo[i] = static_cast<std::uint8_t>(random() % (ceiling + 1));
    }
    segmenter.segment(*ping, *seen);
    REQUIRE(seen->count <= kMaxObstacles);
    for (std::uint32_t i = 0; i < seen->count; ++i) {
      REQUIRE(is_sound(seen->obstacles[i]));
    }
  }
}

TEST_CASE("segmentation: everything bright is a bounded amount of work and obstacles",
          "[low_level][sonar]") {
  const auto ping = empty_ping(30.0, kMaxBeams, kMaxBins);
  light(*ping, 255, [](double, double) { return true; });
  const auto seen = segment(*ping);
  CHECK(seen->count == kMaxObstacles);
  CHECK(seen->dropped <= 256 - kMaxObstacles);
  CHECK(std::all_of(seen->obstacles.begin(), seen->obstacles.end(), is_sound));
}

TEST_CASE("segmentation: one bin longer than any obstacle may be is kept as it is",
          "[low_level][sonar]") {
  const auto ping = empty_ping(300.0, 2, 40);
  ping->make_image(2, 40, 3.0);
  light(*ping, 255, [](double, double y) { return y > 0.0; });
  SegmentationOptions options = shipped_options();
  options.min_blob_bins = 1;
  options.stripe_max_beams = 0;
  const auto seen = segment(*ping, options);
  CHECK(seen->count > 0);
  CHECK(std::all_of(seen->obstacles.begin(), seen->obstacles.begin() + seen->count, is_sound));
}

TEST_CASE("segmentation: allocates nothing once it is made", "[low_level][sonar]") {
  const auto ping = empty_ping();
  light(*ping, 220, [](double x, double y) { return std::abs(y - 15.0) <= 0.3 || x > 5.0; });
  const auto seen = std::make_unique<SonarObstacles>();
  Segmenter segmenter{shipped_options()};
  const testing::AllocationScope scope;
  segmenter.segment(*ping, *seen);
  const std::uint64_t allocations = scope.count();
  CHECK(allocations == 0);
  CHECK(seen->count > 0);
}

TEST_CASE("segmentation: a ping that breaks its own ranges gives none", "[low_level][sonar]") {
  const auto ping = empty_ping();
  light_disc(*ping, 10.0, 0.0, 1.0);
  SECTION("no beams") { ping->beams = 0; }
  SECTION("too many beams") { ping->beams = kMaxBeams + 1; }
  SECTION("too many bins") { ping->bins = kMaxBins + 1; }
  SECTION("another count") { ping->echo_count -= 1; }
  SECTION("no range") { ping->range_m = std::nan(""); }
  SECTION("a sector round the head") { ping->sector_rad = 4.0; }
  CHECK(segment(*ping)->count == 0);
}

}  // namespace lodesman
