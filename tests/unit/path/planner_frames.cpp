// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "low_level/path/path_search.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"
#include "tests/unit/path/bucket_a_star.h"
#include "tests/unit/path/reference_search.h"

namespace lodesman::testing {
namespace {

void draw(const nlohmann::json& frame, PassableGrid& grid) {
  grid.clear();
  for (const auto& o : frame.at("obstacles")) {
    grid.block(
        EllipsePx::with_angle({o.at("cx"), o.at("cy")}, o.at("a"), o.at("b"), o.at("theta_rad")));
  }
}

TEST_CASE("path: every planner frame has its free pixels, its cheapest cost and the rule's path",
          "[low_level][path]") {
  const auto file = data_path("planner_frames/frames.jsonl");
  if (!file) {
    return;
  }
  PassableGrid grid;
  PathSearch search;
  BucketAStar reference;
  std::ifstream lines{*file};
  std::string line;
  int frames = 0;
  while (std::getline(lines, line)) {
    const auto frame = nlohmann::json::parse(line);
    CAPTURE(frame.at("id").get<int>(), frame.at("category").get<std::string>());
    const PathPixel start = pixel(frame.at("start_px").at(0), frame.at("start_px").at(1));
    const PathPixel goal = pixel(frame.at("goal_px").at(0), frame.at("goal_px").at(1));
    draw(frame, grid);
    REQUIRE(grid.free_pixels() == frame.at("free_px").get<std::uint32_t>());

    const SearchResult result = search.search(grid, start, goal);
    if (frame.at("cost_10_14").is_null()) {
      REQUIRE(result.reason == PathReason::kNoPath);
      REQUIRE(result.cost_10_14 == 0);
      REQUIRE(result.path.empty());
    } else {
      REQUIRE(result.reason == PathReason::kFound);
      REQUIRE(result.cost_10_14 == frame.at("cost_10_14").get<int>());
      require_walkable(grid, result.path, start, goal, result.cost_10_14);
      REQUIRE(same(result.path, reference.search(grid, start, goal).path));
    }
    ++frames;
  }
  REQUIRE(frames == 200);
}

}  // namespace
}  // namespace lodesman::testing
