// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/vehicle_model.h"

#include <array>
#include <cmath>

#include "tests/support/catch.h"
#include "tests/unit/estimate/support.h"

namespace lodesman::testing {
namespace {

// A hull from rest under constant references, for so long.
[[nodiscard]] VehicleMotion driven(int surge_ref, int head_ref, double for_s, double step_s = 0.02,
                                   const Eigen::Vector2d& current_m_s = Eigen::Vector2d::Zero()) {
  const VehicleModel model{paper_hull(), paper_speeds()};
  VehicleMotion motion;
  for (int i = 0; i < static_cast<int>(std::lround(for_s / step_s)); ++i) {
    motion = model.advanced(motion, model.forces(surge_ref, head_ref), current_m_s, step_s);
  }
  return motion;
}

TEST_CASE("vehicle model: each SurgeRef settles at the speed that the boat's table says",
          "[high_level][estimate]") {
  for (const int surge_ref : {-57, 8, 16, 31, 57, 91}) {
    CHECK(driven(surge_ref, 0, 60.0).velocity[0] ==
          Approx(paper_speeds().speed_m_s(surge_ref)).epsilon(0.001));
  }
}

TEST_CASE("vehicle model: it comes within 1/e of a new speed in mass over drag",
          "[high_level][estimate]") {
  const double steady_m_s = paper_speeds().speed_m_s(8);
  CHECK(driven(8, 0, 2.3).velocity[0] == Approx(steady_m_s * (1.0 - std::exp(-1.0))).epsilon(0.03));
}

TEST_CASE("vehicle model: positive HeadRef turns clockwise, and a turning hull slips outwards",
          "[high_level][estimate]") {
  const VehicleMotion turned = driven(57, 20, 10.0);
  CHECK(turned.heading_rad > 0.3);
  CHECK(turned.velocity[2] > 0.05);
  CHECK(turned.velocity[1] < -0.005);  // to port of a turn to starboard
  CHECK(driven(57, -20, 10.0).heading_rad == Approx(-turned.heading_rad));
}

TEST_CASE("vehicle model: added mass makes it slower to answer and no slower in the end",
          "[high_level][estimate]") {
  VehicleModelParameters heavy = paper_hull();
  heavy.added_mass_surge_kg = heavy.mass_kg;
  const VehicleModel light_model{paper_hull(), paper_speeds()};
  const VehicleModel heavy_model{heavy, paper_speeds()};
  const ThrustForces forces = light_model.forces(31, 0);
  const BodyVelocity rest = BodyVelocity::Zero();
  CHECK(heavy_model.acceleration(rest, forces)[0] ==
        Approx(0.5 * light_model.acceleration(rest, forces)[0]));
  const BodyVelocity steady{paper_speeds().speed_m_s(31), 0.0, 0.0};
  CHECK(heavy_model.acceleration(steady, forces)[0] == Approx(0.0).margin(1e-9));
}

TEST_CASE("vehicle model: a current carries it along whatever its heading",
          "[high_level][estimate]") {
  const VehicleMotion still = driven(16, 10, 20.0);
  const VehicleMotion carried = driven(16, 10, 20.0, 0.02, {0.3, -0.1});
  CHECK(carried.position.xy_m.x() == Approx(still.position.xy_m.x() + 6.0));
  CHECK(carried.position.xy_m.y() == Approx(still.position.xy_m.y() - 2.0));
  CHECK(carried.heading_rad == Approx(still.heading_rad));
}

TEST_CASE("vehicle model: half the step moves it by less than a centimetre in a minute",
          "[high_level][estimate]") {
  const VehicleMotion coarse = driven(91, 30, 60.0, 0.05);
  const VehicleMotion fine = driven(91, 30, 60.0, 0.025);
  CHECK((coarse.position.xy_m - fine.position.xy_m).norm() < 0.01);
}

TEST_CASE("vehicle model: long steps end where short ones do", "[high_level][estimate]") {
  const VehicleModel model{paper_hull(), paper_speeds()};
  for (const int surge_ref : {-31, 16, 57, 91}) {
    for (const int head_ref : {-100, 20, 60}) {
      const ThrustForces forces = model.forces(surge_ref, head_ref);
      VehicleMotion long_way;
      VehicleMotion short_way;
      for (int i = 0; i < 80; ++i) {
        long_way = model.carried_on(long_way, forces, {0.2, 0.1}, 0.25);
      }
      for (int i = 0; i < 2000; ++i) {
        short_way = model.advanced(short_way, forces, {0.2, 0.1}, 0.01);
      }
      INFO(surge_ref << " " << head_ref);
      // Of ways of 7 to 22 m and turns of up to two rounds.
      CHECK((long_way.position.xy_m - short_way.position.xy_m).norm() < 0.1);
      CHECK(std::abs(long_way.heading_rad - short_way.heading_rad) < 0.02);
      CHECK((long_way.velocity - short_way.velocity).norm() < 0.002);
    }
  }
}

TEST_CASE("vehicle model: long steps are stable however strong the drag",
          "[high_level][estimate]") {
  VehicleModelParameters hull = paper_hull();
  hull.sway_drag_n_s_per_m = 1e5;
  hull.yaw_drag_n_m_s = 1e4;
  hull.surge_drag_n_s_per_m = 1e4;
  const VehicleModel model{hull, paper_speeds()};
  VehicleMotion motion;
  motion.velocity = {1.0, 0.5, 0.5};
  for (int i = 0; i < 100; ++i) {
    motion = model.carried_on(motion, model.forces(31, 30), Eigen::Vector2d::Zero(), 1.0);
    REQUIRE(motion.velocity.norm() < 2.0);
  }
  CHECK(motion.velocity[0] == Approx(paper_speeds().speed_m_s(31)).epsilon(0.01));
  CHECK(std::abs(motion.velocity[1]) < 0.001);
}

TEST_CASE("vehicle model: it stops in the way that it says, and turns in no longer one",
          "[high_level][estimate]") {
  const VehicleModel model{paper_hull(), paper_speeds()};
  const Eigen::Vector2d still = Eigen::Vector2d::Zero();
  for (const int surge_ref : {8, 31, 57, 91}) {
    const double speed_m_s = paper_speeds().speed_m_s(surge_ref);
    VehicleMotion stopping;
    stopping.velocity[0] = speed_m_s;
    for (int i = 0; i < 3000; ++i) {
      stopping = model.advanced(stopping, model.forces(0, 0), still, 0.01);
    }
    CHECK(stopping.position.xy_m.y() == Approx(model.stopping_way_m(speed_m_s)).epsilon(0.01));
    VehicleMotion turning;
    turning.velocity[0] = speed_m_s;
    while (turning.heading_rad < to_rad(90.0)) {
      turning = model.advanced(turning, model.forces(surge_ref, 100), still, 0.01);
    }
    CHECK(turning.position.xy_m.y() < 1.01 * model.turning_way_m(speed_m_s));
    CHECK(turning.position.xy_m.y() > 0.8 * model.turning_way_m(speed_m_s));
  }
}

TEST_CASE("vehicle model: the slope is that of the acceleration", "[high_level][estimate]") {
  const VehicleModel model{paper_hull(), paper_speeds()};
  const ThrustForces forces = model.forces(40, -15);
  for (const BodyVelocity& at : std::array<BodyVelocity, 3>{
           BodyVelocity{0.4, 0.05, 0.1}, BodyVelocity{-0.3, -0.1, -0.2}, {1.1, 0.02, 0.3}}) {
    const Eigen::Matrix3d slope = model.acceleration_slope(at);
    for (int i = 0; i < 3; ++i) {
      BodyVelocity more = at;
      BodyVelocity less = at;
      more[i] += 1e-5;
      less[i] -= 1e-5;
      const Eigen::Vector3d difference =
          (model.acceleration(more, forces) - model.acceleration(less, forces)) / 2e-5;
      CHECK((difference - slope.col(i)).norm() == Approx(0.0).margin(1e-5));
    }
  }
}

}  // namespace
}  // namespace lodesman::testing
