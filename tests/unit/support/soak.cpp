// SPDX-License-Identifier: Apache-2.0
// What measure_soak sails and what it judges by.
#include <cmath>
#include <memory>
#include <set>

#include "hal_sim/scenario/fault_table.h"
#include "tests/measure/soak_judge.h"
#include "tests/measure/soak_voyage.h"
#include "tests/support/catch.h"

namespace lodesman::measure {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t kDay = 576;  // legs

[[nodiscard]] SoakVoyage voyage_of_seed(std::uint64_t seed) {
  return make_soak_voyage(seed, kDay, SpeedTable::proportional(0.01));
}

// A boat under way that stands still, and says what the test lets it say.
class StandingBoat {
 public:
  StandingBoat() { mission.state = MissionState::kUnderWay; }

  // A leg of half a minute and a little.
  [[nodiscard]] LegOutcome stand() {
    begin();
    wait(seconds{31});
    return end();
  }
  void begin() { judge_.begin_leg(now_); }
  void wait(Duration duration) {
    for (const Time until = now_ + duration; now_ < until;) {
      now_ += milliseconds{20};
      truth.x_m += truth.surge_m_s * 0.02;
      truth_.publish(truth, now_);
      mission_.publish(mission, now_);
      plan_.publish(plan, now_);
      helm_.publish(helm, now_);
      thrust_.publish(thrust, now_);
      judge_.look(now_);
    }
  }
  [[nodiscard]] LegOutcome end(const std::string& refusal = "") {
    return judge_.end_leg(10.0, 0.0, refusal);
  }

  WorldTruth truth;
  MissionStatus mission;
  Plan plan;
  HelmCommand helm;
  ThrustApplied thrust;

 private:
  std::unique_ptr<Blackboard> board_ = std::make_unique<Blackboard>();
  Writer<WorldTruth> truth_{board_->world_truth, Role::kLow, "world_truth"};
  Writer<MissionStatus> mission_{board_->mission_status, Role::kHigh, "mission_status"};
  Writer<Plan> plan_{board_->plan, Role::kHigh, "plan"};
  Writer<HelmCommand> helm_{board_->helm_command, Role::kHigh, "helm_command"};
  Writer<ThrustApplied> thrust_{board_->thrust_applied, Role::kLow, "thrust_applied"};
  SoakJudge judge_{*board_};
  Time now_{seconds{100}};
};

// Such a boat, which thrusts and steers for a waypoint on its route.
[[nodiscard]] StandingBoat silent_boat() {
  StandingBoat boat;
  boat.truth.inoffensive_distance_m = 5.0;
  boat.truth.hull_clearance_m = 5.0;
  boat.plan.rung = PlanRung::kOnRoute;
  boat.helm.reason = HelmReason::kTracking;
  boat.thrust.reason = ThrustReason::kCommanded;
  return boat;
}

using Reasons = std::vector<std::string>;

// Of a soak that holds.
[[nodiscard]] SoakFigures good_figures() {
  return {0, std::uint64_t{1} << 31U, {3600.0, 50000.0, 6}, {86400.0, 50000.0, 6}};
}

}  // namespace

TEST_CASE("soak: a boat that stands still under way without a word is found out", "[measure]") {
  StandingBoat boat = silent_boat();
  boat.begin();
  boat.wait(seconds{29});
  CHECK(boat.end().stops == 0);
  const LegOutcome leg = boat.stand();
  CHECK(leg.stops == 1);
  CHECK(leg.unsaid == 1);
  CHECK(leg.what == "out of time, under way");
  CHECK(leg.to_go_m == Approx(10.0));
}

TEST_CASE("soak: it stops once more for each half minute, and not where it makes way",
          "[measure]") {
  StandingBoat boat = silent_boat();
  boat.begin();
  boat.wait(seconds{61});
  CHECK(boat.end().stops == 2);
  boat.truth.surge_m_s = 0.05;  // 1.5 m in half a minute
  boat.begin();
  boat.wait(seconds{61});
  CHECK(boat.end().stops == 0);
  boat.truth.surge_m_s = 0.02;  // 0.6 m
  CHECK(boat.stand().stops == 1);
}

TEST_CASE("soak: what the boat says of itself is a reason to stand still", "[measure]") {
  StandingBoat no_way = silent_boat();
  no_way.mission.no_way = NoWayCause::kThrusters;
  StandingBoat failed = silent_boat();
  failed.thrust.reason = ThrustReason::kDeviceFailed;
  StandingBoat stale = silent_boat();
  stale.helm.reason = HelmReason::kStaleState;
  StandingBoat waits = silent_boat();
  waits.plan.rung = PlanRung::kHold;
  for (StandingBoat* boat : {&no_way, &failed, &stale, &waits}) {
    const LegOutcome leg = boat->stand();
    INFO(leg.what);
    CHECK(leg.stops == 1);
    CHECK(leg.unsaid == 0);
    CHECK(leg.what.starts_with("out of time; last said "));
  }
}

TEST_CASE("soak: a reason stands for a while after it was said, and no longer", "[measure]") {
  for (const auto& [ago, unsaid] : {std::pair{seconds{14}, 0U}, std::pair{seconds{16}, 1U}}) {
    StandingBoat boat = silent_boat();
    boat.begin();
    boat.helm.reason = HelmReason::kStaleState;
    boat.wait(seconds{30} - ago);
    boat.helm.reason = HelmReason::kTracking;
    boat.wait(ago + seconds{1});
    const LegOutcome leg = boat.end();
    CHECK(leg.stops == 1);
    CHECK(leg.unsaid == unsaid);
  }
}

TEST_CASE("soak: a reason of the leg before explains nothing of this one", "[measure]") {
  StandingBoat boat = silent_boat();
  boat.helm.reason = HelmReason::kStaleState;
  CHECK(boat.stand().unsaid == 0);
  boat.helm.reason = HelmReason::kTracking;
  const LegOutcome leg = boat.stand();
  CHECK(leg.unsaid == 1);
  CHECK(leg.what == "out of time, under way");
}

TEST_CASE("soak: a boat that has nothing to sail for does not stand still", "[measure]") {
  for (const auto& [state, what] :
       {std::pair{MissionState::kReached, "reached"}, std::pair{MissionState::kHolding, "holding"},
        std::pair{MissionState::kAborted, "aborted"}}) {
    StandingBoat boat = silent_boat();
    boat.mission.state = state;
    const LegOutcome leg = boat.stand();
    CHECK(leg.stops == 0);
    CHECK(leg.unsaid == 0);
    CHECK(leg.what == what);
  }
}

TEST_CASE("soak: a start that was refused is what came of the mission", "[measure]") {
  StandingBoat boat = silent_boat();
  boat.begin();
  boat.wait(seconds{1});
  CHECK(boat.end("not ready: no heading").what == "not started: not ready: no heading");
}

TEST_CASE("soak: one contact is one, however long it lasts", "[measure]") {
  StandingBoat boat = silent_boat();
  CHECK(boat.stand().contacts == 0);
  boat.truth.hull_clearance_m = -0.1;
  CHECK(boat.stand().contacts == 1);
  boat.truth.hull_clearance_m = 1.0;
  CHECK(boat.stand().contacts == 0);
  boat.truth.inoffensive_distance_m = -0.1;
  const LegOutcome leg = boat.stand();
  CHECK(leg.contacts == 1);
  CHECK(leg.contacts_at_rest == 0);
}

TEST_CASE("soak: a contact is the mission's of that very moment, or nobody's", "[measure]") {
  StandingBoat boat = silent_boat();
  boat.begin();
  boat.wait(seconds{1});
  boat.mission.state = MissionState::kReached;
  boat.truth.inoffensive_distance_m = -0.1;
  boat.wait(milliseconds{20});
  LegOutcome leg = boat.end();
  CHECK(leg.contacts == 0);
  CHECK(leg.contacts_at_rest == 1);
  boat.truth.inoffensive_distance_m = 5.0;
  boat.begin();
  boat.wait(milliseconds{20});
  boat.mission.state = MissionState::kUnderWay;
  boat.truth.inoffensive_distance_m = -0.1;
  boat.wait(milliseconds{20});
  leg = boat.end();
  CHECK(leg.contacts == 1);
  CHECK(leg.contacts_at_rest == 0);
}

TEST_CASE("soak: nothing speaks against one that holds, up to its very bounds", "[measure]") {
  SoakFigures figures = good_figures();
  CHECK(objections(figures).empty());
  figures.highest_sequence = (std::uint64_t{1} << 32U) - 1;
  figures.last.resident_kib = figures.settled.resident_kib + 2047.0;
  figures.last.descriptors = figures.settled.descriptors - 1;
  CHECK(objections(figures).empty());
}

TEST_CASE("soak: each thing that must not be is said", "[measure]") {
  SoakFigures silent = good_figures();
  silent.unsaid = 3;
  CHECK(objections(silent) == Reasons{"stood still 3 times without saying why"});
  SoakFigures grown = good_figures();
  grown.last.resident_kib += 2048.0;
  CHECK(objections(grown) == Reasons{"grew by 2048 KiB"});
  SoakFigures open = good_figures();
  open.last.descriptors += 1;
  CHECK(objections(open) == Reasons{"holds 1 descriptors more"});
  SoakFigures counted = good_figures();
  counted.highest_sequence = std::uint64_t{1} << 32U;
  CHECK(objections(counted) == Reasons{"counted as far as 4294967296"});
  counted.unsaid = 1;
  CHECK(objections(counted).size() == 2);
}

TEST_CASE("soak: a seed is a voyage, another seed another", "[measure]") {
  const SoakVoyage one = voyage_of_seed(1);
  const SoakVoyage again = voyage_of_seed(1);
  const SoakVoyage other = voyage_of_seed(2);
  REQUIRE(one.legs.size() == kDay);
  for (std::size_t i = 0; i < kDay; ++i) {
    REQUIRE(mission_text(one.legs[i]) == mission_text(again.legs[i]));
  }
  CHECK(one.scenario.obstacles.size() == again.scenario.obstacles.size());
  CHECK(one.scenario.faults.size() == again.scenario.faults.size());
  CHECK(mission_text(one.legs[0]) != mission_text(other.legs[0]));
}

TEST_CASE("soak: in some days every fault of every device comes, within its own leg", "[measure]") {
  std::set<std::string> seen;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const SoakVoyage voyage = voyage_of_seed(seed);
    for (std::size_t i = 0; i < kDay; ++i) {
      if (const auto& fault = voyage.legs[i].fault) {
        seen.insert(std::string{name_of(fault->device)} + ' ' + std::string{name_of(fault->kind)});
        const double begin_s = static_cast<double>(i) * kLeg_s;
        CHECK(fault->at_s >= begin_s);
        CHECK(fault->at_s + fault->duration_s < begin_s + kLeg_s);
      }
    }
  }
  std::size_t all = 0;
  for (const auto& rows : {fault_rows(), further_fault_rows()}) {
    for (const FaultRow& row : rows) {
      for (const FaultDevice device : {FaultDevice::kAhrs, FaultDevice::kThruster,
                                       FaultDevice::kSonar, FaultDevice::kPosition}) {
        all += row.is_of(device) ? 1U : 0U;
      }
    }
  }
  CHECK(seen.size() == all);
}

TEST_CASE("soak: nothing comes to be where the boat waits for its next mission", "[measure]") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const SoakVoyage voyage = voyage_of_seed(seed);
    CHECK(voyage.scenario.obstacles.size() > kDay / 4);
    for (const MovingObstacle& obstacle : voyage.scenario.obstacles) {
      const auto leg = static_cast<std::size_t>(std::lround(obstacle.appears_at_s / kLeg_s));
      const Goal at = leg == 0 ? Goal{} : voyage.legs[leg - 1].goal;
      const Obstacle then = obstacle.at(obstacle.appears_at_s);
      CHECK(std::hypot(then.centre_x_m - at.x_m, then.centre_y_m - at.y_m) -
                std::max(then.semi_axis_first_m, then.semi_axis_second_m) >=
            3.0);
    }
  }
}

}  // namespace lodesman::measure
