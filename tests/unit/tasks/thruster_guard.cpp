// SPDX-License-Identifier: Apache-2.0
// The guard inside the thruster task: what outranks it, what it outranks, and that it needs nobody.
#include <algorithm>
#include <array>

#include "low_level/tasks/thruster.h"
#include "low_level/thrust/thrust_map.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

constexpr Duration kPeriod = milliseconds{50};

[[nodiscard]] ThrusterOptions guarded_options() {
  static constexpr std::array<SpeedPoint, 2> kSpeeds{{{57, 0.735}, {100, 1.207}}};
  ThrusterOptions options;
  GuardOptions& guard = options.guard;
  guard.is_on = true;
  guard.margin_m = 0.2;
  guard.release_m = 0.3;
  guard.reaction = milliseconds{100};
  guard.silence_neutral = milliseconds{300};
  guard.brake_max = seconds{10};
  guard.frame_age_max = max_age::kSonarFrame;
  guard.hull_half_length_m = 1.02;
  guard.hull_half_beam_m = 0.6;
  guard.hull.mass_kg = 95.0;
  guard.hull.surge_drag_n_s_per_m = 41.3;
  guard.hull.surge_drag_n_s2_per_m2 = 6.5;
  guard.hull.yaw_inertia_kg_m2 = 44.0;
  guard.hull.yaw_drag_n_m_s = 60.0;
  guard.hull.turning_n_m_per_head_ref = 0.27;
  guard.hull.speeds = SpeedTable{kSpeeds};
  return options;
}

// Armed, and stepped by its period alone.
struct GuardedThrusters {
  GuardedThrusters() {
    say(0);
    step();
    orders.publish({ThrustOrderKind::kArm, 0}, now);
    step();
    REQUIRE(status.latest()->value.state == ThrustState::kArmed);
  }
  void say(int surge_ref) {
    HelmCommand command;
    command.reason = HelmReason::kTracking;
    command.surge_ref = surge_ref;
    helm.publish(command, now);
  }
  void hold_stick(int surge_ref, bool overrides) { stick.publish({surge_ref, 0, overrides}, now); }
  void abort() {
    MissionStatus aborted;
    aborted.state = MissionState::kAborted;
    aborted.ended = now;
    mission.publish(aborted, now);
  }
  // A stone dead ahead, so far from the bow, in as many pings as make it sure.
  void show_stone(double off_m) {
    const auto seen = std::make_unique<SonarObstacles>();
    seen->captured = now;
    seen->range_m = 30.0;
    seen->count = 1;
    seen->obstacles[0].centre_y_m = 1.02 + off_m + 0.5;
    seen->obstacles[0].semi_axis_first_m = seen->obstacles[0].semi_axis_second_m = 0.5;
    seen->obstacles[0].protection_first_m = seen->obstacles[0].protection_second_m = 0.5;
    for (int i = 0; i < 2; ++i) {
      ++seen->frame;
      sonar.publish(*seen, now);
    }
  }
  ThrustApplied step() {
    now += kPeriod;
    task.step(now);
    return applied.latest()->value;
  }
  void sail(int surge_ref, Duration for_so_long) {
    for (const Time end = now + for_so_long; now < end;) {
      say(surge_ref);
      step();
    }
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  ScriptedThrusters box;
  ThrusterTask task{*board, Role::kLow, &box, guarded_options()};
  Writer<HelmCommand> helm{board->helm_command, Role::kHigh, "helm_command"};
  Writer<ThrustOrder> orders{board->thrust_order, Role::kHigh, "thrust_order"};
  Writer<ManualInput> stick{board->manual_input, Role::kHigh, "manual_input"};
  Writer<MissionStatus> mission{board->mission_status, Role::kHigh, "mission_status"};
  Writer<SonarObstacles> sonar{board->sonar_obstacles, Role::kLow, "sonar_obstacles"};
  Reader<ThrustApplied> applied{board->thrust_applied};
  Reader<ThrustStatus> status{board->thrust_status};
  Reader<GuardStatus> guard{board->guard_status};
  Time now = kStart;
};

TEST_CASE("thruster task: the guard stops what the helm would run into, and says so",
          "[low_level][tasks]") {
  GuardedThrusters thrusters;
  thrusters.sail(57, seconds{10});
  thrusters.show_stone(0.4);
  thrusters.say(57);
  const ThrustApplied braked = thrusters.step();
  CHECK(braked.reason == ThrustReason::kGuarded);
  CHECK(braked.surge_ref == -100);
  CHECK(braked.plan_id == 0);
  CHECK(thrusters.box.last == map_thrust(-100, 0));
  const GuardStatus status = thrusters.guard.latest()->value;
  CHECK(status.state == GuardState::kBraking);
  CHECK(status.reason == GuardReason::kObstacle);
  CHECK(status.trips == 1);
  CHECK(status.distance_m == Approx(0.36).margin(0.06));
  CHECK(status.trip_speed_m_s == Approx(0.735).margin(0.03));
  thrusters.sail(57, seconds{2});
  CHECK(thrusters.applied.latest()->value.reason == ThrustReason::kGuarded);
  CHECK(thrusters.box.last == kNeutralThrust);
  CHECK(thrusters.guard.latest()->value.state == GuardState::kHolding);
}

TEST_CASE("thruster task: a silent helm is neutral in time, then the way is taken off",
          "[low_level][tasks]") {
  GuardedThrusters thrusters;
  thrusters.sail(57, seconds{10});
  const Time last_word = thrusters.now - kPeriod;
  Time neutral{};
  Time astern{};
  while (thrusters.now - last_word < seconds{4}) {
    const ThrustApplied applied = thrusters.step();
    const Time now = thrusters.now;
    neutral = neutral == Time{} && applied.surge_ref == 0 ? now : neutral;
    astern = astern == Time{} && applied.surge_ref < 0 ? now : astern;
  }
  CHECK(neutral - last_word <= milliseconds{400});
  REQUIRE(astern != Time{});
  CHECK(astern - neutral >= milliseconds{300});
  CHECK(thrusters.guard.latest()->value.reason == GuardReason::kSilence);
  CHECK(thrusters.guard.latest()->value.trips == 1);
  CHECK(thrusters.box.last == kNeutralThrust);  // stopped
}

TEST_CASE("thruster task: after an abort or a stop the guard turns nothing", "[low_level][tasks]") {
  for (const bool by_stop : {false, true}) {
    GuardedThrusters thrusters;
    thrusters.sail(57, seconds{10});
    if (by_stop) {
      thrusters.orders.publish({ThrustOrderKind::kStop, 1}, thrusters.now);
    } else {
      thrusters.abort();
      thrusters.say(0);
    }
    thrusters.show_stone(0.4);
    for (int i = 0; i < 60; ++i) {
      CHECK(thrusters.step().surge_ref == 0);
      CHECK(thrusters.box.last == kNeutralThrust);
    }
    CHECK(thrusters.guard.latest()->value.state == GuardState::kIdle);
    CHECK(thrusters.guard.latest()->value.trips == 0);
  }
}

TEST_CASE("thruster task: of a helm that does not know how to steer the way is taken off",
          "[low_level][tasks]") {
  const auto brakes = [](HelmReason reason) {
    GuardedThrusters thrusters;
    thrusters.sail(57, seconds{10});
    int least = 0;
    for (int i = 0; i < 80; ++i) {
      HelmCommand helm;
      helm.reason = reason;
      thrusters.helm.publish(helm, thrusters.now);
      const int surge_ref = thrusters.step().surge_ref;
      CHECK((i < 6 ? surge_ref == 0 : surge_ref <= 0));
      least = std::min(least, surge_ref);
    }
    CHECK(thrusters.applied.latest()->value.surge_ref == 0);  // and no more
    return least == -100;
  };
  CHECK(brakes(HelmReason::kStaleAttitude));
  CHECK(brakes(HelmReason::kStaleState));
  CHECK(brakes(HelmReason::kNoWaypoints));
  CHECK(brakes(HelmReason::kStaleMission));
  CHECK(brakes(HelmReason::kNotSane));
  CHECK_FALSE(brakes(HelmReason::kNotUnderWay));
  CHECK_FALSE(brakes(HelmReason::kTracking));
}

TEST_CASE("thruster task: the guard is above the stick, but for a word", "[low_level][tasks]") {
  for (const bool overrides : {false, true}) {
    GuardedThrusters thrusters;
    for (int i = 0; i < 100; ++i) {
      thrusters.say(0);
      thrusters.hold_stick(57, overrides);
      thrusters.step();
    }
    REQUIRE(thrusters.applied.latest()->value.reason == ThrustReason::kManual);
    thrusters.show_stone(0.4);
    thrusters.hold_stick(57, overrides);
    const ThrustApplied applied = thrusters.step();
    CHECK(applied.surge_ref == (overrides ? 57 : -100));
    CHECK(thrusters.guard.latest()->value.state ==
          (overrides ? GuardState::kOverridden : GuardState::kBraking));
  }
}

TEST_CASE("thruster task: a stick let go is neutral and brakes nothing while the helm speaks",
          "[low_level][tasks]") {
  GuardedThrusters thrusters;
  for (int i = 0; i < 100; ++i) {
    thrusters.say(0);
    thrusters.hold_stick(57, false);
    thrusters.step();
  }
  for (int i = 0; i < 60; ++i) {
    thrusters.say(0);
    CHECK(thrusters.step().surge_ref >= 0);
  }
  CHECK(thrusters.guard.latest()->value.trips == 0);
}

}  // namespace
}  // namespace lodesman::testing
