// SPDX-License-Identifier: Apache-2.0
// What the operator's desk refuses a mission for, as the boat cannot sail it.
#include <nlohmann/json.hpp>

#include "high_level/tasks/operator_desk.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

using nlohmann::json;

[[nodiscard]] std::string refusal_of(const std::string& mission, bool plans_in_world) {
  const auto board = std::make_unique<Blackboard>();
  DeskOptions options;
  options.plans_in_world = plans_in_world;
  options.mission.speed_m_s = 0.22;
  OperatorDesk desk{*board, Role::kHigh, options, [] { return kStart; }};
  CommandRequest request;
  request.command = "start";
  request.scope = Scope::kCommand;
  request.session = 1;
  request.mission = "goal_m = [0.0, 10.0]\n" + mission;
  const auto text = desk.answer(request)();
  REQUIRE(text);
  return json::parse(*text)["error"];
}

TEST_CASE("operator desk: what the paper's planner knows nothing of is refused",
          "[high_level][tasks]") {
  const std::string fence = "fence_m = [[-5.0, -5.0], [5.0, -5.0], [5.0, 15.0], [-5.0, 15.0]]";
  CHECK(refusal_of(fence, false) ==
        "fence_m, keep_out_m: the paper's planner knows none (planner.space)");
  CHECK(refusal_of("legs = \"line\"", false) ==
        "legs: the paper's planner keeps to no line (planner.space)");
  for (const auto& mission : {fence, std::string{"legs = \"line\""}}) {
    CHECK(refusal_of(mission, true).starts_with("not ready: "));
  }
  CHECK(refusal_of("legs = \"free\"", false).starts_with("not ready: "));
}

}  // namespace
}  // namespace lodesman::testing
