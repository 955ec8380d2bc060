// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/tangent_path.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "low_level/path/plane.h"
#include "tests/support/catch.h"
#include "tests/unit/path/tangent_check.h"

namespace lodesman::testing {
namespace {

constexpr PointPx kBoat{433.0, 499.0};
constexpr PointPx kAhead{433.0, 99.0};

// Asks, and checks whatever path comes back.
struct Asked {
  TangentPath planner;
  TangentResult result;
  RegionPx region = RegionPx::fan();

  PathReason from_to(const Zones& zones, PointPx start, PointPx goal) {
    result = planner.find(zones, region, start, goal);
    if (result.reason == PathReason::kFound) {
      require_sound(result, zones, region, start, goal);
    } else if (result.reason == PathReason::kNoPath) {
      // As near to the goal as it came.
      REQUIRE_FALSE(result.path.empty());
      REQUIRE(length_of(result.path.front() - start) <= 0.0);
      REQUIRE(length_of(result.path.back() - goal) <= length_of(start - goal));
    } else {
      REQUIRE(result.path.empty());
      REQUIRE(result.length_px <= 0.0);
    }
    return result.reason;
  }
  PathReason ahead(const Zones& zones) { return from_to(zones, kBoat, kAhead); }
};

// The tangent from a point to a circle whose centre is `away` along the way and `off` to the side
// on which it is not passed, and the arc up to where it runs along the way.
double tangent_and_arc(double off, double away, double radius) {
  const double distance = std::hypot(off, away);
  const double bearing = std::atan2(away, -off);
  const double arc = radius * (bearing - std::acos(radius / distance));
  return std::sqrt(distance * distance - radius * radius) + arc;
}

void require_length(const TangentResult& result, double exact) {
  REQUIRE(result.length_px >= exact);
  REQUIRE(result.length_px <= exact * 1.0003);
}

TEST_CASE("tangent_path: without anything between, the path is the line", "[low_level][path]") {
  Asked asked;
  REQUIRE(asked.ahead({}) == PathReason::kFound);
  REQUIRE(asked.result.path.size() == 2);
  REQUIRE(asked.result.length_px == Approx(400.0));
  REQUIRE(asked.from_to({}, kAhead, kAhead) == PathReason::kFound);
  REQUIRE(asked.result.length_px <= 0.0);
}

TEST_CASE("tangent_path: what the line does not touch is not looked at", "[low_level][path]") {
  Asked asked;
  const Zones zones{disc_px(373.0, 299.0, 59.9), disc_px(493.0, 299.0, 59.9),
                    wall_px({{433.5, 80.0}, {600.0, 60.0}}, 0.5)};
  REQUIRE(asked.ahead(zones) == PathReason::kFound);
  REQUIRE(asked.result.tried == 1);
}

TEST_CASE("tangent_path: one circle costs two tangents and an arc", "[low_level][path]") {
  Asked asked;
  for (const double radius : {0.01, 1.0, 5.0, 30.0, 60.0, 120.0}) {
    REQUIRE(asked.ahead({disc_px(433.0, 299.0, radius)}) == PathReason::kFound);
    require_length(asked.result, 2.0 * tangent_and_arc(0.0, 200.0, radius));
  }
}

TEST_CASE("tangent_path: dead ahead it is passed to starboard", "[low_level][path]") {
  Asked asked;
  for (const double radius : {7.0, 33.3, 58.0}) {
    REQUIRE(asked.ahead({disc_px(433.0, 299.0, radius)}) == PathReason::kFound);
    for (const PointPx point : asked.result.path) {
      REQUIRE(point.column >= 433.0);
    }
  }
}

TEST_CASE("tangent_path: overlapping circles are gone round together", "[low_level][path]") {
  Asked asked;
  // One behind the other: their common tangent runs along the way.
  REQUIRE(asked.ahead({disc_px(433.0, 320.0, 50.0), disc_px(433.0, 270.0, 50.0)}) ==
          PathReason::kFound);
  const double exact = tangent_and_arc(0.0, 179.0, 50.0) + 50.0 + tangent_and_arc(0.0, 171.0, 50.0);
  require_length(asked.result, exact);
  // A capsule is the same, and so is one with a vertex more.
  REQUIRE(asked.ahead({wall_px({{433.0, 320.0}, {433.0, 270.0}}, 50.0)}) == PathReason::kFound);
  require_length(asked.result, exact);
  REQUIRE(asked.ahead({wall_px({{433.0, 320.0}, {433.0, 301.0}, {433.0, 270.0}}, 50.0)}) ==
          PathReason::kFound);
  require_length(asked.result, exact);
  // Beside each other: round the one whose far side is nearer.
  REQUIRE(asked.ahead({disc_px(398.0, 299.0, 50.0), disc_px(458.0, 299.0, 50.0)}) ==
          PathReason::kFound);
  require_length(asked.result, 2.0 * tangent_and_arc(25.0, 200.0, 50.0));
  // The same shape twice, and one in another, change nothing.
  REQUIRE(asked.ahead({disc_px(458.0, 299.0, 50.0), disc_px(398.0, 299.0, 50.0),
                       disc_px(458.0, 299.0, 50.0), disc_px(470.0, 299.0, 30.0)}) ==
          PathReason::kFound);
  require_length(asked.result, 2.0 * tangent_and_arc(25.0, 200.0, 50.0));
}

TEST_CASE("tangent_path: ellipses that cross in four points have two common tangents on a side",
          "[low_level][path]") {
  Asked asked;
  for (const double thin : {20.0, 2.0, 0.5, 0.01, 1e-6}) {
    const EllipsePx across = EllipsePx::with_angle({433.0, 299.0}, 80.0, thin, 0.0);
    const EllipsePx along = EllipsePx::with_angle({433.0, 299.0}, 80.0, thin, std::numbers::pi / 2);
    REQUIRE(asked.ahead({across, along}) == PathReason::kFound);
    REQUIRE(asked.result.length_px >= 2.0 * std::hypot(200.0, 80.0));
    REQUIRE(asked.result.length_px <= 2.0 * std::hypot(200.0, 80.0) + 3.0 * thin + 0.1);
    // From beside the upright one's far end, over it and round the other.
    REQUIRE(asked.from_to({across, along}, {453.0, 429.0}, {353.0, 249.0}) == PathReason::kFound);
  }
}

TEST_CASE("tangent_path: what is touched is closed, what is wider is open", "[low_level][path]") {
  Asked asked;
  const auto gap = [](double width) {
    return Zones{wall_px({{-100.0, 299.0}, {333.0 - width / 2.0, 299.0}}, 100.0),
                 wall_px({{533.0 + width / 2.0, 299.0}, {1000.0, 299.0}}, 100.0)};
  };
  REQUIRE(asked.ahead(gap(0.0)) == PathReason::kNoPath);
  REQUIRE(asked.ahead(gap(-1.0)) == PathReason::kNoPath);
  REQUIRE(asked.from_to(gap(0.05), {450.0, 450.0}, {420.0, 110.0}) == PathReason::kFound);
}

TEST_CASE("tangent_path: a start or goal at a shape's edge is blocked, a hair off it is not",
          "[low_level][path]") {
  Asked asked;
  const EllipsePx disc = disc_px(433.0, 299.0, 64.0);
  REQUIRE(asked.from_to({disc}, {433.0, 363.0}, kAhead) == PathReason::kStartBlocked);
  REQUIRE(asked.from_to({disc}, kBoat, {497.0, 299.0}) == PathReason::kGoalBlocked);
  for (int k = 0; k < 360; ++k) {
    const double t = k * std::numbers::pi / 180.0 + 0.001;
    for (const double b : {64.0, 5.0, 0.3}) {
      const EllipsePx shape = EllipsePx::with_angle({433.0, 299.0}, 64.0, b, 0.3);
      const double u = (64.0 + 1e-6) * std::cos(t);
      const double v = (b + 1e-6) * std::sin(t);
      const PointPx near{433.0 + u * shape.cos_theta - v * shape.sin_theta,
                         299.0 + u * shape.sin_theta + v * shape.cos_theta};
      CAPTURE(k, b, near.column, near.row);
      REQUIRE(asked.from_to({shape}, near, kAhead) == PathReason::kFound);
      const double there = asked.result.length_px;
      REQUIRE(asked.from_to({shape}, kAhead, near) == PathReason::kFound);
      REQUIRE(asked.result.length_px == Approx(there).margin(1e-5));
    }
  }
}

TEST_CASE("tangent_path: what is ringed cannot be reached, but through a gap",
          "[low_level][path]") {
  Asked asked;
  const PointPx goal{433.0, 200.0};
  const auto ring = [](bool closed) {
    return wall_px({{383.0, 150.0}, {483.0, 150.0}, {483.0, 250.0}, {383.0, 250.0}}, 2.0, closed);
  };
  REQUIRE(asked.from_to({ring(false)}, kBoat, goal) == PathReason::kFound);
  REQUIRE(asked.from_to({ring(true)}, kBoat, goal) == PathReason::kGoalBlocked);
  REQUIRE(asked.from_to({ring(true)}, goal, kBoat) == PathReason::kStartBlocked);
  // An open wall encloses nothing, so the goal is free, and yet there is no way.
  const Zones shut{ring(false), wall_px({{383.0, 150.0}, {383.0, 250.0}}, 2.0)};
  REQUIRE(asked.from_to(shut, kBoat, goal) == PathReason::kNoPath);
  REQUIRE(asked.from_to(shut, goal, kBoat) == PathReason::kNoPath);
  Zones discs;
  for (int k = 0; k < 12; ++k) {
    const double t = k * std::numbers::pi / 6.0;
    discs.emplace_back(disc_px(433.0 + 60.0 * std::cos(t), 200.0 + 60.0 * std::sin(t), 16.0));
  }
  REQUIRE(asked.from_to(discs, kBoat, goal) == PathReason::kNoPath);
  discs.pop_back();
  REQUIRE(asked.from_to(discs, kBoat, goal) == PathReason::kFound);
}

TEST_CASE("tangent_path: nothing is passed outside the region", "[low_level][path]") {
  Asked asked;
  // Sticks out of the fan to starboard; the way to port is longer.
  const Zones zones{wall_px({{400.0, 299.0}, {800.0, 299.0}}, 5.0)};
  REQUIRE(asked.from_to(zones, {533.0, 399.0}, {533.0, 199.0}) == PathReason::kFound);
  bool to_port = false;
  for (const PointPx point : asked.result.path) {
    to_port = to_port || point.column < 400.0;
  }
  REQUIRE(to_port);
  REQUIRE(asked.from_to({wall_px({{50.0, 299.0}, {800.0, 299.0}}, 5.0)}, kBoat, kAhead) ==
          PathReason::kNoPath);
  asked.region = RegionPx::rectangle({-5000.0, -5000.0}, {5000.0, 5000.0});
  REQUIRE(asked.from_to({wall_px({{50.0, 299.0}, {800.0, 299.0}}, 5.0)}, kBoat, kAhead) ==
          PathReason::kFound);
  REQUIRE(asked.from_to({}, kBoat, {5000.0, -5000.0}) == PathReason::kFound);
  REQUIRE(asked.from_to({}, kBoat, {5000.1, 0.0}) == PathReason::kGoalOutOfView);
}

TEST_CASE("tangent_path: each reason, in its order", "[low_level][path]") {
  Asked asked;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  REQUIRE(asked.from_to({}, {433.0, 499.1}, {0.0, 0.0}) == PathReason::kStartBlocked);
  REQUIRE(asked.from_to({}, {nan, 300.0}, kAhead) == PathReason::kStartBlocked);
  REQUIRE(asked.from_to({}, kBoat, {0.0, 0.0}) == PathReason::kGoalOutOfView);
  REQUIRE(asked.from_to({}, kBoat, {433.0, nan}) == PathReason::kGoalOutOfView);
  REQUIRE(asked.from_to({disc_px(433.0, 499.0, 500.0)}, kBoat, kAhead) ==
          PathReason::kStartBlocked);
  REQUIRE(asked.from_to({disc_px(0.0, 0.0, 10.0)}, kBoat, {0.0, 0.0}) ==
          PathReason::kGoalOutOfView);
  REQUIRE(asked.ahead({disc_px(433.0, 99.0, 10.0)}) == PathReason::kGoalBlocked);
  for (const double bad : {nan, infinity, -1.0, 0.0}) {
    REQUIRE(asked.ahead({disc_px(700.0, 299.0, bad)}) == PathReason::kStartBlocked);
  }
  REQUIRE(asked.ahead({wall_px({{700.0, nan}}, 1.0)}) == PathReason::kStartBlocked);
}

TEST_CASE("tangent_path: each limit ends the search and says so", "[low_level][path]") {
  const Zones zones{disc_px(433.0, 299.0, 40.0), disc_px(400.0, 250.0, 40.0)};
  const auto reason_under = [&zones](TangentLimits limits) {
    TangentPath planner{limits};
    return planner.find(zones, RegionPx::fan(), kBoat, kAhead).reason;
  };
  TangentPath planner;
  const TangentResult result = planner.find(zones, RegionPx::fan(), kBoat, kAhead);
  REQUIRE(result.reason == PathReason::kFound);

  TangentLimits limits;
  limits.max_tried = result.tried;
  limits.max_waypoints = static_cast<std::uint32_t>(result.path.size());
  REQUIRE(reason_under(limits) == PathReason::kFound);
  limits.max_tried = result.tried - 1;
  REQUIRE(reason_under(limits) == PathReason::kLimit);
  limits = {};
  limits.max_waypoints = static_cast<std::uint32_t>(result.path.size()) - 1;
  REQUIRE(reason_under(limits) == PathReason::kLimit);
  limits = {};
  limits.max_corners = 100;
  REQUIRE(reason_under(limits) == PathReason::kLimit);
  limits = {};
  limits.max_open = 3;
  REQUIRE(reason_under(limits) == PathReason::kLimit);

  const Zones crowd(kMaxObstacles + 1, disc_px(700.0, 250.0, 5.0));
  REQUIRE(planner.find(crowd, RegionPx::fan(), kBoat, kAhead).reason == PathReason::kLimit);
  REQUIRE(
      planner.find(std::span{crowd}.first(kMaxObstacles), RegionPx::fan(), kBoat, kAhead).reason ==
      PathReason::kFound);
}

}  // namespace
}  // namespace lodesman::testing
