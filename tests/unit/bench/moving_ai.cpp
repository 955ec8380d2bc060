// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/moving_ai.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "deploy/operator/bench/plan_answers.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"
#include "tests/support/text_file.h"

namespace lodesman::testing {
namespace {

using namespace cli;

const std::string kMap = "type octile\nheight 2\nwidth 3\nmap\n.G.\n@.T\n";

[[nodiscard]] std::string map_refused(const std::string& text) {
  return refusal_of(TextFile{"a.map", text}, read_map);
}

[[nodiscard]] std::string scen_refused(const std::string& text) {
  const TextFile map{"a.map", kMap};
  return refusal_of(TextFile{"a.scen", text}, [&](const std::filesystem::path& file) {
    return read_scen(file, read_map(map.path()));
  });
}

TEST_CASE("cli: a MovingAI map is read as it stands", "[cli]") {
  const TextFile file{"a.map", kMap};
  const MovingAiMap text = read_map(file.path());
  PassableMap map{text.width, text.height};
  text.draw(map, Terrain::kGround);
  REQUIRE(map.free_cells() == 4);
  REQUIRE(map.passable({1, 1}));
  REQUIRE_FALSE(map.passable({0, 1}));
  REQUIRE_FALSE(map.passable({3, 0}));
}

// The answer to one query on a small map, with the length that its file gives.
[[nodiscard]] PlanAnswer answer_on(const std::string& rows, MapCell start, MapCell goal,
                                   const std::string& length) {
  const auto width = rows.find('\n');
  const auto height = rows.size() / (width + 1);
  const std::string size = std::to_string(width) + " " + std::to_string(height);
  const TextFile map{"a.map", "type octile\nheight " + std::to_string(height) + "\nwidth " +
                                  std::to_string(width) + "\nmap\n" + rows};
  const TextFile scen{"a.scen", "version 1\n0 a.map " + size + " " + std::to_string(start.column) +
                                    " " + std::to_string(start.row) + " " +
                                    std::to_string(goal.column) + " " + std::to_string(goal.row) +
                                    " " + length + "\n"};
  const MovingAiMap read = read_map(map.path());
  return MapPlanner{read, MapCosts::kSqrt2}.answer(read_scen(scen.path(), read)[0], 0, 1);
}

TEST_CASE("cli: ground leads to swamp and water to water but neither to the other", "[cli]") {
  const std::string swamp = "....\n.@S.\n....\n";
  CHECK(answer_on(swamp, {0, 0}, {3, 2}, "4.41421356").agrees == true);
  CHECK(answer_on(swamp, {2, 1}, {3, 1}, "1").agrees == true);
  const std::string water = "WWWW\n.@..\n....\n";
  CHECK(answer_on(water, {0, 0}, {3, 0}, "3.00000000").agrees == true);
  CHECK(answer_on(water, {0, 0}, {0, 2}, "2").reason == PathReason::kGoalBlocked);
  CHECK(answer_on(water, {0, 2}, {0, 0}, "2").reason == PathReason::kGoalBlocked);
  // Past a corner of water there is no diagonal on ground.
  CHECK(answer_on("W.\n..\n", {1, 0}, {0, 1}, "2").agrees == true);
  for (const char blocked : {'@', 'O', 'T'}) {
    CHECK(answer_on(std::string{blocked} + ".\n", {0, 0}, {1, 0}, "1").reason ==
          PathReason::kStartBlocked);
  }
}

TEST_CASE("cli: a length made with nine decimals of the root agrees and no other does", "[cli]") {
  std::string open;
  for (int row = 0; row < 512; ++row) {
    open += std::string(512, '.') + "\n";
  }
  CHECK(answer_on(open, {0, 511}, {511, 0}, "722.66313018").agrees == true);  // 1.414213562
  CHECK(answer_on(open, {0, 511}, {511, 0}, "722.66313037").agrees == true);  // the root itself
  CHECK(answer_on(open, {0, 511}, {511, 0}, "722.66313028").agrees == false);
  CHECK(answer_on(open, {0, 511}, {511, 0}, "722.66312").agrees == false);
}

TEST_CASE("cli: a MovingAI map that is wrong is refused by line", "[cli]") {
  REQUIRE(map_refused(kMap).empty());
  REQUIRE(map_refused("type octile\n") == "2: header: must be type, height, width, map");
  REQUIRE(map_refused("type tile\nheight 1\nwidth 1\nmap\n.\n") ==
          "1: type: must be 'type octile'");
  REQUIRE(map_refused("type octile\nheight x\nwidth 1\nmap\n.\n") ==
          "2: height: must be a whole number");
  REQUIRE(map_refused("type octile\nheight 2000\nwidth 2000\nmap\n.\n") ==
          "3: width: times height must be at most 2097152 cells");
  REQUIRE(map_refused("type octile\nheight 2\nwidth 3\nmap\n...\n") ==
          "5: height: is 2, and 1 rows follow");
  REQUIRE(map_refused(kMap + "...\n") == "7: height: is 2, and more follows");
  REQUIRE(map_refused("type octile\nheight 1\nwidth 3\nmap\n....\n") ==
          "5: map: has 4 cells, and the width is 3");
  REQUIRE(map_refused("type octile\nheight 1\nwidth 3\nmap\n.x.\n") ==
          "5: map: column 1: must be one of . G @ O T S W");
}

TEST_CASE("cli: MovingAI queries that are wrong are refused by line and field", "[cli]") {
  REQUIRE(scen_refused("version 1\n0 a.map 3 2 0 0 2 0 2\n").empty());
  REQUIRE(scen_refused("0 a.map 3 2 0 0 2 0 2\n") == "1: version: must be 'version 1'");
  REQUIRE(scen_refused("version 1\n") == "1: file: holds no query");
  REQUIRE(scen_refused("version 1\n0 a.map 3 2 0 0 2 0\n").starts_with("2: row: must have 9"));
  REQUIRE(scen_refused("version 1\n0 a.map 4 2 0 0 2 0 2\n") == "2: width: must be from 3 to 3");
  REQUIRE(scen_refused("version 1\n0 a.map 3 2 0 0 3 0 2\n") == "2: goal_x: must be from 0 to 2");
  REQUIRE(scen_refused("version 1\n0 a.map 3 2 0 0 2 0 nan\n") ==
          "2: length: must be a finite number");
}

// Every row of one scenario file; a benchmark's length is right to one unit of its last digit.
void require_published_lengths(const std::string& name) {
  const auto file = data_path("gridmaps/" + name + ".map.scen");
  if (!file) {
    return;
  }
  const MovingAiMap map = read_map(std::filesystem::path{*file}.replace_extension());
  MapPlanner planner{map, MapCosts::kSqrt2};
  std::size_t rows = 0;
  std::size_t agreeing = 0;
  for (const MovingAiQuery& query : read_scen(*file, map)) {
    const PlanAnswer answer = planner.answer(query, rows++, 1);
    CAPTURE(name, rows, answer.cost, query.known_length);
    REQUIRE(answer.reason == PathReason::kFound);
    CHECK(answer.agrees == true);
    // Lengths are printed with six digits at least: whole numbers too are right to that.
    CHECK(std::abs(answer.cost - query.known_length) <= 1e-5 * query.known_length);
    CHECK(answer.path.front() == query.start);
    CHECK(answer.path.back() == query.goal);
    agreeing += answer.agrees.value_or(false) ? 1U : 0U;
  }
  std::cout << name << ": " << agreeing << " of " << rows << " rows agree to the last digit\n";
  REQUIRE(rows > 0);
  REQUIRE(agreeing == rows);
}

// One case a file, so that they run side by side: an unoptimised build takes its time.
TEST_CASE("cli: published lengths of arena", "[cli]") { require_published_lengths("arena"); }
TEST_CASE("cli: published lengths of den011d", "[cli]") { require_published_lengths("den011d"); }
TEST_CASE("cli: published lengths of 8room_000", "[cli][plain]") {
  require_published_lengths("8room_000");
}
TEST_CASE("cli: published lengths of maze512-4-0", "[cli][plain]") {
  require_published_lengths("maze512-4-0");
}
TEST_CASE("cli: published lengths of random512-10-0", "[cli][plain]") {
  require_published_lengths("random512-10-0");
}

}  // namespace
}  // namespace lodesman::testing
