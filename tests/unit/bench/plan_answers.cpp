// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/plan_answers.h"

#include <cmath>
#include <set>

#include "tests/support/catch.h"
#include "tests/support/data_dir.h"

namespace lodesman::testing {
namespace {

using namespace cli;

[[nodiscard]] FrameQuery frame(std::vector<EllipsePx> obstacles, PathPixel goal) {
  FrameQuery query;
  query.id = "one";
  query.start = {433, 499};
  query.goal = goal;
  query.obstacles = std::move(obstacles);
  return query;
}

[[nodiscard]] EllipsePx disc(double column, double row, double radius) {
  return EllipsePx::with_angle({column, row}, radius, radius, 0.0);
}

TEST_CASE("plan: every planner frame agrees with its file", "[cli]") {
  const auto file = data_path("planner_frames/frames.jsonl");
  if (!file) {
    return;
  }
  FramePlanner planner{MapCosts::kPaper};
  const std::vector<FrameQuery> frames = read_frames(*file);
  REQUIRE(frames.size() == 200);
  for (const FrameQuery& query : frames) {
    const PlanAnswer answer = planner.answer(query, 1);
    CAPTURE(query.id.dump(), answer.cost_10_14, answer.free_px);
    REQUIRE(query.knows_cost);
    REQUIRE(answer.agrees == true);
    const auto json = answer.to_json();
    REQUIRE(json.at("cost_10_14").is_null() == !query.known_cost_10_14.has_value());
    if (query.known_cost_10_14) {
      REQUIRE(json.at("cost_10_14") == *query.known_cost_10_14);
    }
  }
}

// The general search on the same frames: the paper's costs can only be worse for its path, and
// the other way round.
TEST_CASE("plan: the costs of sqrt2 are never above those of the paper's path", "[cli]") {
  const auto file = data_path("planner_frames/frames.jsonl");
  if (!file) {
    return;
  }
  FramePlanner paper{MapCosts::kPaper};
  FramePlanner sqrt2{MapCosts::kSqrt2};
  const std::vector<FrameQuery> frames = read_frames(*file);
  for (std::size_t i = 0; i < frames.size(); i += 8) {
    const PlanAnswer a = paper.answer(frames[i], 1);
    const PlanAnswer b = sqrt2.answer(frames[i], 1);
    CAPTURE(frames[i].id.dump());
    REQUIRE(a.reason == b.reason);
    REQUIRE(b.agrees == true);  // in its free pixels
    double a_length = 0.0;
    for (std::size_t p = 1; p < a.path.size(); ++p) {
      a_length +=
          std::hypot(a.path[p].column - a.path[p - 1].column, a.path[p].row - a.path[p - 1].row);
    }
    REQUIRE(b.cost <= a_length + 1e-9);
    REQUIRE(b.cost_10_14 >= a.cost_10_14);
  }
}

TEST_CASE("plan: both searches tell the same reasons", "[cli]") {
  for (const MapCosts costs : {MapCosts::kPaper, MapCosts::kSqrt2}) {
    FramePlanner planner{costs};
    REQUIRE(planner.answer(frame({}, {433, 100}), 2).reason == PathReason::kFound);
    REQUIRE(planner.answer(frame({}, {0, 0}), 2).reason == PathReason::kGoalOutOfView);
    REQUIRE(planner.answer(frame({}, {-5, 7000}), 2).reason == PathReason::kGoalOutOfView);
    REQUIRE(planner.answer(frame({disc(433, 100, 9)}, {433, 100}), 1).reason ==
            PathReason::kGoalBlocked);
    REQUIRE(planner.answer(frame({disc(433, 499, 9)}, {0, 0}), 1).reason ==
            PathReason::kStartBlocked);
    REQUIRE(planner.answer(frame({disc(433, 499, 250), disc(433, 499, 9)}, {433, 100}), 1).reason ==
            PathReason::kStartBlocked);
  }
}

TEST_CASE("plan: a line has the keys of the contract, in order", "[cli]") {
  FramePlanner planner{MapCosts::kPaper};
  const auto found = planner.answer(frame({}, {433, 489}), 3).to_json();
  std::vector<std::string> keys;
  for (const auto& item : found.items()) {
    keys.push_back(item.key());
  }
  REQUIRE(keys == std::vector<std::string>{"id", "found", "reason", "cost", "cost_10_14", "path_px",
                                           "free_px", "expansions", "us", "search_us"});
  REQUIRE(found.at("id") == "one");
  REQUIRE(found.at("found") == true);
  REQUIRE(found.at("cost") == Approx(10.0));
  REQUIRE(found.at("cost_10_14") == 100);
  REQUIRE(found.at("path_px").size() == 11);
  REQUIRE(found.at("path_px")[0] == nlohmann::ordered_json({433, 499}));
  REQUIRE(found.at("us").get<double>() >= found.at("search_us").get<double>());

  const auto none = planner.answer(frame({}, {0, 0}), 1).to_json();
  REQUIRE(none.at("found") == false);
  REQUIRE(none.at("reason") == "goal_out_of_view");
  REQUIRE(none.at("cost").is_null());
  REQUIRE(none.at("cost_10_14").is_null());
  REQUIRE(none.at("path_px").empty());
}

TEST_CASE("plan: a person is told how many agree", "[cli]") {
  FramePlanner planner{MapCosts::kPaper};
  FrameQuery right = frame({}, {433, 489});
  right.knows_cost = true;
  right.known_cost_10_14 = 100;
  FrameQuery wrong = right;
  wrong.known_cost_10_14 = 99;
  const std::vector<PlanAnswer> answers{planner.answer(right, 1), planner.answer(wrong, 1)};
  REQUIRE(summary_of(answers).starts_with("2 queries: 2 found\n1 of 2 agree"));
  const std::string table = table_of(answers);
  REQUIRE(table.find("! not what the file says") != std::string::npos);
}

}  // namespace
}  // namespace lodesman::testing
