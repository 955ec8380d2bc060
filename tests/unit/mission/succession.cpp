// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/succession.h"

#include "high_level/mission/mission.h"
#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::seconds;

namespace {

// Of a mission under way that says `resume`, a second after its program died.
Legacy under_way() {
  Legacy legacy;
  legacy.said.state = MissionState::kUnderWay;
  legacy.silence = seconds{1};
  legacy.policy = OnRestart::kResume;
  legacy.mission_is_known = true;
  return legacy;
}

MissionDefinition two_goals() {
  MissionDefinition mission;
  mission.id = 3;
  mission.speed_m_s = 0.22;
  mission.goal_radius_m = 1.0;
  mission.link_lost = LinkLost::kReturn;
  mission.goal_count = 2;
  mission.goals[0] = {0, 5};
  mission.goals[1] = {0, 20};
  return mission;
}

MissionStatus making_for(double y_m, std::uint32_t index) {
  MissionStatus status;
  status.state = MissionState::kUnderWay;
  status.cause = MissionCause::kLinkLost;
  status.mission = 3;
  status.started = status.first_started = Time{seconds{7}};
  status.goal_index = index;
  status.goal_y_m = y_m;
  status.home_x_m = -4.0;
  status.aborts = 2;
  status.order = 9;
  return status;
}

constexpr Succession kResumed{MissionState::kUnderWay, MissionCause::kRestart};

}  // namespace

TEST_CASE("succession: a mission is sailed on with only if it says so and nothing stands against",
          "[high_level][mission]") {
  const auto check = [](const Legacy& legacy, MissionState state, MissionCause cause) {
    const Succession next = succession_of(legacy);
    CHECK(next.state == state);
    CHECK(next.cause == cause);
  };
  check(under_way(), MissionState::kUnderWay, MissionCause::kRestart);
  Legacy holds = under_way();
  holds.policy = OnRestart::kHold;
  check(holds, MissionState::kHolding, MissionCause::kRestart);
  Legacy ordered = under_way();
  ordered.order_unanswered = true;
  check(ordered, MissionState::kHolding, MissionCause::kRestart);
  Legacy late = under_way();
  late.silence = kLongestAbsence;
  check(late, MissionState::kUnderWay, MissionCause::kRestart);
  late.silence += Duration{1};
  check(late, MissionState::kHolding, MissionCause::kAbsence);
  Legacy off = under_way();
  off.thrusters_are_off = true;
  check(off, MissionState::kAborted, MissionCause::kRestart);
  Legacy unknown = under_way();
  unknown.mission_is_known = false;
  check(unknown, MissionState::kIdle, MissionCause::kOrder);
}

TEST_CASE("succession: what was held, aborted, reached or not begun stays so",
          "[high_level][mission]") {
  for (const MissionState state : {MissionState::kHolding, MissionState::kAborted,
                                   MissionState::kReached, MissionState::kIdle}) {
    Legacy legacy = under_way();
    legacy.said.state = state;
    legacy.silence = 10 * kLongestAbsence;
    CHECK(succession_of(legacy).state == state);
  }
  Legacy held_and_stopped = under_way();
  held_and_stopped.said.state = MissionState::kHolding;
  held_and_stopped.thrusters_are_off = true;
  CHECK(succession_of(held_and_stopped).state == MissionState::kAborted);
}

TEST_CASE("mission: one that is taken up goes on at the goal that it was making for",
          "[high_level][mission]") {
  Mission mission{{0.5, SpeedTable::proportional(0.01)}};
  mission.take_up(making_for(20.0, 1), two_goals(), kResumed, Time{seconds{50}});
  CHECK(mission.under_way());
  CHECK(mission.goal().xy_m.y() == Approx(20.0));
  CHECK(mission.status().cause == MissionCause::kRestart);
  CHECK(mission.status().started == Time{seconds{7}});
  CHECK(mission.status().surge_ref == 22);
  CHECK(mission.status().aborts == 2);
  CHECK(mission.status().order == 9);
  mission.advance({{0.0, 19.5}}, Time{seconds{51}});
  CHECK(mission.status().state == MissionState::kReached);
}

TEST_CASE("mission: one that was on its way back goes on back, to no goal of its own",
          "[high_level][mission]") {
  MissionStatus back = making_for(0.0, 0);
  back.goal_x_m = -4.0;
  Mission mission{{0.5, SpeedTable::proportional(0.01)}};
  mission.take_up(back, two_goals(), kResumed, Time{seconds{50}});
  CHECK(mission.under_way());
  CHECK(mission.goal().xy_m.x() == Approx(-4.0));
  CHECK(mission.status().cause == MissionCause::kLinkLost);
  mission.advance({{-4.0, 0.2}}, Time{seconds{51}});
  CHECK(mission.status().state == MissionState::kReached);
}

TEST_CASE("mission: after it is taken up a lost link leads back to where it set out from",
          "[high_level][mission]") {
  Mission mission{{0.5, SpeedTable::proportional(0.01)}};
  mission.take_up(making_for(20.0, 1), two_goals(), kResumed, Time{seconds{50}});
  CommandLink silent;
  silent.session = 1;
  silent.heard = Time{seconds{20}};
  mission.watch_link(silent, {{0.0, 10.0}}, Time{seconds{50}});
  CHECK(mission.under_way());
  CHECK(mission.goal().xy_m.x() == Approx(-4.0));
}
