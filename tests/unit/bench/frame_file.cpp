// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/frame_file.h"

#include <string>
#include <utility>

#include "tests/support/catch.h"
#include "tests/support/text_file.h"

namespace lodesman::testing {
namespace {

using cli::read_frames;

const std::string kGood =
    R"({"id":7,"start_px":[433,499],"goal_px":[433,100],"cost_10_14":null,"free_px":12,)"
    R"("obstacles":[{"cx":400.5,"cy":300,"a":20,"b":10,"theta_rad":0.5}],"note":"let be"})";

[[nodiscard]] std::string refused(const std::string& text) {
  return refusal_of(TextFile{"f.jsonl", text}, read_frames);
}

[[nodiscard]] std::string with(std::string text, const std::string& old, const std::string& now) {
  return text.replace(text.find(old), old.size(), now);
}

TEST_CASE("cli: a frame is read as it stands", "[cli]") {
  const TextFile file{"f.jsonl", kGood + "\r\n\n" + with(kGood, "7", "\"b\"") + "\n"};
  const auto frames = read_frames(file.path());
  REQUIRE(frames.size() == 2);
  REQUIRE(frames[0].id == 7);
  REQUIRE(frames[1].id == "b");
  REQUIRE(frames[0].goal.row == 100);
  REQUIRE(frames[0].obstacles.size() == 1);
  REQUIRE(frames[0].obstacles[0].a == Approx(20.0));
  REQUIRE(frames[0].knows_cost);
  REQUIRE_FALSE(frames[0].known_cost_10_14.has_value());
  REQUIRE(frames[0].known_free_px == 12U);
}

TEST_CASE("cli: a frame that is wrong is refused by line and key", "[cli]") {
  REQUIRE(refused(kGood).empty());
  REQUIRE(refused("") == "1: file: holds no frame");
  REQUIRE(refused(kGood + "\n{\"id\":") == "2: json: not JSON from character 7 on");
  REQUIRE(refused("[1]") == "1: json: must be an object");
  REQUIRE(refused(with(kGood, "433,499", "433,1e999")) ==
          "1: json: holds a number that is too large");
  REQUIRE(refused(with(kGood, "\"id\":7,", "")) == "1: id: missing");
  REQUIRE(refused(with(kGood, "\"id\":7", "\"id\":7.5")).starts_with("1: id: must be"));
  REQUIRE(refused(with(kGood, "[433,499]", "[433]")) == "1: start_px: must be [column, row]");
  REQUIRE(refused(with(kGood, "[433,100]", "[433.5,100]")) == "1: goal_px: must be a whole number");
  REQUIRE(refused(with(kGood, "[433,100]", "[433,40000]")) ==
          "1: goal_px: must be from -32767 to 32767");
  REQUIRE(refused(with(kGood, "[433,100]", "[433,18446744073709551615]")) ==
          "1: goal_px: must be from -32767 to 32767");
  REQUIRE(refused(with(kGood, "\"cx\":400.5,", "")) == "1: obstacles[0].cx: missing");
  REQUIRE(refused(with(kGood, "\"a\":20", "\"a\":0")) ==
          "1: obstacles[0].a: must be greater than 0 and at most 1e6");
  REQUIRE(refused(with(kGood, "\"b\":10", "\"b\":\"10\"")) ==
          "1: obstacles[0].b: must be a number");
  REQUIRE(refused(with(kGood, "\"cost_10_14\":null", "\"cost_10_14\":-4"))
              .starts_with("1: cost_10_14: must be from 0"));
}

TEST_CASE("cli: a frame file that is not there is refused", "[cli]") {
  REQUIRE_THROWS_WITH(read_frames("/nowhere/f.jsonl"), "/nowhere/f.jsonl:1: file: cannot be read");
}

}  // namespace
}  // namespace lodesman::testing
