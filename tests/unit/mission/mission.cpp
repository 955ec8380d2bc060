// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/mission.h"

#include "tests/support/catch.h"

using namespace lodesman;

namespace {
Time s(double seconds) { return Time{from_seconds(seconds)}; }

MissionDefinition mission_through_5_and_20() {
  MissionDefinition mission;
  mission.id = 1;
  mission.speed_m_s = 0.22;
  mission.goal_radius_m = 1.0;
  mission.link_lost_after = from_seconds(5);
  mission.goal_count = 2;
  mission.blocked_patience = from_seconds(60);
  mission.goals[0] = {0, 5};
  mission.goals[1] = {0, 20};
  return mission;
}

// A mission, and the desk that counts its orders.
struct Ordered {
  Ordered() { mission.set_at_hand(mission_through_5_and_20()); }

  Mission mission{{0.5, SpeedTable::proportional(0.01)}};
  std::uint64_t aborts = 0;
  std::uint64_t sequence = 0;

  OrderAnswer give(OperatorOrder order, Time now, const WorldPoint& position = {}) {
    aborts += order == OperatorOrder::kAbort ? 1 : 0;
    mission.take({{order, aborts}, ++sequence, now}, position, now);
    return mission.status().answer;
  }
  [[nodiscard]] MissionState state() const { return mission.status().state; }
};
}  // namespace

TEST_CASE("mission: it waits for its start and ends at the last goal", "[high_level][mission]") {
  Ordered ordered;
  Mission& mission = ordered.mission;
  mission.advance({{0, 20}}, s(1));
  CHECK(mission.status().state == MissionState::kIdle);
  ordered.give(OperatorOrder::kStart, s(2));
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

TEST_CASE("mission: the line that is kept to begins where it set out, then at the last waypoint",
          "[high_level][mission]") {
  Ordered ordered;
  Mission& mission = ordered.mission;
  MissionDefinition definition = mission_through_5_and_20();
  definition.legs = Legs::kLine;
  definition.link_lost = LinkLost::kReturn;
  mission.set_at_hand(definition);
  CHECK_FALSE(mission.line_begin());
  ordered.give(OperatorOrder::kStart, s(1), {{3, 1}});
  REQUIRE(mission.line_begin());
  CHECK(mission.line_begin()->xy_m == Eigen::Vector2d{3, 1});
  mission.advance({{0, 5}}, s(2));
  REQUIRE(mission.line_begin());
  CHECK(mission.line_begin()->xy_m == Eigen::Vector2d{0, 5});
  ordered.give(OperatorOrder::kHold, s(3), {{1, 8}});
  CHECK_FALSE(mission.line_begin());
  ordered.give(OperatorOrder::kResume, s(4), {{1, 8}});
  CHECK(mission.line_begin()->xy_m == Eigen::Vector2d{0, 5});
  // The way back is no leg of it.
  mission.watch_link({7, s(1), s(1)}, {{1, 8}}, s(20));
  CHECK(mission.under_way());
  CHECK_FALSE(mission.line_begin());
}

TEST_CASE("mission: a waypoint to which there is no way is waited for, then left out or held at",
          "[high_level][mission]") {
  using enum GoalOutlook;
  for (const Blocked policy : {Blocked::kHold, Blocked::kSkip}) {
    INFO(to_string(policy));
    Ordered ordered;
    Mission& mission = ordered.mission;
    MissionDefinition definition = mission_through_5_and_20();
    definition.blocked = policy;
    mission.set_at_hand(definition);
    ordered.give(OperatorOrder::kStart, s(0));
    mission.watch_blocked(kBlocked, {{0, 2}}, s(1));  // it is on its way to where it waits
    CHECK(mission.status().blocked_since == Time{});
    mission.watch_blocked(kAwaited, {{0, 3}}, s(10));
    CHECK(mission.status().blocked_since == s(10));
    mission.watch_blocked(kBlocked, {{0, 3}}, s(40));  // pushed off, it goes back
    mission.watch_blocked(kAwaited, {{0, 3}}, s(69.9));
    CHECK(mission.under_way());
    CHECK(mission.status().goal_index == 0);
    mission.watch_blocked(kAwaited, {{0, 3}}, s(70));
    CHECK(mission.status().blocked_since == Time{});
    if (policy == Blocked::kSkip) {
      CHECK(mission.under_way());
      CHECK(mission.status().goal_index == 1);
      CHECK(mission.status().skipped == 1);
      ordered.give(OperatorOrder::kAbort, s(71));
      ordered.give(OperatorOrder::kStart, s(72));
      CHECK(mission.status().skipped == 0);
      continue;
    }
    CHECK(mission.holding());
    CHECK(mission.status().cause == MissionCause::kBlocked);
    CHECK(mission.goal().xy_m.y() == Approx(3));
    ordered.give(OperatorOrder::kResume, s(80));
    CHECK(mission.status().cause == MissionCause::kOrder);
    CHECK(mission.goal().xy_m.y() == Approx(5));
    mission.watch_blocked(kAwaited, {{0, 3}}, s(81));
    mission.watch_blocked(kAwaited, {{0, 3}}, s(140));
    CHECK(mission.under_way());
  }
}

TEST_CASE("mission: a wait ends with a way, and the last goal is waited for as long as it takes",
          "[high_level][mission]") {
  using enum GoalOutlook;
  Ordered ordered;
  Mission& mission = ordered.mission;
  ordered.give(OperatorOrder::kStart, s(0));
  mission.watch_blocked(kAwaited, {{0, 3}}, s(10));
  mission.watch_blocked(kOpen, {{0, 3}}, s(65));
  CHECK(mission.status().blocked_since == Time{});
  mission.watch_blocked(kAwaited, {{0, 3}}, s(80));
  CHECK(mission.under_way());
  mission.advance({{0, 5}}, s(90));
  REQUIRE(mission.status().goal_index == 1);
  mission.watch_blocked(kAwaited, {{0, 17}}, s(100));
  mission.watch_blocked(kAwaited, {{0, 17}}, s(10'000));
  CHECK(mission.under_way());
  CHECK(mission.status().blocked_since == s(100));  // which it says
}

TEST_CASE("mission: an abort holds until a new start, which begins at the first goal",
          "[high_level][mission]") {
  Ordered ordered;
  ordered.give(OperatorOrder::kStart, s(1));
  ordered.mission.advance({{0, 5}}, s(2));
  ordered.give(OperatorOrder::kAbort, s(3));
  ordered.mission.advance({{0, 20}}, s(4));
  CHECK(ordered.state() == MissionState::kAborted);
  CHECK(ordered.mission.status().ended == s(3));
  ordered.give(OperatorOrder::kNone, s(5));
  CHECK(ordered.state() == MissionState::kAborted);
  CHECK(ordered.give(OperatorOrder::kStart, s(6)) == OrderAnswer::kObeyed);
  CHECK(ordered.mission.under_way());
  CHECK(ordered.mission.status().goal_index == 0);
  CHECK(ordered.mission.status().started == s(6));
}

TEST_CASE("mission: of the orders taken at one time an abort wins, wherever it stands",
          "[high_level][mission]") {
  using enum OperatorOrder;
  const std::vector<std::vector<OperatorOrder>> batches{{kAbort},
                                                        {kAbort, kStart},
                                                        {kStart, kAbort},
                                                        {kStart, kAbort, kStart},
                                                        {kAbort, kHold},
                                                        {kHold, kResume, kAbort, kResume, kStart},
                                                        {kAbort, kAbort, kStart, kHold, kResume}};
  for (const MissionState before : {MissionState::kIdle, MissionState::kUnderWay,
                                    MissionState::kHolding, MissionState::kAborted}) {
    for (const auto& batch : batches) {
      Ordered ordered;
      if (before != MissionState::kIdle) {
        ordered.give(kStart, s(1));
      }
      if (before == MissionState::kHolding) {
        ordered.give(kHold, s(2));
      } else if (before == MissionState::kAborted) {
        ordered.give(kAbort, s(2));
      }
      REQUIRE(ordered.state() == before);
      for (const OperatorOrder order : batch) {
        ordered.give(order, s(3));
      }
      CHECK(ordered.state() == MissionState::kAborted);
      CHECK(ordered.mission.status().aborts == ordered.aborts);
      // Later, by one who can know of the abort.
      CHECK(ordered.give(kStart, s(3.05)) == OrderAnswer::kObeyed);
      CHECK(ordered.mission.under_way());
    }
  }
}

TEST_CASE("mission: an abort that was lost is obeyed by its count, before what brings the count",
          "[high_level][mission]") {
  for (const OperatorOrder order : {OperatorOrder::kStart, OperatorOrder::kHold,
                                    OperatorOrder::kResume, OperatorOrder::kNone}) {
    Ordered ordered;
    ordered.give(OperatorOrder::kStart, s(1));
    ordered.aborts = 7;  // seven orders that were overwritten
    ordered.give(order, s(2));
    CHECK(ordered.state() == MissionState::kAborted);
    CHECK(ordered.mission.status().aborts == 7);
    CHECK(ordered.mission.status().ended == s(2));
    const bool answered = order != OperatorOrder::kNone;
    CHECK((ordered.mission.status().answer == OrderAnswer::kAborted) == answered);
  }
}

TEST_CASE("mission: a start that was ordered before an abort is void, however late it comes",
          "[high_level][mission]") {
  Ordered ordered;
  ordered.give(OperatorOrder::kStart, s(1));
  ordered.give(OperatorOrder::kAbort, s(2));
  ordered.mission.take({{OperatorOrder::kStart, 0}, 9, s(1.9)}, {}, s(2.5));
  CHECK(ordered.state() == MissionState::kAborted);
  CHECK(ordered.mission.status().answer == OrderAnswer::kAborted);
  CHECK(ordered.mission.status().order == 9);
}

TEST_CASE("mission: an order is void once its giver has been told so, an abort never is",
          "[high_level][mission]") {
  Ordered ordered;
  const Time late = s(1) + kOrderPatience + Duration{1};
  ordered.mission.take({{OperatorOrder::kStart, 0}, 1, s(1)}, {}, late);
  CHECK(ordered.mission.status().answer == OrderAnswer::kTooOld);
  CHECK(ordered.state() == MissionState::kIdle);
  ordered.mission.take({{OperatorOrder::kStart, 0}, 2, s(1)}, {}, s(1) + kOrderPatience);
  CHECK(ordered.mission.status().answer == OrderAnswer::kObeyed);
  ordered.mission.take({{OperatorOrder::kAbort, 1}, 3, s(0)}, {}, s(100));
  CHECK(ordered.state() == MissionState::kAborted);
}

TEST_CASE("mission: an abort stands over a restart, obeyed or not", "[high_level][mission]") {
  MissionStatus before;
  before.state = MissionState::kUnderWay;
  before.aborts = 3;
  Ordered ordered;
  CHECK_FALSE(ordered.mission.inherit(before, 3));
  CHECK(ordered.state() == MissionState::kIdle);
  CHECK(ordered.mission.status().aborts == 3);
  Ordered unobeyed;
  CHECK(unobeyed.mission.inherit(before, 4));
  CHECK(unobeyed.state() == MissionState::kAborted);
  CHECK(unobeyed.mission.status().aborts == 4);
  before.state = MissionState::kAborted;
  Ordered obeyed;
  CHECK(obeyed.mission.inherit(before, 3));
  CHECK(obeyed.state() == MissionState::kAborted);
  obeyed.aborts = 3;
  CHECK(obeyed.give(OperatorOrder::kStart, s(1)) == OrderAnswer::kObeyed);
  CHECK(obeyed.mission.under_way());
}

TEST_CASE("mission: a start under way changes nothing", "[high_level][mission]") {
  Ordered ordered;
  ordered.give(OperatorOrder::kStart, s(1));
  ordered.mission.advance({{0, 5}}, s(2));
  CHECK(ordered.give(OperatorOrder::kStart, s(3)) == OrderAnswer::kObeyed);
  CHECK(ordered.mission.status().goal_index == 1);
  CHECK(ordered.mission.status().started == s(1));
}

TEST_CASE("mission: a hold stays where it was given, and resume goes on", "[high_level][mission]") {
  Ordered ordered;
  const Mission& mission = ordered.mission;
  CHECK(ordered.give(OperatorOrder::kHold, s(0.5), {{0, 3}}) == OrderAnswer::kNotUnderWay);
  CHECK(ordered.state() == MissionState::kIdle);  // nothing to hold from
  ordered.give(OperatorOrder::kStart, s(1));
  ordered.mission.advance({{0, 5}}, s(2));
  CHECK(ordered.give(OperatorOrder::kResume, s(2.5), {{0, 7}}) == OrderAnswer::kNotHolding);
  CHECK(mission.goal().xy_m.y() == Approx(20));
  CHECK(ordered.give(OperatorOrder::kHold, s(3), {{1, 8}}) == OrderAnswer::kObeyed);
  CHECK(mission.holding());
  CHECK(mission.goal().xy_m.x() == Approx(1));
  CHECK(mission.goal().xy_m.y() == Approx(8));
  ordered.mission.advance({{0, 20}}, s(4));
  CHECK(mission.holding());
  CHECK(ordered.give(OperatorOrder::kResume, s(5), {{1, 9}}) == OrderAnswer::kObeyed);
  CHECK(mission.under_way());
  CHECK(mission.goal().xy_m.y() == Approx(20));
  CHECK(mission.status().started == s(1));
  ordered.give(OperatorOrder::kHold, s(6), {{1, 9}});
  ordered.give(OperatorOrder::kAbort, s(7), {{1, 9}});
  CHECK(ordered.state() == MissionState::kAborted);
}

TEST_CASE("mission: another one under way takes the place of the one that is sailed",
          "[high_level][mission]") {
  Ordered ordered;
  ordered.give(OperatorOrder::kStart, s(1));
  ordered.mission.advance({{0, 5}}, s(2));
  MissionDefinition other = mission_through_5_and_20();
  other.id = 2;
  other.goal_count = 1;
  other.goals[0] = {7, 7};
  other.speed_m_s = 0.74;
  ordered.mission.set_at_hand(other);
  ordered.mission.take({{OperatorOrder::kStart, 0, 2}, 9, s(3)}, {{0, 6}}, s(3));
  const MissionStatus& status = ordered.mission.status();
  CHECK(status.answer == OrderAnswer::kObeyed);
  CHECK(status.mission == 2);
  CHECK(status.goal_x_m == Approx(7));
  CHECK(status.surge_ref == 74);
  CHECK(status.started == s(3));
  CHECK(status.first_started == s(1));  // a scenario's time goes on
}

TEST_CASE("mission: a start that names a mission that is not at hand is refused",
          "[high_level][mission]") {
  Ordered ordered;
  ordered.mission.take({{OperatorOrder::kStart, 0, 7}, 1, s(1)}, {}, s(1));
  CHECK(ordered.mission.status().answer == OrderAnswer::kNoMission);
  CHECK(ordered.state() == MissionState::kIdle);
}

TEST_CASE("mission: a lost link does what the mission says, once, and only if it was open",
          "[high_level][mission]") {
  struct Row {
    LinkLost says;
    MissionState state;
  };
  for (const Row& row :
       {Row{LinkLost::kGoOn, MissionState::kUnderWay}, Row{LinkLost::kHold, MissionState::kHolding},
        Row{LinkLost::kReturn, MissionState::kUnderWay},
        Row{LinkLost::kAbort, MissionState::kAborted}}) {
    Ordered ordered;
    MissionDefinition mission = mission_through_5_and_20();
    mission.link_lost = row.says;
    ordered.mission.set_at_hand(mission);
    ordered.give(OperatorOrder::kStart, s(1), {{3, 0}});
    ordered.mission.watch_link({}, {{0, 2}}, s(100));  // nobody commands
    CHECK(ordered.mission.under_way());
    const CommandLink link{4, s(100), s(100)};
    ordered.mission.watch_link(link, {{0, 2}}, s(105));
    CHECK(ordered.mission.status().cause == MissionCause::kOrder);
    ordered.mission.watch_link(link, {{0, 2}}, s(105.1));
    CHECK(ordered.state() == row.state);
    const bool acts = row.says != LinkLost::kGoOn;
    CHECK((ordered.mission.status().cause == MissionCause::kLinkLost) == acts);
    if (row.says == LinkLost::kReturn) {
      CHECK(ordered.mission.goal().xy_m.x() == Approx(3));
    }
    if (row.says == LinkLost::kHold) {
      // Told to go on without the link, it does.
      CHECK(ordered.give(OperatorOrder::kResume, s(106)) == OrderAnswer::kObeyed);
      ordered.mission.watch_link(link, {{0, 2}}, s(107));
      CHECK(ordered.mission.under_way());
      // Heard again, it may be lost again.
      const CommandLink back{4, s(100), s(108)};
      ordered.mission.watch_link(back, {{0, 2}}, s(109));
      CHECK(ordered.mission.under_way());
      ordered.mission.watch_link(back, {{0, 2}}, s(114));
      CHECK(ordered.mission.holding());
    }
  }
}

TEST_CASE(
    "mission: where the thrusters were disarmed by nobody's word it is over, and may be started",
    "[high_level][mission]") {
  for (const bool holds : {false, true}) {
    Ordered ordered;
    ordered.give(OperatorOrder::kStart, s(1));
    if (holds) {
      ordered.give(OperatorOrder::kHold, s(2));
    }
    ordered.mission.end_disarmed(s(3));
    CHECK(ordered.state() == MissionState::kAborted);
    CHECK(ordered.mission.status().cause == MissionCause::kDisarmed);
    CHECK(ordered.mission.status().ended == s(3));
    CHECK(ordered.mission.status().aborts == 0);  // nobody has ordered one
    CHECK(ordered.give(OperatorOrder::kResume, s(4)) == OrderAnswer::kNotHolding);
    // A start that was on its way when the fault came.
    ordered.mission.take({{OperatorOrder::kStart, 0}, ++ordered.sequence, s(2.9)}, {}, s(4));
    CHECK(ordered.mission.status().answer == OrderAnswer::kAborted);
    CHECK(ordered.state() == MissionState::kAborted);
    CHECK(ordered.give(OperatorOrder::kStart, s(5)) == OrderAnswer::kObeyed);
    CHECK(ordered.mission.under_way());
    CHECK(ordered.mission.status().cause == MissionCause::kOrder);
  }
}

TEST_CASE("mission: where none is sailed or held, thrusters that are disarmed are no news",
          "[high_level][mission]") {
  Ordered ordered;
  ordered.mission.end_disarmed(s(1));
  CHECK(ordered.state() == MissionState::kIdle);
  ordered.give(OperatorOrder::kStart, s(2));
  ordered.give(OperatorOrder::kAbort, s(3));
  ordered.mission.end_disarmed(s(4));
  CHECK(ordered.mission.status().cause == MissionCause::kOrder);
  CHECK(ordered.mission.status().ended == s(3));
}
