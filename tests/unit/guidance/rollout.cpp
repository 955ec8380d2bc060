// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/rollout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "high_level/tasks/controller.h"
#include "mid_level/base/random_stream.h"
#include "tests/support/catch.h"
#include "tests/unit/guidance/support.h"

namespace lodesman::testing {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kTick_s = 0.05;  // of the controller
constexpr double kSailed_s = 20.0;

// A voyage by chance: a route that bends, a manoeuvre, a current, a boat under way.
struct Chance {
  explicit Chance(std::uint64_t seed) : luck{"rollout", seed} {
    constexpr std::array<Cruise, 5> kCruises{
        {{8, 0.109}, {16, 0.222}, {31, 0.416}, {57, 0.735}, {91, 1.116}}};
    response = response_at(kCruises[static_cast<std::size_t>(4.99 * luck.uniform())]);
    response.model = VehicleModel{shipped_options().estimator.filter.vehicle, paper_boat_speeds()};
    const double speed_m_s = response.cruise.speed_m_s;
    double way_rad = between(-3.0, 3.0);
    Vec at{0.0, 0.0};
    (void)route.add(at);
    for (int i = 0; i < 4; ++i) {
      at += between(2.0, 8.0) * Vec{std::sin(way_rad), std::cos(way_rad)};
      (void)route.add(at);
      way_rad += between(-1.0, 1.0);
    }
    own.heading_rad = between(-3.0, 3.0);
    own.surge_m_s = between(-0.3, 1.0) * speed_m_s;
    own.sway_m_s = between(-0.1, 0.1) * speed_m_s;
    own.yaw_rate_rad_s = between(-0.2, 0.2);
    own.current_m_s = {between(-0.4, 0.4) * speed_m_s, between(-0.4, 0.4) * speed_m_s};
    if (luck.uniform() < 0.7) {
      manoeuvre = {between(-2.0, 2.0), between(0.0, 10.0), between(-0.4, 1.0)};
    }
    stay_at_end = luck.uniform() < 0.5;
  }

  [[nodiscard]] double between(double least, double most) {
    return least + (most - least) * luck.uniform();
  }
  [[nodiscard]] static SpeedTable paper_boat_speeds() {
    constexpr std::array<SpeedPoint, 5> kPoints{
        {{8, 0.109}, {16, 0.222}, {31, 0.416}, {57, 0.735}, {91, 1.116}}};
    return SpeedTable{kPoints};
  }

  RandomStream luck;
  VehicleResponse response;
  Route route;
  OwnMotion own;
  Manoeuvre manoeuvre{0.0, 0.0, 1.0};
  bool stay_at_end = false;
};

// The controller task itself, on a boat that answers as the model says.
class Sailed {
 public:
  explicit Sailed(const Chance& chance)
      : chance_{chance},
        motion{{chance.own.p_W},
               chance.own.heading_rad,
               {chance.own.surge_m_s, chance.own.sway_m_s, chance.own.yaw_rate_rad_s}} {
    const Vec aim = point_ahead(chance.route, {}, chance.response.look_ahead_m);
    course_rad_ = std::atan2(aim.x(), aim.y()) + chance.manoeuvre.offset_rad;
  }

  void sail_to(double after_s) {
    for (; t_s_ < after_s - 1e-9; t_s_ += kTick_s) {
      publish();
      task_.step(now());
      const HelmCommand& helm = helm_.latest()->value;
      REQUIRE(helm.reason == HelmReason::kTracking);
      const ThrustForces forces = chance_.response.model.forces(helm.surge_ref, helm.head_ref);
      for (int i = 0; i < 5; ++i) {
        motion =
            chance_.response.model.advanced(motion, forces, chance_.own.current_m_s, kTick_s / 5);
      }
    }
  }

 private:
  [[nodiscard]] Time now() const { return at_s(100.0 + t_s_); }
  void publish() {
    const bool aside = t_s_ < chance_.manoeuvre.for_s - 1e-9;
    MissionStatus status;
    status.state = MissionState::kUnderWay;
    status.surge_ref = chance_.response.cruise.surge_ref;
    status.speed_m_s = chance_.response.cruise.speed_m_s;
    mission_.publish(status, now());
    const double heading_rad = wrap_to_pi(motion.heading_rad);
    attitude_.publish({now(), heading_rad, motion.velocity[2]}, now());
    VehicleState state;
    state.valid_at = now();
    state.x_m = motion.position.xy_m.x();
    state.y_m = motion.position.xy_m.y();
    state.heading_rad = heading_rad;
    state.current_x_m_s = chance_.own.current_m_s.x();
    state.current_y_m_s = chance_.own.current_m_s.y();
    state_.publish(state, now());
    *made_ = {};
    made_->steer_by = aside ? SteerBy::kCourse : SteerBy::kLine;
    made_->course_rad = wrap_to_pi(aside ? course_rad_ : heading_rad);
    made_->speed_share = aside ? chance_.manoeuvre.speed_share : 1.0;
    made_->stay_at_end = chance_.stay_at_end;
    for (std::uint32_t i = 0; i < chance_.route.count; ++i) {
      made_->waypoints[made_->waypoint_count++] = {chance_.route.points[i].x(),
                                                   chance_.route.points[i].y()};
    }
    plan_.publish(*made_, now());
  }

  const Chance& chance_;
  double t_s_ = 0.0;
  double course_rad_ = 0.0;
  std::unique_ptr<Plan> made_ = std::make_unique<Plan>();
  std::unique_ptr<Blackboard> board_ = std::make_unique<Blackboard>();
  ControllerTask task_{*board_, Role::kHigh, shipped_options().controller};
  Writer<MissionStatus> mission_{board_->mission_status, Role::kHigh, "mission_status"};
  Writer<VehicleState> state_{board_->vehicle_state, Role::kHigh, "vehicle_state"};
  Writer<Attitude> attitude_{board_->attitude, Role::kLow, "attitude"};
  Writer<Plan> plan_{board_->plan, Role::kHigh, "plan"};
  Reader<HelmCommand> helm_{board_->helm_command};

 public:
  VehicleMotion motion;
};

// The largest distance [m] between what is foreseen, in parts of that length, and what is sailed.
[[nodiscard]] double largest_error_m(const Chance& chance, double part_s) {
  Rollout foreseen{chance.response,  chance.route, chance.own,
                   chance.manoeuvre, 1.0,          chance.stay_at_end};
  Sailed sailed{chance};
  double largest_m = 0.0;
  while (foreseen.after_s() < kSailed_s) {
    foreseen.sail(part_s);
    if (foreseen.has_arrived()) {
      break;
    }
    sailed.sail_to(foreseen.after_s());
    largest_m = std::max(largest_m, (foreseen.p_W() - sailed.motion.position.xy_m).norm());
  }
  return largest_m;
}

TEST_CASE("rollout: what is foreseen is what controller and vehicle model sail",
          "[high_level][guidance]") {
  std::vector<double> errors_m;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Chance chance{seed};
    errors_m.push_back(largest_error_m(chance, 0.2));
    INFO("seed " << seed);
    CHECK(errors_m.back() < 1.0);
  }
  // A little earlier or later it may turn the other way round, or go back to its place stern first:
  // then it is another way for a while.
  std::sort(errors_m.begin(), errors_m.end());
  CHECK(errors_m[100] < 0.05);
  CHECK(errors_m[190] < 0.25);
}

TEST_CASE("rollout: a route's end that is no place to stay is arrived at, another is kept",
          "[high_level][guidance]") {
  const Route route = route_of({{0, 0}, {0, 10}});
  const VehicleResponse response = default_response();
  const OwnMotion own{{0.0, 0.0}, 0.0, 1.0};
  Rollout passes{response, route, own, {0.0, 0.0, 1.0}, 1.0, false};
  Rollout stays{response, route, own, {0.0, 0.0, 1.0}, 1.0, true};
  double farthest_m = 0.0;
  for (int i = 0; i < 240; ++i) {
    passes.sail(0.25);
    stays.sail(0.25);
    farthest_m = std::max(farthest_m, stays.p_W().y());
  }
  CHECK(passes.has_arrived());
  CHECK(passes.after_s() < 12.0);
  CHECK_FALSE(stays.has_arrived());
  // It brakes before the end as the controller does, and does not run past it.
  CHECK(farthest_m < 10.5);
  CHECK((stays.p_W() - route.end()).norm() < 0.5);
  CHECK(stays.motion().velocity.norm() < 0.05);
}

}  // namespace
}  // namespace lodesman::testing
