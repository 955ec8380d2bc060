// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/devices/sim_sonar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>

#include "hal_sim/sonar/echo.h"
#include "hal_sim/world/clearance.h"
#include "mid_level/messages/sane.h"
#include "tests/support/catch.h"
#include "tests/unit/devices/support.h"

namespace lodesman {
namespace {

using testing::HandWorld;

[[nodiscard]] MovingObstacle circle(double x_m, double y_m, double radius_m) {
  MovingObstacle mover;
  mover.at_start.centre_x_m = x_m;
  mover.at_start.centre_y_m = y_m;
  mover.at_start.semi_axis_first_m = mover.at_start.semi_axis_second_m = radius_m;
  return mover;
}

[[nodiscard]] MovingObstacle wall(ObstacleShape shape, std::initializer_list<Vertex> vertices) {
  MovingObstacle mover;
  mover.at_start.shape = shape;
  for (const Vertex& vertex : vertices) {
    mover.at_start.vertices[mover.at_start.vertex_count++] = vertex;
  }
  return mover;
}

[[nodiscard]] std::unique_ptr<SonarPing> ping_of(const Scenario& scenario, HandWorld& world) {
  auto ping = std::make_unique<SonarPing>();
  SimSonar sonar{scenario, world.link()};
  world.step();
  REQUIRE(sonar.poll(world.now(), *ping) == ReadStatus::kFresh);
  return ping;
}

// First bin with an echo; -1 for a silent beam.
[[nodiscard]] int first_echo(const SonarPing& ping, std::uint32_t beam) {
  for (std::uint32_t bin = 0; bin < ping.bins; ++bin) {
    if (ping.echo[beam * ping.bins + bin] != 0) {
      return static_cast<int>(bin);
    }
  }
  return -1;
}

TEST_CASE("sim sonar: a circle ahead echoes from its near side, and nothing behind it",
          "[hal_sim][devices]") {
  HandWorld world;
  Scenario scenario;
  scenario.sonar.beams = 121;  // one straight ahead
  scenario.obstacles = {circle(0.0, 10.0, 0.5),
                        wall(ObstacleShape::kPolyline, {{-50.0, 20.0}, {50.0, 20.0}})};
  const auto ping = ping_of(scenario, world);
  CHECK(ping->number == 1);
  CHECK(ping->captured == world.now());
  CHECK(ping->range_m == Approx(30.0));
  CHECK(ping->echo_count == 121 * 500);
  // 9.5 m of 30 m in 500 bins of 6 cm.
  CHECK(first_echo(*ping, 60) == 158);
  const auto* beam = ping->echo.data() + 60 * 500;
  CHECK(static_cast<int>(beam[158]) == 200);
  CHECK(beam[159] < beam[158]);
  CHECK(static_cast<int>(beam[162]) == 0);
  CHECK(static_cast<int>(beam[333]) == 0);
  // 20 m / cos of the bearing, in the beams that pass the circle.
  for (const std::uint32_t i : {10U, 30U, 90U}) {
    const double range_m = 20.0 / std::cos(ping->bearing_rad(i));
    CHECK(first_echo(*ping, i) == (range_m < 30.0 ? static_cast<int>(range_m / 0.06) : -1));
  }
}

TEST_CASE("sim sonar: left is left, and the heading turns the view", "[hal_sim][devices]") {
  HandWorld world;
  Scenario scenario;
  scenario.obstacles = {circle(-5.0, 8.0, 1.0)};
  const double bearing_deg = to_deg(std::atan2(-5.0, 8.0));
  const auto ping = ping_of(scenario, world);
  CHECK(first_echo(*ping, static_cast<std::uint32_t>(60.0 + bearing_deg)) > 0);
  CHECK(first_echo(*ping, static_cast<std::uint32_t>(60.0 - bearing_deg)) == -1);
  HandWorld turned;
  turned.state.heading_rad = to_rad(bearing_deg);
  const auto ahead = ping_of(scenario, turned);
  CHECK(first_echo(*ahead, 60) == static_cast<int>((std::hypot(5.0, 8.0) - 1.0) / 0.06));
}

TEST_CASE("sim sonar: only what exists then, where it is then", "[hal_sim][devices]") {
  Scenario scenario;
  scenario.sonar.beams = 1;
  scenario.obstacles = {circle(0.0, 10.0, 1.0)};
  scenario.obstacles[0].appears_at_s = 1.0;
  scenario.obstacles[0].velocity_y_m_s = -1.0;
  HandWorld early;
  CHECK(first_echo(*ping_of(scenario, early), 0) == -1);
  HandWorld later;
  later.state.scenario_time_s = 2.98;
  CHECK(first_echo(*ping_of(scenario, later), 0) == 100);
}

TEST_CASE("sim sonar: in the scene of detections a ping is a profile, with the scenario's errors",
          "[hal_sim][devices]") {
  Scenario scenario;
  scenario.seed = 3;
  scenario.sonar.beams = 121;
  scenario.sonar.scene = SonarScene::kDetections;
  scenario.obstacles = {circle(0.0, 10.0, 1.0)};
  const auto middle_of = [&](double y_m, double time_s) {
    HandWorld world;
    world.state.y_m = y_m;
    world.state.scenario_time_s = time_s;
    const auto ping = ping_of(scenario, world);
    CHECK(ping->kind == PingKind::kProfile);
    CHECK(sane(*ping));
    CHECK(ping->number == 1);
    CHECK(ping->captured == world.now());
    CHECK(ping->beams == 121);
    CHECK(ping->bearing_rad(60) == Approx(0.0).margin(1e-12));
    return ping->points[60].range_m;
  };
  CHECK(middle_of(0.0, 0.0) == Approx(9.0));
  CHECK(middle_of(4.0, 0.0) == Approx(5.0));
  scenario.obstacles[0].velocity_y_m_s = 0.5;
  CHECK(middle_of(0.0, 3.98) == Approx(11.0));
  scenario.sonar.detections.noise_m = 0.1;
  const double noisy_m = middle_of(0.0, 3.98);
  CHECK(std::abs(noisy_m - 11.0) > 1e-6);
  CHECK(std::abs(noisy_m - 11.0) < 0.6);
  scenario.seed = 4;
  CHECK(std::abs(middle_of(0.0, 3.98) - noisy_m) > 1e-6);
}

TEST_CASE("sim sonar: without noise a ping is its clean echoes alone, whatever the seed",
          "[hal_sim][devices]") {
  Scenario scenario;
  scenario.obstacles = {circle(-2.0, 10.0, 1.5),
                        wall(ObstacleShape::kPolyline, {{-50.0, 20.0}, {50.0, 26.0}})};
  HandWorld world;
  const auto ping = ping_of(scenario, world);
  scenario.seed = 99;
  HandWorld another;
  CHECK(ping_of(scenario, another)->echo == ping->echo);
  std::vector<std::uint8_t> clean(ping->echo_count);
  for (std::uint32_t beam = 0; beam < ping->beams; ++beam) {
    const double bearing_rad = ping->bearing_rad(beam);
    double nearest_m = 1e9;
    for (const MovingObstacle& mover : scenario.obstacles) {
      nearest_m = std::min(nearest_m, ray_range_m(mover.at_start, {},
                                                  {std::sin(bearing_rad), std::cos(bearing_rad)}));
    }
    const auto first = static_cast<std::size_t>(nearest_m / 30.0 * 500.0);
    const std::array<std::uint8_t, 4> echo{200, 150, 100, 50};
    for (std::size_t i = 0; i < echo.size() && first + i < 500; ++i) {
      clean[beam * 500 + first + i] = echo[i];
    }
  }
  CHECK(std::equal(clean.begin(), clean.end(), ping->echo.begin()));
}

TEST_CASE("sim sonar: noise is heard, the same for the same seed", "[hal_sim][devices]") {
  for (const SonarNoise noise : {SonarNoise::kTank, SonarNoise::kSea}) {
    Scenario scenario;
    scenario.sonar.noise = noise;
    scenario.obstacles = {circle(0.0, 10.0, 1.0)};
    scenario.seed = 5;
    HandWorld one;
    HandWorld same;
    HandWorld other;
    const auto ping = ping_of(scenario, one);
    CHECK(ping->number == 1);
    CHECK(ping->captured == one.now());
    CHECK(ping->echo_count == 120 * 500);
    CHECK(std::count(ping->echo.begin(), ping->echo.begin() + ping->echo_count, 0) < 3000);
    CHECK(ping_of(scenario, same)->echo == ping->echo);
    scenario.seed = 6;
    CHECK(ping_of(scenario, other)->echo != ping->echo);
  }
}

TEST_CASE("sim sonar: in the sea a ping is missing now and then, and its number with it",
          "[hal_sim][devices]") {
  HandWorld world;
  Scenario scenario;
  scenario.sonar.noise = SonarNoise::kSea;
  scenario.sonar.beams = 2;
  scenario.sonar.bins = 10;
  scenario.sonar.ping_hz = 50.0;
  SimSonar sonar{scenario, world.link()};
  const auto ping = std::make_unique<SonarPing>();
  std::uint64_t fresh = 0;
  constexpr std::uint64_t kDue = 3000;
  for (std::uint64_t i = 0; i < kDue; ++i) {
    world.step();
    fresh += sonar.poll(world.now(), *ping) == ReadStatus::kFresh ? 1U : 0U;
  }
  CHECK(ping->number > fresh);
  CHECK(ping->number <= kDue);
  CHECK(kDue - fresh == Approx(15).margin(14));
}

TEST_CASE("sim sonar: every ray meets an edge, and passes through none before",
          "[hal_sim][devices]") {
  std::mt19937_64 random{5};
  std::uniform_real_distribution<double> place{-8.0, 8.0};
  std::uniform_real_distribution<double> angle{-3.1, 3.1};
  int hits = 0;
  for (int round = 0; round < 2000; ++round) {
    Obstacle o = circle(place(random), place(random), 2.0).at_start;
    o.semi_axis_second_m = 0.4;
    o.angle_rad = angle(random);
    if (round % 2 == 0) {
      o = wall(round % 4 == 0 ? ObstacleShape::kPolygon : ObstacleShape::kPolyline,
               {{place(random), place(random)},
                {place(random), place(random)},
                {place(random), place(random)}})
              .at_start;
    }
    const double bearing_rad = angle(random);
    const WorldPoint from{{place(random), place(random)}};
    const Eigen::Vector2d direction{std::sin(bearing_rad), std::cos(bearing_rad)};
    const double range_m = ray_range_m(o, from, direction);
    const double limit_m = std::isfinite(range_m) ? range_m : 40.0;
    // Sphere tracing: no edge is nearer along the ray than the distances say.
    double walked_m = 0.0;
    for (int i = 0; i < 500 && walked_m < limit_m - 1e-6; ++i) {
      walked_m += std::max(std::abs(edge_distance_m(o, {from.xy_m + walked_m * direction})), 1e-7);
    }
    CHECK(walked_m >= limit_m - 1e-3);
    if (std::isfinite(range_m)) {
      ++hits;
      CHECK(edge_distance_m(o, {from.xy_m + range_m * direction}) == Approx(0.0).margin(1e-9));
    }
  }
  CHECK(hits > 300);
}

}  // namespace
}  // namespace lodesman
