// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/mission.h"

#include "tests/support/catch.h"

using namespace lodesman;

namespace {
Time s(double seconds) { return Time{from_seconds(seconds)}; }
Mission two_goals() { return Mission{{{{{0, 5}}, {{0, 20}}}, 0.5, 1.0}}; }
}  // namespace

TEST_CASE("mission: it waits for its start and ends at the last goal", "[high_level][mission]") {
  Mission mission = two_goals();
  mission.advance({{0, 20}}, s(1));
  CHECK(mission.status().state == MissionState::kIdle);
  mission.order(OperatorOrder::kStart, {}, s(2));
  CHECK(mission.status().started == s(2));
  CHECK(mission.goal().xy_m.y() == Approx(5));
  mission.advance({{0.4, 5}}, s(3));
  CHECK(mission.goal().xy_m.y() == Approx(20));
  mission.advance({{0, 18.9}}, s(4));
  CHECK(mission.under_way());
  mission.advance({{0, 19.1}}, s(5));
  CHECK(mission.status().state == MissionState::kReached);
  CHECK(mission.status().ended == s(5));
}

TEST_CASE("mission: an abort holds until a new start, which begins at the first goal",
          "[high_level][mission]") {
  Mission mission = two_goals();
  mission.order(OperatorOrder::kStart, {}, s(1));
  mission.advance({{0, 5}}, s(2));
  mission.order(OperatorOrder::kAbort, {}, s(3));
  mission.advance({{0, 20}}, s(4));
  CHECK(mission.status().state == MissionState::kAborted);
  mission.order(OperatorOrder::kNone, {}, s(5));
  CHECK(mission.status().state == MissionState::kAborted);
  mission.order(OperatorOrder::kStart, {}, s(6));
  CHECK(mission.under_way());
  CHECK(mission.status().goal_index == 0);
  CHECK(mission.status().started == s(6));
}

TEST_CASE("mission: a start under way changes nothing", "[high_level][mission]") {
  Mission mission = two_goals();
  mission.order(OperatorOrder::kStart, {}, s(1));
  mission.advance({{0, 5}}, s(2));
  mission.order(OperatorOrder::kStart, {}, s(3));
  CHECK(mission.status().goal_index == 1);
  CHECK(mission.status().started == s(1));
}

TEST_CASE("mission: a hold stays where it was given, and resume goes on", "[high_level][mission]") {
  Mission mission = two_goals();
  mission.order(OperatorOrder::kHold, {{0, 3}}, s(0.5));
  CHECK(mission.status().state == MissionState::kIdle);  // nothing to hold from
  mission.order(OperatorOrder::kStart, {}, s(1));
  mission.advance({{0, 5}}, s(2));
  mission.order(OperatorOrder::kResume, {{0, 7}}, s(2.5));
  CHECK(mission.goal().xy_m.y() == Approx(20));
  mission.order(OperatorOrder::kHold, {{1, 8}}, s(3));
  CHECK(mission.holding());
  CHECK(mission.goal().xy_m.x() == Approx(1));
  CHECK(mission.goal().xy_m.y() == Approx(8));
  mission.advance({{0, 20}}, s(4));
  CHECK(mission.holding());
  mission.order(OperatorOrder::kResume, {{1, 9}}, s(5));
  CHECK(mission.under_way());
  CHECK(mission.goal().xy_m.y() == Approx(20));
  CHECK(mission.status().started == s(1));
  mission.order(OperatorOrder::kHold, {{1, 9}}, s(6));
  mission.order(OperatorOrder::kAbort, {{1, 9}}, s(7));
  CHECK(mission.status().state == MissionState::kAborted);
}
