// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/any_angle.h"

#include <string>
#include <vector>

#include "deploy/operator/bench/plan_answers.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using cli::AnyAnglePlanner;

[[nodiscard]] cli::FrameQuery query_to(PathPixel goal) {
  cli::FrameQuery query;
  query.id = "one";
  query.start = {433, 499};
  query.goal = goal;
  query.obstacles.push_back(EllipsePx::with_angle({433.0, 299.0}, 40.0, 40.0, 0.0));
  return query;
}

TEST_CASE("any_angle: an answer has the keys of the contract, in order", "[cli]") {
  AnyAnglePlanner planner;
  const auto found = planner.answer(query_to({433, 99}), 4).to_json();
  std::vector<std::string> keys;
  for (const auto& item : found.items()) {
    keys.push_back(item.key());
  }
  REQUIRE(keys == std::vector<std::string>{"found", "reason", "length_px", "points", "us"});
  REQUIRE(found.at("found") == true);
  REQUIRE(found.at("reason") == "found");
  REQUIRE(found.at("length_px").get<double>() == Approx(408.05).margin(0.05));
  REQUIRE(found.at("points").front() == nlohmann::ordered_json({433.0, 499.0}));
  REQUIRE(found.at("points").back() == nlohmann::ordered_json({433.0, 99.0}));
  REQUIRE(found.at("us").get<double>() > 0.0);

  const auto none = planner.answer(query_to({433, 299}), 1).to_json();
  REQUIRE(none.at("found") == false);
  REQUIRE(none.at("reason") == "goal_blocked");
  REQUIRE(none.at("length_px").is_null());
  REQUIRE(none.at("points").empty());
}

TEST_CASE("any_angle: it is the last key of a line, where it was asked for", "[cli]") {
  cli::PlanAnswer answer;
  REQUIRE_FALSE(answer.to_json().contains("any_angle"));
  AnyAnglePlanner planner;
  answer.any_angle = planner.answer(query_to({433, 99}), 1).to_json();
  const auto line = answer.to_json();
  REQUIRE(std::prev(line.end()).key() == "any_angle");
  REQUIRE(line.at("any_angle").at("found") == true);
}

}  // namespace
}  // namespace lodesman::testing
