// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/sensors.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

struct Position {
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  ScriptedPosition sensor;
  PositionTask task{*board, Role::kLow, &sensor};
  Reader<PositionFix> fixes{board->position_fix};

  [[nodiscard]] std::vector<double> latitudes_after_step() {
    task.step(kStart);
    std::vector<double> latitudes;
    for (const PositionFix& fix : all_of(fixes)) {
      latitudes.push_back(fix.latitude_deg);
    }
    return latitudes;
  }
};

[[nodiscard]] PositionFix fix(double latitude_deg, double sigma_m = 1.0) {
  return {kStart, latitude_deg, 139.0, sigma_m};
}

using Latitudes = std::vector<double>;

TEST_CASE("position task: every fix is published once and in order", "[low_level][tasks]") {
  Position position;
  position.sensor.give(fix(35.0));
  position.sensor.give(fix(35.1));
  CHECK(position.latitudes_after_step() == Latitudes{35.0, 35.1});
  CHECK(position.latitudes_after_step().empty());
}

TEST_CASE("position task: a receiver that is gone publishes nothing until it is back",
          "[low_level][tasks]") {
  Position position;
  position.sensor.give(ReadStatus::kDisconnected);
  position.sensor.give(fix(35.0));
  CHECK(position.latitudes_after_step().empty());
  CHECK(position.latitudes_after_step() == Latitudes{35.0});
}

TEST_CASE("position task: a fix that is no place on earth is as if it had not come",
          "[low_level][tasks]") {
  Position position;
  position.sensor.give(fix(kNaN));
  position.sensor.give(fix(91.0));
  position.sensor.give(fix(35.0, kNaN));
  position.sensor.give(fix(35.0, -1.0));
  position.sensor.give(PositionFix{kStart, 35.0, 181.0, 1.0});
  position.sensor.give(fix(36.0));
  CHECK(position.latitudes_after_step() == Latitudes{36.0});
}

TEST_CASE("position task: without a receiver there are no fixes, and that is said",
          "[low_level][tasks]") {
  const auto board = std::make_unique<Blackboard>();
  PositionTask task{*board, Role::kLow, nullptr};
  task.step(kStart);
  Reader<PositionFix> fixes{board->position_fix};
  CHECK(fixes.latest() == nullptr);
  Reader<DeviceHealth> health{board->device_health[static_cast<std::size_t>(DeviceId::kPosition)]};
  REQUIRE(health.latest() != nullptr);
  CHECK(health.latest()->value.status == DeviceStatus::kAbsent);
}

// A receiver, and an origin 100 km from which it is not believed.
struct Limited {
  explicit Limited(std::optional<GeoPoint> origin)
      : task{*board, Role::kLow, &sensor, {origin, 100e3}} {}

  [[nodiscard]] bool takes(double latitude_deg) {
    sensor.give(fix(latitude_deg));
    task.step(kStart);
    return !all_of(fixes).empty();
  }
  [[nodiscard]] DeviceHealth health() {
    const auto* told = healths.latest();
    REQUIRE(told != nullptr);
    return told->value;
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  ScriptedPosition sensor;
  PositionTask task;
  Reader<PositionFix> fixes{board->position_fix};
  Reader<DeviceHealth> healths{board->device_health[static_cast<std::size_t>(DeviceId::kPosition)]};
};

TEST_CASE("G8: a fix farther from the origin than is set is not used, and that is said",
          "[low_level][tasks]") {
  Limited position{GeoPoint{35.0, 139.0}};
  CHECK(position.takes(35.0));
  CHECK(position.health().fault == DeviceFault::kNone);
  CHECK(position.takes(35.89));  // 99 km
  CHECK_FALSE(position.takes(35.91));
  CHECK(position.health().fault == DeviceFault::kFarOff);
  CHECK(position.health().status == DeviceStatus::kRefused);
  CHECK_FALSE(position.takes(0.0));
  CHECK(position.takes(35.0));
  CHECK(position.health().fault == DeviceFault::kNone);
  CHECK(position.health().status == DeviceStatus::kWorking);
}

TEST_CASE("G8: before the first fixes are the origin none is too far, after it they are",
          "[low_level][tasks]") {
  Limited position{std::nullopt};
  CHECK(position.takes(-60.0));
  // One that an earlier program's configuration gave is not the first fixes'.
  Writer<WorldOrigin>{position.board->world_origin, Role::kHigh, "world_origin"}.publish(
      {35.0, 139.0}, kStart);
  CHECK(position.takes(-60.0));
  CHECK(position.takes(48.0));
  Writer<WorldOrigin>{position.board->world_origin, Role::kHigh, "world_origin"}.publish(
      {48.0, 139.0, OriginSource::kFirstFix, 1.0, kStart}, kStart);
  CHECK(position.takes(48.1));
  CHECK_FALSE(position.takes(-60.0));
  CHECK(position.health().fault == DeviceFault::kFarOff);
}

// A fix a second, of a receiver whose speed is nought whatever the boat does.
struct Frozen {
  [[nodiscard]] DeviceFault fault_after(int fixes, int surge_ref, double step_deg = 0.0) {
    for (int i = 0; i < fixes; ++i) {
      now += seconds{1};
      ThrustApplied applied;
      applied.reason = ThrustReason::kCommanded;
      applied.surge_ref = surge_ref;
      thrust.publish(applied, now);
      latitude_deg += step_deg;
      PositionFix fix{now, latitude_deg, 139.0, 1.0};
      fix.has_speed = true;
      position.sensor.give(fix);
      position.task.step(now);
      given += all_of(position.fixes).size();
    }
    const auto* told = healths.latest();
    REQUIRE(told != nullptr);
    return told->value.fault;
  }

  Position position;
  Writer<ThrustApplied> thrust{position.board->thrust_applied, Role::kLow, "thrust_applied"};
  Reader<DeviceHealth> healths{
      position.board->device_health[static_cast<std::size_t>(DeviceId::kPosition)]};
  Time now = kStart;
  double latitude_deg = 35.0;
  std::size_t given = 0;
};

TEST_CASE("C3: a place that repeats itself under thrust is told of, its speed of nought or not",
          "[low_level][tasks]") {
  Frozen frozen;
  CHECK(frozen.fault_after(30, 0) == DeviceFault::kNone);  // at rest a receiver may hold its place
  CHECK(frozen.fault_after(9, 16) == DeviceFault::kNone);
  CHECK(frozen.fault_after(2, 16) == DeviceFault::kFrozen);
  CHECK(frozen.fault_after(1, 16, 1e-9) == DeviceFault::kNone);
  CHECK(frozen.fault_after(11, -16) == DeviceFault::kFrozen);
  CHECK(frozen.fault_after(1, 0) == DeviceFault::kNone);
  CHECK(frozen.given == 54);  // none is kept back
}

TEST_CASE("C3: a receiver whose last digit moves is never called frozen", "[low_level][tasks]") {
  Frozen lively;
  for (int i = 0; i < 100; ++i) {
    REQUIRE(lively.fault_after(1, 57, i % 5 == 0 ? 1e-9 : 0.0) == DeviceFault::kNone);
  }
}

}  // namespace
}  // namespace lodesman::testing
