// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/world.h"

#include <cmath>

#include "tests/support/catch.h"
#include "tests/support/shipped_vessel.h"

namespace lodesman {
namespace {

using testing::kGoodScenario;
using testing::replaced;
using testing::scenario_of;
using testing::shipped_vessel;

[[nodiscard]] Scenario scenario_with(const std::string& obstacles) {
  return scenario_of(kGoodScenario.substr(0, kGoodScenario.find("[[obstacle]]")) + obstacles);
}

const std::string kCircle =
    "[[obstacle]]\nshape = \"circle\"\ncentre_m = [0.0, 10.0]\nradius_m = 0.5\n"
    "protection_m = 1.0\n";

TEST_CASE("world: without obstacles both distances are infinite", "[hal_sim][world]") {
  const World world{scenario_with(""), shipped_vessel()};
  CHECK(std::isinf(world.truth().inoffensive_distance_m));
  CHECK(std::isinf(world.truth().hull_clearance_m));
}

TEST_CASE("world: the inoffensive distance takes off both radii", "[hal_sim][world]") {
  const World world{scenario_with(kCircle), shipped_vessel()};
  CHECK(world.truth().inoffensive_distance_m == Approx(9.0));
  CHECK(world.truth().hull_clearance_m == Approx(9.5 - 1.02));
}

TEST_CASE("world: the nearest of the obstacles that exist counts", "[hal_sim][world]") {
  World world{
      scenario_with(kCircle + "[[obstacle]]\nshape = \"circle\"\ncentre_m = [3.0, 0.0]\n"
                              "radius_m = 0.5\nprotection_m = 1.0\nstart_s = 5.0\nend_s = 9.0\n"),
      shipped_vessel()};
  world.step(0.02, 4.9, kNeutralThrust);
  CHECK(world.truth().inoffensive_distance_m == Approx(9.0));
  world.step(0.02, 5.0, kNeutralThrust);
  CHECK(world.truth().inoffensive_distance_m == Approx(2.0));
  CHECK(world.truth().hull_clearance_m == Approx(1.9));
  world.step(0.02, 9.0, kNeutralThrust);
  CHECK(world.truth().inoffensive_distance_m == Approx(9.0));
}

TEST_CASE("world: a mover comes, stops, and its truth says so", "[hal_sim][world]") {
  World world{scenario_with(kCircle + "velocity_m_s = [0.0, -1.0]\nstop_at_m = [0.0, 2.0]\n"),
              shipped_vessel()};
  world.step(0.02, 4.0, kNeutralThrust);
  CHECK(world.truth().scenario_time_s == Approx(4.0));
  CHECK(world.truth().inoffensive_distance_m == Approx(5.0));
  world.step(0.02, 100.0, kNeutralThrust);
  CHECK(world.truth().inoffensive_distance_m == Approx(1.0));
}

TEST_CASE("world: the truth is over ground, in the vehicle's axes", "[hal_sim][world]") {
  Scenario scenario = scenario_with("[environment]\ncurrent_m_s = [0.3, 0.0]\n");
  scenario.mission.start.heading = Heading::clockwise_from_y_rad(to_rad(90.0));
  World world{scenario, shipped_vessel()};
  CHECK(world.truth().surge_m_s == Approx(0.3));
  CHECK(world.truth().sway_m_s == Approx(0.0).margin(1e-12));
  for (int i = 0; i < 100; ++i) {
    world.step(0.02, 0.02 * i, {164, 164});
  }
  CHECK(world.truth().surge_m_s > 0.4);
  CHECK(world.truth().x_m > 0.6);
  CHECK(world.truth().y_m == Approx(0.0).margin(1e-9));
  CHECK(world.truth().heading_rad == Approx(to_rad(90.0)));
}

}  // namespace
}  // namespace lodesman
