// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/thruster.h"

#include "low_level/thrust/thrust_map.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

struct Thrusters {
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  ScriptedThrusters box;
  ThrusterTask task{*board, Role::kLow, &box};
  Writer<HelmCommand> helm{board->helm_command, Role::kHigh, "helm_command"};
  Reader<ThrustApplied> applied{board->thrust_applied};

  void order(int surge_ref, Time stamp) {
    HelmCommand command;
    command.reason = HelmReason::kTracking;
    command.surge_ref = surge_ref;
    helm.publish(command, stamp);
  }
  [[nodiscard]] ThrustApplied after_step(Time now) {
    task.step(now);
    const auto* newest = applied.latest();
    REQUIRE(newest != nullptr);
    CHECK(newest->stamp == now);
    return newest->value;
  }
};

TEST_CASE("thruster task: it does what the helm says and says what it did", "[low_level][tasks]") {
  Thrusters thrusters;
  thrusters.order(40, kStart);
  const ThrustApplied applied = thrusters.after_step(kStart + milliseconds{50});
  CHECK(applied.reason == ThrustReason::kCommanded);
  CHECK(applied.surge_ref == 40);
  CHECK(applied.command_sequence == 1);
  CHECK(thrusters.box.last == map_thrust(40, 0));
}

TEST_CASE("thruster task: before the helm has spoken thrust is neutral", "[low_level][tasks]") {
  Thrusters thrusters;
  CHECK(thrusters.after_step(kStart).reason == ThrustReason::kNoCommand);
  CHECK(thrusters.box.last == kNeutralThrust);
}

TEST_CASE("thruster task: when the helm falls silent thrust is neutral", "[low_level][tasks]") {
  Thrusters thrusters;
  thrusters.order(100, kStart);
  CHECK(thrusters.after_step(kStart + max_age::kHelmCommand).reason == ThrustReason::kCommanded);
  const auto late = kStart + max_age::kHelmCommand + Duration{1};
  const ThrustApplied applied = thrusters.after_step(late);
  CHECK(applied.reason == ThrustReason::kStaleCommand);
  CHECK(applied.surge_ref == 0);
  CHECK(thrusters.box.last == kNeutralThrust);
}

TEST_CASE("thruster task: a command stamped in the future is not obeyed", "[low_level][tasks]") {
  for (const Duration ahead : {Duration{milliseconds{400}}, Duration{seconds{1'000'000}}}) {
    Thrusters thrusters;
    thrusters.order(100, kStart + ahead);
    CHECK(thrusters.after_step(kStart).reason != ThrustReason::kCommanded);
    CHECK(thrusters.box.last == kNeutralThrust);
  }
}

TEST_CASE("thruster task: a command out of range moves nothing", "[low_level][tasks]") {
  for (const int surge_ref : {101, -101, std::numeric_limits<int>::max()}) {
    Thrusters thrusters;
    thrusters.order(surge_ref, kStart);
    CHECK(thrusters.after_step(kStart).reason != ThrustReason::kCommanded);
    CHECK(thrusters.box.last == kNeutralThrust);
  }
}

TEST_CASE("thruster task: a box that takes no command is said to have failed",
          "[low_level][tasks]") {
  Thrusters thrusters;
  thrusters.order(40, kStart);
  thrusters.box.status = CommandStatus::kDisconnected;
  const ThrustApplied failed = thrusters.after_step(kStart);
  CHECK(failed.reason == ThrustReason::kDeviceFailed);
  CHECK(failed.surge_ref == 0);  // nobody may reckon with what was not done
  CHECK(int{failed.left} == 128);
  thrusters.box.status = CommandStatus::kTaken;
  CHECK(thrusters.after_step(kStart + milliseconds{50}).reason == ThrustReason::kCommanded);
}

TEST_CASE("thruster task: made safe it is neutral whatever the helm said", "[low_level][tasks]") {
  Thrusters thrusters;
  thrusters.order(100, kStart);
  (void)thrusters.after_step(kStart);
  thrusters.task.enter_safe_state(kStart + milliseconds{1});
  CHECK(thrusters.box.last == kNeutralThrust);
  CHECK(int{thrusters.applied.latest()->value.left} == 128);
}

TEST_CASE("thruster task: without thrusters nothing is applied, and that is said",
          "[low_level][tasks]") {
  const auto board = std::make_unique<Blackboard>();
  ThrusterTask task{*board, Role::kLow, nullptr};
  Writer<HelmCommand> helm{board->helm_command, Role::kHigh, "helm_command"};
  HelmCommand command;
  command.reason = HelmReason::kTracking;
  command.surge_ref = 40;
  helm.publish(command, kStart);
  task.step(kStart);
  Reader<ThrustApplied> applied{board->thrust_applied};
  CHECK(applied.latest()->value.reason == ThrustReason::kNoThrusters);
  CHECK(applied.latest()->value.surge_ref == 0);
  Reader<DeviceHealth> health{board->device_health[static_cast<std::size_t>(DeviceId::kThrusters)]};
  CHECK(health.latest()->value.status == DeviceStatus::kAbsent);
  task.enter_safe_state(kStart + milliseconds{1});
  CHECK(applied.latest()->value.reason == ThrustReason::kNoThrusters);
}

TEST_CASE("thruster task: a box that goes and comes back is told of at once",
          "[low_level][tasks]") {
  Thrusters thrusters;
  Reader<DeviceHealth> health{
      thrusters.board->device_health[static_cast<std::size_t>(DeviceId::kThrusters)]};
  (void)thrusters.after_step(kStart);
  CHECK(health.latest()->value.status == DeviceStatus::kWorking);
  thrusters.box.status = CommandStatus::kDisconnected;
  (void)thrusters.after_step(kStart + milliseconds{50});
  CHECK(health.latest()->value.status == DeviceStatus::kDisconnected);
  CHECK(health.latest()->value.since == kStart + milliseconds{50});
  thrusters.box.status = CommandStatus::kTaken;
  (void)thrusters.after_step(kStart + milliseconds{100});
  CHECK(health.latest()->value.status == DeviceStatus::kWorking);
  CHECK(health.latest()->value.disconnections == 1);
}

}  // namespace
}  // namespace lodesman::testing
