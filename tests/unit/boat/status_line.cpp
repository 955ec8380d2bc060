// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/status_line.h"

#include <memory>

#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("status line: what the mission is, and why where nobody ordered it", "[deploy][boat]") {
  const auto board = std::make_unique<Blackboard>();
  Writer<MissionStatus> mission{board->mission_status, Role::kHigh, "mission_status"};
  HighStatusLine line{*board};
  CHECK(line.text(true) == "mission unknown");
  MissionStatus status;
  status.state = MissionState::kUnderWay;
  mission.publish(status, Time{Duration{1}});
  CHECK(line.text(true) == "mission under_way");
  status.state = MissionState::kAborted;
  status.cause = MissionCause::kDisarmed;
  mission.publish(status, Time{Duration{2}});
  CHECK(line.text(true) == "mission aborted (disarmed)");
  CHECK(line.text(false) == "mission aborted (disarmed); neutral: lodesman-low is gone");
}
