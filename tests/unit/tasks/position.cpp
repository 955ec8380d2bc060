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

}  // namespace
}  // namespace lodesman::testing
