// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include "hal_sim/sonar/heard_scene.h"
#include "tests/support/catch.h"
#include "tests/support/noisy_pings.h"

namespace lodesman {
namespace {

using testing::ellipse_at;
using testing::wall_through;

TEST_CASE("surface hit: a circle is met square on ahead, and grazed at its side",
          "[hal_sim][sonar]") {
  const Obstacle circle = ellipse_at(0.0, 10.0, 2.0, 2.0).at_start;
  for (const double bearing_rad : {0.0, 0.1, -0.15, 0.2}) {
    const SurfaceHit hit = surface_hit(circle, {}, {std::sin(bearing_rad), std::cos(bearing_rad)});
    // The law of sines between boat, hit and centre.
    const double sine = 10.0 * std::sin(bearing_rad) / 2.0;
    CHECK(hit.cos_incidence == Approx(std::sqrt(1.0 - sine * sine)).margin(1e-9));
    CHECK(hit.leaves_m - hit.range_m == Approx(4.0 * hit.cos_incidence));
  }
}

TEST_CASE("surface hit: a wall is met as it stands to the ray", "[hal_sim][sonar]") {
  const Obstacle wall = wall_through({{-5.0, 5.0}, {5.0, 15.0}}).at_start;
  const SurfaceHit hit = surface_hit(wall, {}, {0.0, 1.0});
  CHECK(hit.range_m == Approx(10.0));
  CHECK(hit.cos_incidence == Approx(std::sqrt(0.5)));
  CHECK(hit.along_m == Approx(5.0 * std::sqrt(2.0)));
  CHECK_FALSE(std::isfinite(surface_hit(wall, {}, {0.0, -1.0}).range_m));
}

TEST_CASE("surface hit: it lies where the ray's range says, and the nearest is heard",
          "[hal_sim][sonar]") {
  std::mt19937_64 random{3};
  std::uniform_real_distribution<double> place{-20.0, 20.0};
  std::uniform_real_distribution<double> angle{-3.1, 3.1};
  int met = 0;
  for (int round = 0; round < 500; ++round) {
    std::vector<MovingObstacle> all{
        ellipse_at(place(random), place(random), 3.0, 0.7, angle(random)),
        wall_through({{place(random), place(random)}, {place(random), place(random)}}),
        wall_through({{place(random), place(random)},
                      {place(random), place(random)},
                      {3.0, place(random)}})};
    all.back().at_start.shape = ObstacleShape::kPolygon;
    HeardScene scene{all};
    VehiclePose pose;
    pose.p_WV = {{place(random), place(random)}};
    pose.heading = Heading::clockwise_from_y_rad(angle(random));
    scene.observe(pose, 0.0);
    const double bearing_rad = angle(random);
    const HeardSurface surface = scene.surface(bearing_rad);
    const double range_m = scene.range_m(bearing_rad);
    CHECK((surface.obstacle != nullptr) == std::isfinite(range_m));
    if (surface.obstacle != nullptr) {
      ++met;
      CHECK(surface.hit.range_m == Approx(range_m).epsilon(1e-12));
      CHECK(surface.hit.cos_incidence >= 0.0);
      CHECK(surface.hit.cos_incidence <= 1.0 + 1e-9);
      CHECK(surface.hit.leaves_m >= surface.hit.range_m);
    }
  }
  CHECK(met > 50);
}

}  // namespace
}  // namespace lodesman
