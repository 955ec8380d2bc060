// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/operator_desk.h"

#include <nlohmann/json.hpp>

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

using namespace lodesman;
using nlohmann::json;
using std::chrono::milliseconds;

namespace {

CommandRequest request(const std::string& command, std::uint64_t session = 1) {
  CommandRequest request;
  request.command = command;
  request.scope = Scope::kCommand;
  request.session = session;
  return request;
}

ThrustStatus armed() {
  ThrustStatus status;
  status.state = ThrustState::kArmed;
  return status;
}

DeskOptions with_a_mission() {
  DeskOptions options;
  options.mission.speed_m_s = 0.22;
  options.at_hand = testing::mission_through({{0, 20}});
  return options;
}

// A desk, and a mission that is played by hand: it answers when it is told to.
struct DeskBench {
  DeskBench() {
    status(MissionState::kUnderWay);
    be_ready();
  }

  Answer answer(const std::string& command) { return desk.answer(request(command)); }
  void pass(Duration time) {
    now += time;
    be_ready();
  }
  // All that a start asks for.
  void be_ready() {
    attitudes.publish({now, 0.0, 0.0}, now);
    VehicleState here;
    here.valid_at = now;
    states.publish(here, now);
    const auto seen = std::make_unique<SonarObstacles>();
    seen->captured = now;
    obstacles.publish(*seen, now);
    thrusts.publish({}, now);
    armings.publish(arming, now);
  }
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
  Writer<Attitude> attitudes{board->attitude, Role::kLow, "attitude"};
  Writer<VehicleState> states{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Writer<SonarObstacles> obstacles{board->sonar_obstacles, Role::kLow, "sonar_obstacles"};
  Writer<ThrustApplied> thrusts{board->thrust_applied, Role::kLow, "thrust_applied"};
  Writer<ThrustStatus> armings{board->thrust_status, Role::kLow, "thrust_status"};
  ThrustStatus arming = armed();
  Reader<OperatorCommand> orders{board->operator_command};
  OperatorDesk desk{*board, Role::kHigh, with_a_mission(), [this] { return now; }};
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
  const Answer answer = bench.answer("abort");
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
  const Answer answer = bench.answer("abort");
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
  const Answer first = bench.answer("abort");
  CHECK_FALSE(first());
  bench.status(MissionState::kAborted, 1);
  CHECK(reply_of(first)["ok"] == true);
  const Answer second = bench.answer("abort");
  CHECK_FALSE(second());
  bench.status(MissionState::kUnderWay, 2);  // obeyed, and started again since
  CHECK(reply_of(second)["ok"] == true);
}

TEST_CASE("operator desk: many aborts are one until it is obeyed, and none is lost",
          "[high_level][tasks]") {
  DeskBench bench;
  std::vector<Answer> answers;
  for (int i = 0; i < 1000; ++i) {
    answers.push_back(bench.answer("abort"));
  }
  CHECK(bench.published() == Words{OperatorOrder::kAbort});
  bench.status(MissionState::kAborted, 1);
  for (const Answer& answer : answers) {
    CHECK(reply_of(answer)["ok"] == true);
  }
  CHECK_FALSE(bench.answer("abort")());
  CHECK(bench.published() == Words{OperatorOrder::kAbort});
}

TEST_CASE("operator desk: an order is answered with what the mission made of it",
          "[high_level][tasks]") {
  DeskBench bench;
  const Answer hold = bench.answer("hold");
  CHECK_FALSE(hold());
  CHECK(bench.published() == Words{OperatorOrder::kHold});
  bench.status(MissionState::kHolding, 0, 1, OrderAnswer::kObeyed);
  CHECK(reply_of(hold) == json{{"ok", true}, {"state", "holding"}});
  const Answer resume = bench.answer("resume");
  CHECK_FALSE(resume());
  bench.status(MissionState::kReached, 0, 2, OrderAnswer::kNotHolding);
  CHECK(reply_of(resume) == json{{"ok", false}, {"error", "not holding but reached"}});
}

TEST_CASE("operator desk: what changes nothing or cannot be is answered without an order",
          "[high_level][tasks]") {
  DeskBench bench;
  CHECK(reply_of(bench.answer("resume"))["error"] == "not holding but under_way");
  CHECK(reply_of(bench.answer("start")) == json{{"ok", true}, {"state", "under_way"}});
  bench.status(MissionState::kIdle);
  CHECK(reply_of(bench.answer("hold"))["error"] == "not under way but idle");
  CHECK(reply_of(bench.answer("dance"))["error"] == "unknown command: dance");
  CHECK(bench.published().empty());
}

TEST_CASE("operator desk: orders go one at a time, the same word together", "[high_level][tasks]") {
  DeskBench bench;
  const Answer hold = bench.answer("hold");
  const Answer hold_too = bench.answer("hold");
  const Answer resume = bench.answer("resume");
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
  const Answer hold = bench.answer("hold");
  CHECK_FALSE(hold());
  const Answer resume = bench.answer("resume");
  CHECK_FALSE(resume());
  const Answer abort = bench.answer("abort");
  CHECK(bench.published() == Words{OperatorOrder::kHold, OperatorOrder::kAbort});
  const Answer start = bench.answer("start");
  CHECK(reply_of(start)["error"] == "an abort came first");
  CHECK(reply_of(resume)["error"] == "an abort came first");
  bench.status(MissionState::kAborted, 1, 1, OrderAnswer::kObeyed);
  CHECK(reply_of(abort)["ok"] == true);
  const Answer again = bench.answer("start");
  CHECK_FALSE(again());
  CHECK(bench.published() == Words{OperatorOrder::kStart});
}

TEST_CASE("operator desk: an order to a mission that has fallen silent is not confirmed",
          "[high_level][tasks]") {
  DeskBench bench;
  const Answer published = bench.answer("hold");
  CHECK_FALSE(published());
  bench.pass(max_age::kMissionStatus + milliseconds{1});
  const Answer waiting = bench.answer("hold");
  CHECK_FALSE(waiting());
  CHECK(bench.published() == Words{OperatorOrder::kHold});
  bench.pass(kOrderPatience + milliseconds{1});
  CHECK(reply_of(published)["confirmed"] == false);
  CHECK(reply_of(waiting)["confirmed"] == false);
  bench.status(MissionState::kUnderWay, 0, 0);
  const Answer next = bench.answer("hold");  // the one before it is void
  CHECK_FALSE(next());
  CHECK(bench.published() == Words{OperatorOrder::kHold});
}

TEST_CASE("operator desk: it counts on where the one before it left off", "[high_level][tasks]") {
  const auto board = std::make_unique<Blackboard>();
  Time now{std::chrono::seconds{100}};
  {
    OperatorDesk before{*board, Role::kHigh, DeskOptions{}, [&] { return now; }};
    CHECK_FALSE(before.answer(request("abort"))());
  }
  OperatorDesk desk{*board, Role::kHigh, DeskOptions{}, [&] { return now; }};
  Writer<MissionStatus> statuses{board->mission_status, Role::kHigh, "mission_status"};
  MissionStatus value;
  value.state = MissionState::kAborted;
  value.aborts = 1;
  statuses.publish(value, now);
  CHECK_FALSE(desk.answer(request("abort"))());
  Reader<OperatorCommand> orders{board->operator_command};
  CHECK(orders.latest()->value.aborts == 2);
  CHECK_THROWS_AS((OperatorDesk{*board, Role::kHigh, DeskOptions{}, [&] { return now; }}),
                  StartupError);
}

TEST_CASE("operator desk: the status says the protocol and what is known", "[high_level][tasks]") {
  DeskBench bench;
  const json said = reply_of(bench.answer("status"));
  CHECK(said["ok"] == true);
  CHECK(said["protocol"] == kCommandProtocol);
  CHECK(said["state"] == "under_way");
  CHECK(said["tunables"]["version"] == 1);
  CHECK(bench.published().empty());
}

TEST_CASE("operator desk: a start is refused with every reason while the boat is not ready",
          "[high_level][tasks]") {
  DeskBench bench;
  bench.now += max_age::kVehicleState + milliseconds{1};  // all has gone stale but the sonar
  bench.status(MissionState::kIdle);
  const std::string error = reply_of(bench.answer("start"))["error"];
  CHECK(error.starts_with("not ready: "));
  CHECK(error.find("no heading") != std::string::npos);
  CHECK(error.find("no position") != std::string::npos);
  CHECK(error.find("sonar") == std::string::npos);
  CHECK(bench.published().empty());
}

TEST_CASE("operator desk: a mission in the order is at hand before the order is",
          "[high_level][tasks]") {
  DeskBench bench;
  CommandRequest start = request("start");
  start.mission = "goal_m = [3.0, 4.0]\nspeed_m_s = 0.4\n";
  const Answer answer = bench.desk.answer(start);
  CHECK_FALSE(answer());  // under way already, and yet an order: it is another mission
  CHECK(bench.published() == Words{OperatorOrder::kStart});
  Reader<MissionDefinition> definitions{bench.board->mission_definition};
  CHECK(definitions.latest()->value.goals[0].y_m == Approx(4.0));
  Reader<OperatorCommand> orders{bench.board->operator_command};
  CHECK(orders.latest()->value.mission == definitions.latest()->value.id);
}

TEST_CASE("operator desk: a mission that cannot be is refused with its line",
          "[high_level][tasks]") {
  DeskBench bench;
  const auto refused = [&](const std::string& text) {
    CommandRequest start = request("start");
    start.mission = text;
    return reply_of(bench.desk.answer(start))["error"].get<std::string>();
  };
  CHECK(refused("goal_m = [0, 1]\nspead = 1") == "mission:2: spead: unknown key");
  CHECK(refused("goal_m = [0, 1]\nspeed_m_s = 5.0") ==
        "speed_m_s: no SurgeRef holds it within 3 % (the nearest, 100, gives 1 m/s)");
  CHECK(refused("goal_m = [0, 9]\nkeep_out_m = [[-1, 8], [1, 8], [1, 10], [-1, 10]]") ==
        "goal: lies in a keep-out area");
  CHECK(refused("goal_m = [0, 9]\nkeep_out_m = [[-1, -1], [1, -1], [1, 1], [-1, 1]]") ==
        "not ready: the boat lies in a keep-out area");
  CHECK(bench.published().empty());
}

TEST_CASE("operator desk: a token is good for its scope and what lies below it",
          "[high_level][tasks]") {
  DeskBench bench;
  const auto reply_with = [&](Scope scope, const char* command) {
    CommandRequest asked = request(command);
    asked.scope = scope;
    const auto reply = bench.desk.answer(asked)();
    return reply ? json::parse(*reply).value("error", "") : "";
  };
  CHECK(reply_with(Scope::kView, "status").empty());
  CHECK(reply_with(Scope::kView, "abort") == "this token is not good for abort");
  CHECK(reply_with(Scope::kAbort, "abort").empty());
  for (const char* command : {"start", "hold", "resume", "take", "heartbeat", "release", "tune"}) {
    CHECK(reply_with(Scope::kAbort, command) ==
          std::string{"this token is not good for "} + command);
  }
}

TEST_CASE("operator desk: while one session commands no other orders, but every one aborts",
          "[high_level][tasks]") {
  DeskBench bench;
  CHECK(reply_of(bench.desk.answer(request("take", 1)))["ok"] == true);
  Reader<CommandLink> links{bench.board->command_link};
  CHECK(links.latest()->value.session == 1);
  CHECK(reply_of(bench.desk.answer(request("hold", 2)))["ok"] == false);
  CHECK(reply_of(bench.desk.answer(request("tune", 2)))["ok"] == false);
  CHECK_FALSE(bench.desk.answer(request("abort", 2))());
  CHECK(bench.published() == Words{OperatorOrder::kAbort});
  CHECK(reply_of(bench.desk.answer(request("release", 1)))["ok"] == true);
  CHECK(links.latest()->value.session == 0);
}

TEST_CASE("operator desk: what guards the boat is not tuned, and the rest within its range",
          "[high_level][tasks]") {
  DeskBench bench;
  const auto tuned = [&](const char* key, double value) {
    CommandRequest tune = request("tune");
    tune.set[key] = value;
    return reply_of(bench.desk.answer(tune));
  };
  Reader<Tunables> tunables{bench.board->tunables};
  CHECK(tunables.latest()->value.version == 1);
  CHECK(tuned("zones.least_margin_m", 0.1)["error"] ==
        "zones.least_margin_m: may not be changed under way");
  CHECK(tuned("mission.speed_limit_m_s", 0.0)["ok"] == false);
  CHECK(tunables.latest()->value.version == 1);
  CHECK(tuned("mission.speed_limit_m_s", 0.5)["tunables"]["version"] == 2);
  CHECK(tunables.latest()->value.speed_limit_m_s == Approx(0.5));
}

TEST_CASE("operator desk: it starts by itself once the boat is ready, and not after an abort",
          "[high_level][tasks]") {
  for (const bool aborted : {false, true}) {
    Time now{std::chrono::seconds{100}};
    const auto board = std::make_unique<Blackboard>();
    DeskOptions options = with_a_mission();
    options.starts_by_itself = options.arms_by_itself = true;
    OperatorDesk desk{*board, Role::kHigh, options, [&] { return now; }};
    Writer<MissionStatus> statuses{board->mission_status, Role::kHigh, "mission_status"};
    Reader<OperatorCommand> orders{board->operator_command};
    desk.look();
    CHECK(orders.latest() == nullptr);  // the mission has not spoken
    MissionStatus idle;
    idle.state = aborted ? MissionState::kAborted : MissionState::kIdle;
    statuses.publish(idle, now);
    desk.look();
    CHECK(orders.latest() == nullptr);  // nothing is ready
    Writer<Attitude>{board->attitude, Role::kLow, "a"}.publish({now, 0.0, 0.0}, now);
    VehicleState here;
    here.valid_at = now;
    Writer<VehicleState>{board->vehicle_state, Role::kHigh, "s"}.publish(here, now);
    const auto seen = std::make_unique<SonarObstacles>();
    seen->captured = now;
    Writer<SonarObstacles>{board->sonar_obstacles, Role::kLow, "o"}.publish(*seen, now);
    Writer<ThrustApplied>{board->thrust_applied, Role::kLow, "t"}.publish({}, now);
    desk.look();
    CHECK(orders.latest() == nullptr);  // nobody tells whether there will be thrust
    Writer<ThrustStatus>{board->thrust_status, Role::kLow, "u"}.publish({}, now);
    desk.look();
    CHECK((Reader<ThrustOrder>{board->thrust_order}.latest() != nullptr) == !aborted);  // arms
    CHECK((orders.latest() != nullptr) == !aborted);
  }
}
