// SPDX-License-Identifier: Apache-2.0
// The operator's desk where the first fixes are the origin of the world.
#include <nlohmann/json.hpp>

#include "high_level/tasks/operator_desk.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

using nlohmann::json;

// Of a boat that is not ready for anything else: what a start is refused for comes in order.
struct DeskAfloat {
  [[nodiscard]] json ask(const std::string& command, const std::string& mission = "") {
    CommandRequest request;
    request.command = command;
    request.scope = Scope::kCommand;
    request.session = 1;
    if (!mission.empty()) {
      request.mission = mission;
    }
    const auto text = desk.answer(request)();
    REQUIRE(text);
    return json::parse(*text);
  }
  // A goal 111.2 m north of (48, 7), and a fence about such a place in metres.
  [[nodiscard]] std::string refusal_of_goal_in(double south_m, double north_m) {
    const std::string south = std::to_string(south_m);
    const std::string north = std::to_string(north_m);
    return ask("start", "goal_deg = [48.001, 7.0]\nfence_m = [[-5.0, " + south + "], [5.0, " +
                            south + "], [5.0, " + north + "], [-5.0, " + north + "]]")["error"];
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  DeskOptions options = [] {
    DeskOptions afloat;
    afloat.mission.speed_m_s = 0.22;
    return afloat;
  }();
  OperatorDesk desk{*board, Role::kHigh, options, [] { return kStart; }};
};

TEST_CASE("operator desk: where the first fixes are the origin, places of the earth wait for it",
          "[high_level][tasks]") {
  DeskAfloat afloat;
  CHECK(afloat.ask("status")["origin"].is_null());
  CHECK(afloat.refusal_of_goal_in(111.0, 111.5) ==
        "mission:1: goal_deg: the origin of the boat's world is not fixed yet: no good fix has "
        "come");
  const WorldOrigin origin{48.0, 7.0, OriginSource::kFirstFix, 1.0, kStart};
  Writer<WorldOrigin>{afloat.board->world_origin, Role::kHigh, "world_origin"}.publish(origin,
                                                                                       kStart);
  CHECK(afloat.refusal_of_goal_in(111.0, 111.5).starts_with("not ready: "));
  CHECK(afloat.refusal_of_goal_in(112.0, 113.0) == "goal: lies outside the fence");
  CHECK(afloat.ask("status")["origin"] == json{{"deg", {48.0, 7.0}}, {"by", "first_fix"}});
}

TEST_CASE("operator desk: an origin that is set is taken as it is", "[high_level][tasks]") {
  const auto board = std::make_unique<Blackboard>();
  DeskOptions options;
  options.origin = GeoPoint{35.0, 139.0};
  OperatorDesk desk{*board, Role::kHigh, options, [] { return kStart; }};
  CommandRequest request;
  request.command = "start";
  request.scope = Scope::kCommand;
  request.mission = "goal_deg = [35.001, 139.0]\nspeed_m_s = 0.22";
  const auto text = desk.answer(request)();
  REQUIRE(text);
  CHECK(std::string{json::parse(*text)["error"]}.starts_with("not ready: "));
}

}  // namespace
}  // namespace lodesman::testing
