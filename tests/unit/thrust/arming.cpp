// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/arming.h"

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr Time kStart{seconds{100}};

// A boat with nothing against arming, and orders that come one after the other.
struct Bench {
  Arming arming;
  ArmingView view;
  Time now = kStart;
  std::uint64_t sequence = 0;
  std::uint64_t stops = 0;

  Bench() {
    view.box = ArmingView::Box::kReady;
    view.high_is_heard = true;
    look();
  }
  void look() { arming.look(view, now); }
  void pass(Duration span) {
    now += span;
    look();
  }
  ThrustAnswer give(ThrustOrderKind order) {
    stops += order == ThrustOrderKind::kStop ? 1U : 0U;
    arming.obey({order, stops}, ++sequence, now, now);
    CHECK(arming.status().order == sequence);
    return arming.status().answer;
  }
  void speak() {
    now += milliseconds{1};
    view.stick = now;
    look();
  }
  [[nodiscard]] ThrustState state() const { return arming.status().state; }
};

}  // namespace

TEST_CASE("arming: disarmed at power-up, armed by a word, disarmed by another", "[thrust]") {
  Bench bench;
  CHECK(bench.state() == ThrustState::kDisarmed);
  CHECK(bench.arming.status().cause == ThrustCause::kPowerUp);
  CHECK(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
  CHECK(bench.state() == ThrustState::kArmed);
  CHECK(bench.arming.status().armed == bench.now);
  CHECK(bench.give(ThrustOrderKind::kDisarm) == ThrustAnswer::kObeyed);
  CHECK(bench.state() == ThrustState::kDisarmed);
}

TEST_CASE("arming: a refusal lists every reason at once", "[thrust]") {
  Bench bench;
  CHECK(bench.arming.status().objections == 0);
  bench.view.box = ArmingView::Box::kNotReady;
  bench.view.high_is_heard = false;
  bench.view.helm_asks = bench.now;
  bench.view.stick_is_at_rest = false;
  bench.view.battery_is_critical = true;
  bench.look();
  CHECK(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kRefused);
  CHECK(bench.state() == ThrustState::kDisarmed);
  const std::uint32_t all = bit(ArmObjection::kBoxNotReady) | bit(ArmObjection::kHighSilent) |
                            bit(ArmObjection::kHelmNotAtRest) | bit(ArmObjection::kStickNotAtRest) |
                            bit(ArmObjection::kBatteryCritical);
  CHECK(bench.arming.status().refused_for == all);
  bench.view.box = ArmingView::Box::kGone;
  bench.look();
  CHECK((bench.arming.status().objections & bit(ArmObjection::kBoxGone)) != 0);
  bench.view = {};
  bench.look();
  CHECK((bench.arming.status().objections & bit(ArmObjection::kNoThrusters)) != 0);
}

TEST_CASE("T13: it is not armed while helm or stick ask for thrust", "[thrust]") {
  Bench bench;
  bench.view.helm_asks = bench.now;
  bench.look();
  CHECK(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kRefused);
  bench.view.helm_asks = Time{};
  bench.look();
  CHECK(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
}

// A start gives both words; where the thruster task comes to its turn late, the helm moves already.
TEST_CASE("arming: an order given before the helm began to ask is obeyed after it has",
          "[thrust]") {
  Bench bench;
  const Time given = bench.now;
  bench.pass(milliseconds{20});
  bench.view.helm_asks = bench.now;
  bench.pass(milliseconds{20});
  CHECK(bench.arming.status().objections == bit(ArmObjection::kHelmNotAtRest));
  bench.arming.obey({ThrustOrderKind::kArm, 0}, 1, given, bench.now);
  CHECK(bench.arming.status().answer == ThrustAnswer::kObeyed);
  CHECK(bench.state() == ThrustState::kArmed);
}

TEST_CASE("T14: an emergency stop stands until it is released, and then it has to be armed anew",
          "[thrust]") {
  Bench bench;
  REQUIRE(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
  CHECK(bench.give(ThrustOrderKind::kStop) == ThrustAnswer::kObeyed);
  CHECK(bench.state() == ThrustState::kStopped);
  CHECK(bench.arming.status().stops == 1);
  CHECK(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kRefused);
  CHECK(bench.arming.status().refused_for == bit(ArmObjection::kStopped));
  CHECK(bench.give(ThrustOrderKind::kDisarm) == ThrustAnswer::kObeyed);
  CHECK(bench.state() == ThrustState::kStopped);
  bench.speak();
  CHECK(bench.state() == ThrustState::kStopped);
  CHECK(bench.give(ThrustOrderKind::kRelease) == ThrustAnswer::kObeyed);
  CHECK(bench.state() == ThrustState::kDisarmed);
  CHECK(bench.give(ThrustOrderKind::kRelease) == ThrustAnswer::kNotStopped);
  CHECK(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
}

TEST_CASE(
    "arming: a stop counts though its own publication was lost, and wins over what stands "
    "beside it",
    "[thrust]") {
  Bench bench;
  REQUIRE(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
  bench.arming.obey({ThrustOrderKind::kArm, 1}, ++bench.sequence, bench.now, bench.now);
  CHECK(bench.state() == ThrustState::kStopped);
  CHECK(bench.arming.status().answer == ThrustAnswer::kStopCame);
  bench.arming.obey({ThrustOrderKind::kRelease, 2}, ++bench.sequence, bench.now, bench.now);
  CHECK(bench.state() == ThrustState::kStopped);
  // One that was given before a stop that was obeyed meanwhile.
  bench.arming.obey({ThrustOrderKind::kRelease, 1}, ++bench.sequence, bench.now, bench.now);
  CHECK(bench.state() == ThrustState::kStopped);
  CHECK(bench.arming.status().answer == ThrustAnswer::kStopCame);
}

TEST_CASE("arming: an old order is void, but for the one that makes safe", "[thrust]") {
  Bench bench;
  const Time given = bench.now;
  bench.pass(kThrustOrderPatience + milliseconds{1});
  bench.arming.obey({ThrustOrderKind::kArm, 0}, 1, given, bench.now);
  CHECK(bench.arming.status().answer == ThrustAnswer::kTooOld);
  CHECK(bench.state() == ThrustState::kDisarmed);
  bench.sequence = 1;
  REQUIRE(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
  const Time again = bench.now;
  bench.pass(seconds{10});
  bench.arming.obey({ThrustOrderKind::kDisarm, 0}, 3, again, bench.now);
  CHECK(bench.state() == ThrustState::kDisarmed);
}

TEST_CASE("arming: the stick takes the thrust, and gives it back by a word alone", "[thrust]") {
  Bench bench;
  bench.speak();
  CHECK(bench.state() == ThrustState::kDisarmed);
  REQUIRE(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
  bench.look();
  CHECK(bench.state() == ThrustState::kArmed);  // what it said before is never used
  bench.speak();
  CHECK(bench.state() == ThrustState::kManual);
  bench.view.stick = Time{};
  bench.pass(seconds{60});
  CHECK(bench.state() == ThrustState::kManual);
  CHECK(bench.give(ThrustOrderKind::kToMission) == ThrustAnswer::kObeyed);
  CHECK(bench.state() == ThrustState::kArmed);
  REQUIRE(bench.give(ThrustOrderKind::kDisarm) == ThrustAnswer::kObeyed);
  CHECK(bench.give(ThrustOrderKind::kToMission) == ThrustAnswer::kNotArmed);
}

TEST_CASE("arming: an abort ends manual, until somebody arms again", "[thrust]") {
  Bench bench;
  REQUIRE(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
  bench.speak();
  REQUIRE(bench.state() == ThrustState::kManual);
  bench.now += milliseconds{1};
  bench.view.aborted = bench.now;
  bench.look();
  CHECK(bench.state() == ThrustState::kArmed);
  CHECK(bench.arming.status().cause == ThrustCause::kAbort);
  bench.speak();
  CHECK(bench.state() == ThrustState::kArmed);
  bench.pass(milliseconds{1});
  REQUIRE(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
  bench.speak();
  CHECK(bench.state() == ThrustState::kManual);
}

TEST_CASE("arming: a box that is back soon goes on, one that is not has to be armed anew",
          "[thrust]") {
  for (const auto box : {ArmingView::Box::kGone, ArmingView::Box::kNotReady}) {
    const Duration memory =
        kArmedMemory + (box == ArmingView::Box::kNotReady ? kBoxTrial_max : Duration::zero());
    Bench bench;
    REQUIRE(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
    bench.view.box = box;
    bench.pass(memory);
    CHECK(bench.state() == ThrustState::kArmed);
    bench.view.box = ArmingView::Box::kReady;
    bench.pass(milliseconds{50});
    bench.view.box = box;
    bench.pass(memory);
    CHECK(bench.state() == ThrustState::kArmed);
    bench.pass(milliseconds{1});
    CHECK(bench.state() == ThrustState::kDisarmed);
    CHECK(bench.arming.status().cause == ThrustCause::kBoxLost);
  }
}

TEST_CASE("arming: one that comes after remembers for a while", "[thrust]") {
  ThrustStatus before;
  before.state = ThrustState::kArmed;
  before.armed = kStart - seconds{60};
  before.order = 7;
  before.stops = 2;
  const auto after = [&](std::uint64_t stops_ordered, Duration age) {
    Arming arming;
    arming.remember(before, stops_ordered, age, kStart);
    CHECK(arming.status().order == 7);
    return arming.status();
  };
  CHECK(after(2, kArmedMemory).state == ThrustState::kArmed);
  CHECK(after(2, kArmedMemory).cause == ThrustCause::kRemembered);
  CHECK(after(2, kArmedMemory + Duration{1}).state == ThrustState::kDisarmed);
  CHECK(after(3, Duration{1}).state == ThrustState::kStopped);  // ordered while nobody was there
  CHECK(after(3, Duration{1}).stops == 3);
  before.state = ThrustState::kManual;
  CHECK(after(2, seconds{1}).state == ThrustState::kManual);
  before.state = ThrustState::kDisarmed;
  CHECK(after(2, seconds{1}).state == ThrustState::kDisarmed);
  before.state = ThrustState::kStopped;
  CHECK(after(2, seconds{1000}).state == ThrustState::kStopped);
}

TEST_CASE("arming: a latched stop is one", "[thrust]") {
  Bench bench;
  bench.arming.latch(bench.now);
  CHECK(bench.state() == ThrustState::kStopped);
  CHECK(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kRefused);
  CHECK(bench.give(ThrustOrderKind::kRelease) == ThrustAnswer::kObeyed);
  CHECK(bench.give(ThrustOrderKind::kArm) == ThrustAnswer::kObeyed);
}
