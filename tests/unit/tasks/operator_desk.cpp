// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/operator_desk.h"

#include <nlohmann/json.hpp>

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

using namespace lodesman;
using nlohmann::json;
using std::chrono::milliseconds;

namespace {

// A desk, and a mission that is played by hand: it answers when it is told to.
struct DeskBench {
  DeskBench() { status(MissionState::kUnderWay); }

  void pass(Duration time) { now += time; }
  void status(MissionState state, std::uint64_t aborts = 0, std::uint64_t order = 0,
              OrderAnswer answer = OrderAnswer::kNone) {
    MissionStatus value;
    value.state = state;
    value.aborts = aborts;
    value.order = order;
    value.answer = answer;
    statuses.publish(value, now);
  }
  // The orders on the blackboard that were not looked at before.
  std::vector<OperatorOrder> published() {
    std::vector<OperatorOrder> words;
    while (const auto* order = orders.next()) {
      words.push_back(order->value.order);
    }
    return words;
  }

  Time now{std::chrono::seconds{100}};
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Writer<MissionStatus> statuses{board->mission_status, Role::kHigh, "mission_status"};
  Reader<OperatorCommand> orders{board->operator_command};
  OperatorDesk desk{*board, Role::kHigh, [this] { return now; }};
};

json reply_of(const Answer& answer) {
  const auto text = answer();
  REQUIRE(text);
  return json::parse(*text);
}

using Words = std::vector<OperatorOrder>;

}  // namespace

TEST_CASE("operator desk: an abort is ok once the mission says that it was obeyed",
          "[high_level][tasks]") {
  DeskBench bench;
  const Answer answer = bench.desk.answer("abort");
  CHECK(bench.published() == Words{OperatorOrder::kAbort});
  CHECK_FALSE(answer());
  bench.pass(milliseconds{50});
  bench.status(MissionState::kUnderWay);
  CHECK_FALSE(answer());
  bench.status(MissionState::kAborted, 1);
  CHECK(reply_of(answer) == json{{"ok", true}, {"state", "aborted"}});
}

TEST_CASE("operator desk: an abort that nobody obeys is not confirmed", "[high_level][tasks]") {
  DeskBench bench;
  const Answer answer = bench.desk.answer("abort");
  bench.pass(kOrderPatience);
  CHECK_FALSE(answer());
  bench.pass(milliseconds{1});
  const json said = reply_of(answer);
  CHECK(said["ok"] == false);
  CHECK(said["confirmed"] == false);
  CHECK(said["error"] == "not confirmed: the mission does not answer");
}

TEST_CASE("operator desk: the state alone confirms no abort", "[high_level][tasks]") {
  DeskBench bench;
  bench.status(MissionState::kAborted, 0);  // of an earlier one
  const Answer first = bench.desk.answer("abort");
  CHECK_FALSE(first());
  bench.status(MissionState::kAborted, 1);
  CHECK(reply_of(first)["ok"] == true);
  const Answer second = bench.desk.answer("abort");
  CHECK_FALSE(second());
  bench.status(MissionState::kUnderWay, 2);  // obeyed, and started again since
  CHECK(reply_of(second)["ok"] == true);
}

TEST_CASE("operator desk: many aborts are one until it is obeyed, and none is lost",
          "[high_level][tasks]") {
  DeskBench bench;
  std::vector<Answer> answers;
  for (int i = 0; i < 1000; ++i) {
    answers.push_back(bench.desk.answer("abort"));
  }
  CHECK(bench.published() == Words{OperatorOrder::kAbort});
  bench.status(MissionState::kAborted, 1);
  for (const Answer& answer : answers) {
    CHECK(reply_of(answer)["ok"] == true);
  }
  CHECK_FALSE(bench.desk.answer("abort")());
  CHECK(bench.published() == Words{OperatorOrder::kAbort});
}

TEST_CASE("operator desk: an order is answered with what the mission made of it",
          "[high_level][tasks]") {
  DeskBench bench;
  const Answer hold = bench.desk.answer("hold");
  CHECK_FALSE(hold());
  CHECK(bench.published() == Words{OperatorOrder::kHold});
  bench.status(MissionState::kHolding, 0, 1, OrderAnswer::kObeyed);
  CHECK(reply_of(hold) == json{{"ok", true}, {"state", "holding"}});
  const Answer resume = bench.desk.answer("resume");
  CHECK_FALSE(resume());
  bench.status(MissionState::kReached, 0, 2, OrderAnswer::kNotHolding);
  CHECK(reply_of(resume) == json{{"ok", false}, {"error", "not holding but reached"}});
}

TEST_CASE("operator desk: what changes nothing or cannot be is answered without an order",
          "[high_level][tasks]") {
  DeskBench bench;
  CHECK(reply_of(bench.desk.answer("resume"))["error"] == "not holding but under_way");
  CHECK(reply_of(bench.desk.answer("start")) == json{{"ok", true}, {"state", "under_way"}});
  bench.status(MissionState::kIdle);
  CHECK(reply_of(bench.desk.answer("hold"))["error"] == "not under way but idle");
  CHECK(reply_of(bench.desk.answer("dance"))["error"] == "unknown command: dance");
  CHECK(bench.published().empty());
}

TEST_CASE("operator desk: orders go one at a time, the same word together", "[high_level][tasks]") {
  DeskBench bench;
  const Answer hold = bench.desk.answer("hold");
  const Answer hold_too = bench.desk.answer("hold");
  const Answer resume = bench.desk.answer("resume");
  CHECK_FALSE(hold());
  CHECK_FALSE(resume());
  CHECK_FALSE(hold_too());
  CHECK(bench.published() == Words{OperatorOrder::kHold});
  bench.status(MissionState::kHolding, 0, 1, OrderAnswer::kObeyed);
  CHECK_FALSE(resume());
  CHECK(bench.published() == Words{OperatorOrder::kResume});
  bench.status(MissionState::kUnderWay, 0, 2, OrderAnswer::kObeyed);
  CHECK(reply_of(resume)["state"] == "under_way");
  CHECK(reply_of(hold)["state"] == "holding");
  CHECK(reply_of(hold_too)["state"] == "holding");
}

TEST_CASE("operator desk: an abort goes before every order that waits, and they are refused",
          "[high_level][tasks]") {
  DeskBench bench;
  const Answer hold = bench.desk.answer("hold");
  CHECK_FALSE(hold());
  const Answer resume = bench.desk.answer("resume");
  CHECK_FALSE(resume());
  const Answer abort = bench.desk.answer("abort");
  CHECK(bench.published() == Words{OperatorOrder::kHold, OperatorOrder::kAbort});
  const Answer start = bench.desk.answer("start");
  CHECK(reply_of(start)["error"] == "an abort came first");
  CHECK(reply_of(resume)["error"] == "an abort came first");
  bench.status(MissionState::kAborted, 1, 1, OrderAnswer::kObeyed);
  CHECK(reply_of(abort)["ok"] == true);
  const Answer again = bench.desk.answer("start");
  CHECK_FALSE(again());
  CHECK(bench.published() == Words{OperatorOrder::kStart});
}

TEST_CASE("operator desk: an order to a mission that has fallen silent is not confirmed",
          "[high_level][tasks]") {
  DeskBench bench;
  const Answer published = bench.desk.answer("hold");
  CHECK_FALSE(published());
  bench.pass(max_age::kMissionStatus + milliseconds{1});
  const Answer waiting = bench.desk.answer("hold");
  CHECK_FALSE(waiting());
  CHECK(bench.published() == Words{OperatorOrder::kHold});
  bench.pass(kOrderPatience + milliseconds{1});
  CHECK(reply_of(published)["confirmed"] == false);
  CHECK(reply_of(waiting)["confirmed"] == false);
  bench.status(MissionState::kUnderWay, 0, 0);
  const Answer next = bench.desk.answer("hold");  // the one before it is void
  CHECK_FALSE(next());
  CHECK(bench.published() == Words{OperatorOrder::kHold});
}

TEST_CASE("operator desk: it counts on where the one before it left off", "[high_level][tasks]") {
  const auto board = std::make_unique<Blackboard>();
  Time now{std::chrono::seconds{100}};
  {
    OperatorDesk before{*board, Role::kHigh, [&] { return now; }};
    CHECK_FALSE(before.answer("abort")());
  }
  OperatorDesk desk{*board, Role::kHigh, [&] { return now; }};
  Writer<MissionStatus> statuses{board->mission_status, Role::kHigh, "mission_status"};
  MissionStatus value;
  value.state = MissionState::kAborted;
  value.aborts = 1;
  statuses.publish(value, now);
  CHECK_FALSE(desk.answer("abort")());
  Reader<OperatorCommand> orders{board->operator_command};
  CHECK(orders.latest()->value.aborts == 2);
  CHECK_THROWS_AS((OperatorDesk{*board, Role::kHigh, [&] { return now; }}), StartupError);
}

TEST_CASE("operator desk: the status says the protocol and what is known", "[high_level][tasks]") {
  DeskBench bench;
  const json said = reply_of(bench.desk.answer("status"));
  CHECK(said["ok"] == true);
  CHECK(said["protocol"] == kCommandProtocol);
  CHECK(said["state"] == "under_way");
  CHECK_FALSE(said.contains("position_m"));
  CHECK(bench.published().empty());
}
