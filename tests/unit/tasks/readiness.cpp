// SPDX-License-Identifier: Apache-2.0
// Whether the boat may set out with a device that ails, and what whoever starts it is told.
#include "high_level/tasks/readiness.h"

#include <nlohmann/json.hpp>

#include "high_level/tasks/desk_replies.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

using nlohmann::json;

// A boat that is ready but for what its sonar says.
struct ReadyBoat {
  ReadyBoat() {
    attitudes.publish({now, 0.0, 0.0}, now);
    VehicleState here;
    here.valid_at = now;
    states.publish(here, now);
    const auto seen = std::make_unique<SonarObstacles>();
    seen->captured = now;
    obstacles.publish(*seen, now);
    thrusts.publish({}, now);
    ThrustStatus armed;
    armed.state = ThrustState::kArmed;
    armings.publish(armed, now);
  }
  void sonar(DeviceStatus status, DeviceFault fault) {
    DeviceHealth health;
    health.status = status;
    health.fault = fault;
    health.since = now - seconds{2};
    sonars.publish(health, now);
  }
  [[nodiscard]] std::vector<std::string> reasons() { return readiness.reasons(now); }

  Time now = kStart;
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Writer<Attitude> attitudes{board->attitude, Role::kLow, "attitude"};
  Writer<VehicleState> states{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Writer<SonarObstacles> obstacles{board->sonar_obstacles, Role::kLow, "sonar_obstacles"};
  Writer<ThrustApplied> thrusts{board->thrust_applied, Role::kLow, "thrust_applied"};
  Writer<ThrustStatus> armings{board->thrust_status, Role::kLow, "thrust_status"};
  Writer<DeviceHealth> sonars{board->device_health[static_cast<std::size_t>(DeviceId::kSonar)],
                              Role::kLow, "sonar_device"};
  Readiness readiness{*board, false};
};

TEST_CASE("readiness: with a sonar that shows nothing no boat sets out", "[high_level][tasks]") {
  ReadyBoat boat;
  boat.sonar(DeviceStatus::kWorking, DeviceFault::kNone);
  CHECK(boat.reasons().empty());
  for (const DeviceFault fault :
       {DeviceFault::kSaturated, DeviceFault::kFrozen, DeviceFault::kDeaf}) {
    boat.sonar(DeviceStatus::kWorking, fault);
    REQUIRE(boat.reasons().size() == 1);  // its last frame is fresh
    CHECK(boat.reasons()[0] ==
          std::string{"the sonar shows nothing of the water: "} + describe(fault));
  }
  boat.now += max_age::kSonarFrame + Duration{1};
  const auto reasons = boat.reasons();
  CHECK(std::count_if(reasons.begin(), reasons.end(), [](const std::string& reason) {
          return reason.find("sonar") != std::string::npos;
        }) == 1);
  boat.sonar(DeviceStatus::kSilent, DeviceFault::kNone);
  CHECK(boat.reasons().back().starts_with("no sonar frame: its device is silent for "));
}

TEST_CASE("readiness: a sonar that is blind in part is no reason, and whoever starts is told",
          "[high_level][tasks]") {
  ReadyBoat boat;
  CHECK(boat.readiness.warnings().empty());
  for (const DeviceFault fault :
       {DeviceFault::kBlindSector, DeviceFault::kWeed, DeviceFault::kInterference}) {
    boat.sonar(DeviceStatus::kWorking, fault);
    CHECK(boat.reasons().empty());
    CHECK(boat.readiness.warnings() == std::vector{std::string{"sonar: "} + describe(fault)});
  }
  boat.sonar(DeviceStatus::kSilent, DeviceFault::kNoAnswer);
  CHECK(boat.readiness.warnings().empty());  // that is more than a warning
  boat.sonar(DeviceStatus::kWorking, DeviceFault::kNone);
  CHECK(boat.readiness.warnings().empty());
}

TEST_CASE("readiness: a warning stands in the reply to an order that is obeyed",
          "[high_level][tasks]") {
  CHECK(json::parse(reply_of(OrderAnswer::kObeyed, MissionState::kUnderWay, {"sonar: weed"})) ==
        json{{"ok", true}, {"state", "under_way"}, {"warnings", {"sonar: weed"}}});
  CHECK(json::parse(reply_of(OrderAnswer::kObeyed, MissionState::kUnderWay)) ==
        json{{"ok", true}, {"state", "under_way"}});
  CHECK(json::parse(reply_of(OrderAnswer::kAborted, MissionState::kAborted, {"sonar: weed"})) ==
        json{{"ok", false}, {"error", "an abort came first"}});
}

}  // namespace
}  // namespace lodesman::testing
