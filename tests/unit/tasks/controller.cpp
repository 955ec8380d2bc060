// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/controller.h"

#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

[[nodiscard]] ControllerOptions paper_options() {
  ControllerOptions options;
  options.steering.heading_gain_per_deg = 3.5;
  options.waypoint_radius_m = 0.5;
  return options;
}

struct Controller {
  void mission_is(MissionState what, Time at, Time started = kStart) {
    MissionStatus status;
    status.state = what;
    status.started = started;
    status.surge_ref = 16;
    status.speed_m_s = 0.22;
    mission.publish(status, at);
  }
  void plan_to(double y_m, Time at) {
    auto ahead = std::make_unique<Plan>();
    ahead->id = ahead->path_id = 1;
    ahead->waypoint_count = 1;
    ahead->waypoints[0] = {0.0, y_m};
    plan.publish(*ahead, at);
  }
  void estimate(Time at) {
    VehicleState here;
    here.valid_at = at;
    state.publish(here, at);
  }
  void all_is_well(Time at) {
    mission_is(MissionState::kUnderWay, at);
    plan_to(10.0, at);
    estimate(at);
    attitude.publish({at, 0.0, 0.0}, at);
  }
  [[nodiscard]] HelmCommand after_step(Time now) {
    task.step(now);
    const auto* newest = helm.latest();
    REQUIRE(newest != nullptr);
    CHECK(newest->stamp == now);
    return newest->value;
  }
  void check_neutral(Time now, HelmReason reason) {
    const HelmCommand command = after_step(now);
    CHECK(command.reason == reason);
    CHECK(command.surge_ref == 0);
    CHECK(command.head_ref == 0);
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  ControllerTask task{*board, Role::kHigh, paper_options()};
  Writer<MissionStatus> mission{board->mission_status, Role::kHigh, "mission_status"};
  Writer<VehicleState> state{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Writer<Attitude> attitude{board->attitude, Role::kLow, "attitude"};
  Writer<Plan> plan{board->plan, Role::kHigh, "plan"};
  Reader<HelmCommand> helm{board->helm_command};
};

TEST_CASE("controller: a plan from before its program is not steered by", "[high_level][tasks]") {
  Controller controller;
  controller.all_is_well(kStart);
  const Time later = kStart + milliseconds{50};
  controller.mission_is(MissionState::kUnderWay, later);
  controller.estimate(later);
  controller.attitude.publish({later, 0.0, 0.0}, later);
  controller.check_neutral(later, HelmReason::kNoWaypoints);
  controller.plan_to(10.0, later);
  CHECK(controller.after_step(later).reason == HelmReason::kTracking);
}

TEST_CASE("controller task: under way it steers for the waypoint ahead", "[high_level][tasks]") {
  Controller controller;
  controller.all_is_well(kStart);
  const HelmCommand command = controller.after_step(kStart);
  CHECK(command.reason == HelmReason::kTracking);
  CHECK(command.surge_ref == 16);
  CHECK(command.head_ref == 0);
  CHECK(command.plan_id == 1);
}

TEST_CASE("controller task: it says at every step what it lacks and is neutral",
          "[high_level][tasks]") {
  Controller controller;
  controller.check_neutral(kStart, HelmReason::kStaleMission);
  controller.mission_is(MissionState::kUnderWay, kStart);
  controller.check_neutral(kStart, HelmReason::kStaleAttitude);
  controller.attitude.publish({kStart, 0.0, 0.0}, kStart);
  controller.check_neutral(kStart, HelmReason::kStaleState);
  controller.estimate(kStart);
  controller.check_neutral(kStart, HelmReason::kNoWaypoints);
  controller.plan_to(10.0, kStart);
  CHECK(controller.after_step(kStart).reason == HelmReason::kTracking);
}

TEST_CASE("controller task: what has grown stale counts as missing", "[high_level][tasks]") {
  const auto check = [](Duration age, auto renew, HelmReason reason) {
    Controller controller;
    controller.all_is_well(kStart);
    const Time now = kStart + age + Duration{1};
    renew(controller, now);
    controller.check_neutral(now, reason);
  };
  const auto mission = [](Controller& c, Time now) { c.mission_is(MissionState::kUnderWay, now); };
  const auto attitude = [](Controller& c, Time now) { c.attitude.publish({now, 0.0, 0.0}, now); };
  const auto state = [](Controller& c, Time now) { c.estimate(now); };
  check(
      max_age::kMissionStatus, [&](Controller& c, Time now) { attitude(c, now), state(c, now); },
      HelmReason::kStaleMission);
  check(
      max_age::kAttitude, [&](Controller& c, Time now) { mission(c, now), state(c, now); },
      HelmReason::kStaleAttitude);
  check(
      max_age::kVehicleState, [&](Controller& c, Time now) { mission(c, now), attitude(c, now); },
      HelmReason::kStaleState);
}

TEST_CASE("controller task: what is stamped in the future counts as missing",
          "[high_level][tasks]") {
  Controller controller;
  controller.all_is_well(kStart + seconds{3600});
  CHECK(controller.after_step(kStart).surge_ref == 0);
}

TEST_CASE("controller task: a mission that is not under way moves nothing", "[high_level][tasks]") {
  for (const auto state : {MissionState::kIdle, MissionState::kReached, MissionState::kAborted,
                           MissionState::kHolding}) {
    Controller controller;
    controller.all_is_well(kStart);
    controller.mission_is(state, kStart);
    controller.check_neutral(kStart, HelmReason::kNotUnderWay);
  }
}

TEST_CASE("controller task: a plan from before this start is not followed", "[high_level][tasks]") {
  Controller controller;
  controller.all_is_well(kStart);
  controller.mission_is(MissionState::kUnderWay, kStart, kStart + milliseconds{1});
  controller.check_neutral(kStart + milliseconds{1}, HelmReason::kNoWaypoints);
}

TEST_CASE("controller task: made safe it commands neutral", "[high_level][tasks]") {
  Controller controller;
  controller.all_is_well(kStart);
  CHECK(controller.after_step(kStart).surge_ref == 16);
  controller.task.enter_safe_state(kStart + milliseconds{1});
  CHECK(controller.helm.latest()->value.surge_ref == 0);
}

}  // namespace
}  // namespace lodesman::testing
