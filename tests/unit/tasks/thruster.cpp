// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/thruster.h"

#include "low_level/thrust/thrust_map.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

// Armed, but where it says otherwise.
struct Thrusters {
  explicit Thrusters(bool armed = true) {
    if (armed) {
      give(ThrustOrderKind::kArm);
    }
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  ScriptedThrusters box;
  ThrusterTask task{*board, Role::kLow, &box};
  Writer<HelmCommand> helm{board->helm_command, Role::kHigh, "helm_command"};
  Writer<ThrustOrder> orders{board->thrust_order, Role::kHigh, "thrust_order"};
  Writer<ManualInput> stick{board->manual_input, Role::kHigh, "manual_input"};
  Reader<ThrustApplied> applied{board->thrust_applied};
  Reader<ThrustStatus> status{board->thrust_status};
  std::uint64_t stops = 0;

  // With the helm at rest, shortly before the test begins.
  void give(ThrustOrderKind kind) {
    const Time before = kStart - seconds{1};
    order(0, before);
    task.step(before);
    stops += kind == ThrustOrderKind::kStop ? 1U : 0U;
    orders.publish({kind, stops}, before);
    task.step(before);
    REQUIRE(status.latest()->value.answer == ThrustAnswer::kObeyed);
  }
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
  CHECK(applied.command_sequence == 2);
  CHECK(thrusters.box.last == map_thrust(40, 0));
}

TEST_CASE("thruster task: before the helm has spoken thrust is neutral", "[low_level][tasks]") {
  ThrustStatus before;
  before.state = ThrustState::kArmed;
  const auto board = std::make_unique<Blackboard>();
  // As a low level that was here shortly before has left it; the helm's words are gone.
  (void)Writer<ThrustStatus>{board->thrust_status, Role::kLow, "thrust_status"}.publish(
      before, kStart - seconds{1});
  ScriptedThrusters box;
  ThrusterTask task{*board, Role::kLow, &box};
  task.step(kStart);
  CHECK(Reader<ThrustApplied>{board->thrust_applied}.latest()->value.reason ==
        ThrustReason::kNoCommand);
  CHECK(box.last == kNeutralThrust);
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
  // Whoever puts a box back does not find it at full thrust.
  CHECK(thrusters.after_step(kStart + milliseconds{50}).reason == ThrustReason::kDeviceFailed);
  CHECK(thrusters.box.last == kNeutralThrust);
  CHECK(thrusters.after_step(kStart + milliseconds{100}).reason == ThrustReason::kCommanded);
}

TEST_CASE("thruster task: disarmed it is neutral whatever the helm says", "[low_level][tasks]") {
  Thrusters thrusters{false};
  thrusters.order(100, kStart);
  CHECK(thrusters.after_step(kStart).reason == ThrustReason::kDisarmed);
  CHECK(thrusters.box.last == kNeutralThrust);
  CHECK(thrusters.status.latest()->value.state == ThrustState::kDisarmed);
}

TEST_CASE("thruster task: an emergency stop is obeyed at the next step, whatever the helm says",
          "[low_level][tasks]") {
  Thrusters thrusters;
  thrusters.order(100, kStart);
  CHECK(thrusters.after_step(kStart).reason == ThrustReason::kCommanded);
  thrusters.orders.publish({ThrustOrderKind::kStop, 1}, kStart + milliseconds{1});
  CHECK(thrusters.after_step(kStart + milliseconds{2}).reason == ThrustReason::kStopped);
  CHECK(thrusters.box.last == kNeutralThrust);
}

TEST_CASE("thruster task: a stop from before the power was off stands", "[low_level][tasks]") {
  const auto board = std::make_unique<Blackboard>();
  ScriptedThrusters box;
  ThrusterOptions options;
  options.stop_is_latched = true;
  ThrusterTask task{*board, Role::kLow, &box, options};
  task.step(kStart);
  CHECK(Reader<ThrustStatus>{board->thrust_status}.latest()->value.state == ThrustState::kStopped);
}

TEST_CASE("thruster task: the stick outranks the helm, and silent it is neutral",
          "[low_level][tasks]") {
  Thrusters thrusters;
  thrusters.order(100, kStart);
  thrusters.stick.publish({-30, 20}, kStart);
  ThrustApplied applied = thrusters.after_step(kStart);
  CHECK(applied.reason == ThrustReason::kManual);
  CHECK(applied.surge_ref == -30);
  CHECK(applied.head_ref == 20);
  CHECK(thrusters.box.last == map_thrust(-30, 20));
  const Time late = kStart + max_age::kManualInput;
  thrusters.order(100, late);
  CHECK(thrusters.after_step(late).reason == ThrustReason::kManual);
  applied = thrusters.after_step(late + Duration{1});
  CHECK(applied.reason == ThrustReason::kStickSilent);
  CHECK(thrusters.box.last == kNeutralThrust);
  thrusters.order(100, late + seconds{10});
  CHECK(thrusters.after_step(late + seconds{10}).reason == ThrustReason::kStickSilent);
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
