// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpsd/json_members.h"

#include <string>
#include <vector>

#include "tests/support/catch.h"

namespace lodesman::gpsd {
namespace {

struct Read {
  std::vector<std::string> words;  // name, value, name, value
  bool sound = false;
};

[[nodiscard]] Read read(std::string_view line) {
  Read got;
  JsonMembers members{line};
  while (const auto member = members.next()) {
    got.words.emplace_back(member->name);
    got.words.emplace_back(member->value);
  }
  got.sound = members.sound();
  return got;
}

using Words = std::vector<std::string>;

TEST_CASE("gpsd json: members come in order, nested ones as their text", "[gpsd]") {
  const Read got = read(R"({"class":"TPV", "mode" : 3,"lat":-1.5e1,"x":{"a":[1,"}"]},"ok":true})");
  CHECK(got.sound);
  CHECK(got.words ==
        Words{"class", "TPV", "mode", "3", "lat", "-1.5e1", "x", R"({"a":[1,"}"]})", "ok", "true"});
  CHECK(read("{}").sound);
  CHECK(read("{}\r").sound);
  CHECK(read(R"({"a":"\"}"})").words == Words{"a", R"(\"})"});
}

TEST_CASE("gpsd json: what is no whole object is not sound", "[gpsd]") {
  for (const char* line :
       {"", "x", "[]", "{", "{\"a\"", "{\"a\":", "{\"a\":1", "{\"a\":1,", "{\"a\":\"b",
        "{\"a\":[1}", "{\"a\":1}x", "{\"a\":1}{", "{a:1}", "{\"a\":1 \"b\":2}", "{\"a\":\"\\"}) {
    INFO(line);
    CHECK(!read(line).sound);
  }
}

TEST_CASE("gpsd json: an object cut off anywhere is not sound", "[gpsd]") {
  const std::string whole = R"({"class":"TPV","mode":3,"x":[{"y":"z"}],"lat":1.5})";
  CHECK(read(whole).sound);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CHECK(!read(whole.substr(0, size)).sound);
  }
}

TEST_CASE("gpsd json: a number is finite, and one from end to end", "[gpsd]") {
  const auto number = [](std::string_view line) {
    JsonMembers members{line};
    return number_of(members.next().value());
  };
  CHECK(number(R"({"a":1.5e-3})").value() == Approx(0.0015));
  CHECK(!number(R"({"a":1e999})"));
  CHECK(!number(R"({"a":"1"})"));
  CHECK(!number(R"({"a":nan})"));
  CHECK(!number(R"({"a":1.5x})"));
  CHECK(!number(R"({"a":-})"));
}

}  // namespace
}  // namespace lodesman::gpsd
