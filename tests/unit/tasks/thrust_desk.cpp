// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/thrust_desk.h"

#include <nlohmann/json.hpp>

#include "tests/support/catch.h"

using namespace lodesman;
using nlohmann::json;
using std::chrono::milliseconds;

namespace {

// A desk, and a thruster task that is played by hand.
struct ThrustBench {
  explicit ThrustBench(bool arms_by_itself = false)
      : desk{*board, Role::kHigh, arms_by_itself, [this] { return now; }} {
    tell({});
  }

  CommandRequest word(const std::string& command) {
    CommandRequest request;
    request.command = command;
    return request;
  }
  void tell(ThrustStatus status) { statuses.publish(last = status, now); }
  // The thruster task takes up what is newest.
  void answer(ThrustState state, ThrustAnswer answer, std::uint32_t refused_for = 0) {
    now += milliseconds{1};
    last.state = state;
    last.answer = answer;
    last.refused_for = refused_for;
    last.order = orders.latest()->sequence;
    last.stops = orders.latest()->value.stops;
    tell(last);
  }
  std::vector<ThrustOrderKind> given() {
    std::vector<ThrustOrderKind> kinds;
    while (const auto* order = read.next()) {
      kinds.push_back(order->value.order);
    }
    return kinds;
  }

  Time now{std::chrono::seconds{100}};
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Writer<ThrustStatus> statuses{board->thrust_status, Role::kLow, "thrust_status"};
  Writer<MissionStatus> missions{board->mission_status, Role::kHigh, "mission_status"};
  Reader<ThrustOrder> orders{board->thrust_order};
  Reader<ThrustOrder> read{board->thrust_order};
  Reader<ManualInput> stick{board->manual_input};
  ThrustStatus last;
  ThrustDesk desk;
};

using Kinds = std::vector<ThrustOrderKind>;

json reply_of(const Answer& answer) {
  const auto text = answer();
  REQUIRE(text);
  return json::parse(*text);
}

}  // namespace

TEST_CASE("thrust desk: armed once the thruster task says so", "[high_level][tasks]") {
  ThrustBench bench;
  const Answer answer = bench.desk.order(bench.word("arm"));
  CHECK_FALSE(answer());
  CHECK(bench.given() == Kinds{ThrustOrderKind::kArm});
  CHECK_FALSE(answer());
  bench.answer(ThrustState::kArmed, ThrustAnswer::kObeyed);
  CHECK(reply_of(answer) == json{{"ok", true}, {"state", "armed"}});
  CHECK(bench.desk.is_armed());
}

TEST_CASE("thrust desk: a refusal gives every reason in words", "[high_level][tasks]") {
  ThrustBench bench;
  DeviceHealth health;
  health.fault = DeviceFault::kNoTimeOut;
  Writer<DeviceHealth>{bench.board->device_health[3], Role::kLow, "thruster_device"}.publish(
      health, bench.now);
  const Answer answer = bench.desk.order(bench.word("arm"));
  CHECK_FALSE(answer());
  bench.answer(ThrustState::kDisarmed, ThrustAnswer::kRefused,
               bit(ArmObjection::kBoxNotReady) | bit(ArmObjection::kHelmNotAtRest));
  const json reply = reply_of(answer);
  CHECK(reply["ok"] == false);
  CHECK(reply["error"] ==
        "the thruster box is not ready: it does not stop by itself: set its serial time-out to "
        "0.5 s; the helm asks for thrust already (lodesman abort)");
}

TEST_CASE("thrust desk: a stop is given at once, whatever waits, and that is refused",
          "[high_level][tasks]") {
  ThrustBench bench;
  const Answer arm = bench.desk.order(bench.word("arm"));
  CHECK_FALSE(arm());
  const Answer stop = bench.desk.order(bench.word("estop"));
  CHECK(bench.given() == Kinds{ThrustOrderKind::kArm, ThrustOrderKind::kStop});
  bench.answer(ThrustState::kStopped, ThrustAnswer::kObeyed);
  CHECK(reply_of(stop) == json{{"ok", true}, {"state", "stopped"}});
  CHECK(reply_of(arm)["error"] == "a stop came first");
  CommandRequest release = bench.word("estop");
  release.release = true;
  const Answer released = bench.desk.order(release);
  CHECK_FALSE(released());
  CHECK(bench.given() == Kinds{ThrustOrderKind::kRelease});
  bench.answer(ThrustState::kDisarmed, ThrustAnswer::kObeyed);
  CHECK(reply_of(released)["state"] == "disarmed");
}

TEST_CASE("thrust desk: nobody answers: not confirmed", "[high_level][tasks]") {
  ThrustBench bench;
  const Answer stop = bench.desk.order(bench.word("estop"));
  bench.now += std::chrono::seconds{3};
  CHECK(reply_of(stop)["confirmed"] == false);
}

TEST_CASE("thrust desk: stops are counted on from a desk that was there before",
          "[high_level][tasks]") {
  ThrustBench bench;
  (void)bench.desk.order(bench.word("estop"));
  CHECK(bench.orders.latest()->value.stops == 1);
  bench.answer(ThrustState::kStopped, ThrustAnswer::kObeyed);
  (void)bench.desk.order(bench.word("estop"));
  CHECK(bench.orders.latest()->value.stops == 2);
}

TEST_CASE("thrust desk: the stick moves what is armed and nothing else", "[high_level][tasks]") {
  ThrustBench bench;
  CommandRequest word = bench.word("manual");
  word.surge_ref = 30;
  word.head_ref = -20;
  CHECK(bench.desk.move_stick(word) == "the thrusters are disarmed");
  CHECK(bench.stick.latest() == nullptr);
  ThrustStatus armed;
  armed.state = ThrustState::kArmed;
  armed.armed = bench.now;
  bench.tell(armed);
  CHECK_FALSE(bench.desk.move_stick(word));
  CHECK(bench.stick.latest()->value.surge_ref == 30);
  CHECK(bench.stick.latest()->value.head_ref == -20);
  CHECK_FALSE(bench.stick.latest()->value.overrides_guard);
  word.overrides_guard = true;
  CHECK_FALSE(bench.desk.move_stick(word));
  CHECK(bench.stick.latest()->value.overrides_guard);
  MissionStatus aborted;
  aborted.state = MissionState::kAborted;
  aborted.ended = bench.now;
  bench.missions.publish(aborted, bench.now);
  CHECK(bench.desk.move_stick(word) == "an abort stands: arm again first");
  armed.armed = bench.now + milliseconds{1};
  bench.now += milliseconds{1};
  bench.tell(armed);
  CHECK_FALSE(bench.desk.move_stick(word));
  bench.now += std::chrono::seconds{1};
  CHECK(bench.desk.move_stick(word) == "the low level is silent");
}

TEST_CASE("thrust desk: arming for a mission is tried again where the reason is over at once",
          "[high_level][tasks]") {
  ThrustBench bench{true};
  const Time given = bench.now;
  bench.desk.make_way();
  CHECK(bench.given() == Kinds{ThrustOrderKind::kArm});
  bench.desk.look();
  CHECK(bench.given().empty());  // not answered yet
  ThrustStatus silent;
  silent.objections = bit(ArmObjection::kHighSilent);
  bench.tell(silent);
  bench.answer(ThrustState::kDisarmed, ThrustAnswer::kRefused, silent.objections);
  bench.desk.look();
  CHECK(bench.given().empty());  // the reason stands
  bench.tell([&] {
    ThrustStatus heard = bench.last;
    heard.objections = bit(ArmObjection::kHelmNotAtRest);
    return heard;
  }());
  bench.desk.look();
  CHECK(bench.orders.latest()->stamp == given);
  CHECK(bench.given() == Kinds{ThrustOrderKind::kArm});
  SECTION("until it is armed") {
    bench.answer(ThrustState::kArmed, ThrustAnswer::kObeyed);
    bench.desk.look();
    bench.answer(ThrustState::kDisarmed, ThrustAnswer::kObeyed);
  }
  SECTION("not after a stop") {
    (void)bench.desk.order(bench.word("estop"));
    CHECK(bench.given() == Kinds{ThrustOrderKind::kStop});
    bench.answer(ThrustState::kStopped, ThrustAnswer::kObeyed);
  }
  SECTION("not for ever") {
    bench.now += std::chrono::seconds{3};
    bench.answer(ThrustState::kDisarmed, ThrustAnswer::kRefused);
  }
  bench.desk.look();
  CHECK(bench.given().empty());
}

TEST_CASE("thrust desk: what makes way for a mission", "[high_level][tasks]") {
  for (const bool arms_by_itself : {false, true}) {
    ThrustBench bench{arms_by_itself};
    bench.desk.make_way();
    CHECK(bench.given() == (arms_by_itself ? Kinds{ThrustOrderKind::kArm} : Kinds{}));
    ThrustStatus status;
    status.objections = bit(ArmObjection::kBoxGone);
    bench.tell(status);
    bench.desk.make_way();
    status = {};
    status.state = ThrustState::kStopped;
    bench.tell(status);
    bench.desk.make_way();
    CHECK(bench.given().empty());
    status.state = ThrustState::kManual;
    bench.tell(status);
    bench.desk.make_way();
    CHECK(bench.given() == Kinds{ThrustOrderKind::kToMission});
  }
}
