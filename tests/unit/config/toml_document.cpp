// SPDX-License-Identifier: Apache-2.0
#include "mid_level/config/toml_document.h"

#include <algorithm>
#include <functional>

#include "tests/support/catch.h"

using namespace lodesman;

namespace {

template <class F>
std::string refusal_of(F read) {
  try {
    read();
  } catch (const StartupError& error) {
    return error.what();
  }
  return "accepted";
}

TomlDocument sample() {
  return TomlDocument::from_text(
      "a = 1\n"
      "[b]\n"
      "number = 2.5\n"
      "text = \"x\"\n"
      "flag = true\n"
      "pair = [1, 2.0]\n"
      "pairs = [[0, 0], [1, 1]]\n"
      "[[c]]\n"
      "n = 1\n"
      "[[c]]\n"
      "n = 7\n",
      "base.toml");
}

}  // namespace

TEST_CASE("toml: a refusal names file, line, key and reason", "[mid_level][config]") {
  struct Row {
    const char* expected;
    std::function<void(const TomlTable&)> read;
  };
  const TomlDocument document = sample();
  const TomlTable b = document.root().table("b");
  const std::vector<Row> rows{
      {"base.toml:3: b.number: must be at least 0 and at most 1",
       [](const TomlTable& t) { (void)t.number("number", Range::between(0, 1)); }},
      {"base.toml:3: b.number: must be greater than 2.5 and at most 9",
       [](const TomlTable& t) { (void)t.number("number", Range::above(2.5, 9)); }},
      {"base.toml:4: b.text: must be a number",
       [](const TomlTable& t) { (void)t.number("text", Range::any()); }},
      {"base.toml:2: b.nothing: missing",
       [](const TomlTable& t) { (void)t.number("nothing", Range::any()); }},
      {"base.toml:3: b.number: must be a whole number",
       [](const TomlTable& t) { (void)t.integer("number", 0, 9); }},
      {"base.toml:4: b.text: must be true or false",
       [](const TomlTable& t) { (void)t.boolean("text"); }},
      {"base.toml:5: b.flag: must be a text", [](const TomlTable& t) { (void)t.text("flag", 9); }},
      {"base.toml:4: b.text: must be one of: y, z",
       [](const TomlTable& t) {
         (void)t.choice("text", {"y", "z"});
       }},
      {"base.toml:3: b.number: must be two numbers [x, y]",
       [](const TomlTable& t) { (void)t.pair("number", Range::any()); }},
      {"base.toml:7: b.pairs: must be 3 to 9 points [[x, y], ...]",
       [](const TomlTable& t) { (void)t.pairs("pairs", Range::any(), 3, 9); }},
      {"base.toml:3: b.number: must be a table",
       [](const TomlTable& t) { (void)t.table("number"); }},
  };
  for (const auto& row : rows) {
    CHECK(refusal_of([&] { row.read(b); }) == row.expected);
  }
  CHECK(refusal_of([&] { (void)document.root().tables("c", 5)[1].integer("n", 0, 6); }) ==
        "base.toml:11: c[1].n: must be from 0 to 6");
}

TEST_CASE("toml: values are read as they stand", "[mid_level][config]") {
  const TomlDocument document = sample();
  const TomlTable b = document.root().table("b");
  CHECK(b.number("number", Range::any()) == Approx(2.5));
  CHECK(b.text("text", 5) == "x");
  CHECK(b.boolean("flag"));
  CHECK(b.pair("pair", Range::any())[1] == Approx(2.0));
  CHECK(b.pairs("pairs", Range::any(), 1, 5).size() == 2);
  CHECK(b.number_or("nothing", Range::any(), 4.0) == Approx(4.0));
  CHECK(b.choice("text", {"w", "x"}) == 1);
  CHECK(document.root().tables("none", 5).empty());
}

TEST_CASE("toml: a key that nothing has read is unknown", "[mid_level][config]") {
  const TomlDocument document = TomlDocument::from_text("[t]\nknown = 1\nmispelt = 2\n", "f.toml");
  (void)document.root().table("t").integer("known", 0, 9);
  CHECK(refusal_of([&] { document.require_all_keys_read(); }) ==
        "f.toml:3: t.mispelt: unknown key");
}

TEST_CASE("toml: an overlay changes values, keeps their lines, and adds no keys",
          "[mid_level][config]") {
  TomlDocument document = sample();
  document.overlay(TomlDocument::from_text("\n[b]\nnumber = 99.0\n", "over.toml"));
  CHECK(refusal_of([&] {
          (void)document.root().table("b").number("number", Range::between(0, 5));
        }) == "over.toml:3: b.number: must be at least 0 and at most 5");
  CHECK(refusal_of([&] { document.overlay(TomlDocument::from_text("b.new = 1", "--set")); }) ==
        "--set:1: b.new: unknown key");
}

TEST_CASE("toml: a key of too many parts is refused, whatever its parts hold",
          "[mid_level][config]") {
  for (const std::string part : {"a", "\"\"", "'.'", "\",\"", "'='", "\"\\\"#\"", "'[' "}) {
    std::string key = part;
    for (int parts = 1; parts < 16; ++parts) {
      key += "." + part;
    }
    // What comes before it must not hide it.
    for (const std::string before :
         {"y = {", "x = [\"\"\"a\"\"\"\", {", "x = ['''\n''''', {", "x = \"\\\"\" # '\ny = {"}) {
      INFO(before << key);
      const auto line = std::to_string(1 + std::count(before.begin(), before.end(), '\n'));
      CHECK(refusal_of([&] {
              (void)TomlDocument::from_text(before + key + ".a = 1}", "k.toml");
            }) == "k.toml:" + line + ": toml: a key of too many parts");
      CHECK(refusal_of([&] {
              (void)TomlDocument::from_text(before + key + " = 1}", "k.toml");
            }).find("too many parts") == std::string::npos);
    }
  }
}

TEST_CASE("toml: dots in comments and texts are no key's", "[mid_level][config]") {
  const std::string dots = "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r";
  const auto document = TomlDocument::from_text(
      "x = \"" + dots + "\" # " + dots + "\ny = '" + dots + "'\nz = \"\"\"\n" + dots + "\"\"\"\n",
      "d.toml");
  for (const char* key : {"x", "y", "z"}) {
    CHECK(document.root().text(key, 99) == dots);
  }
}

TEST_CASE("toml: letters beyond ASCII stand in texts and comments only", "[mid_level][config]") {
  const auto document = TomlDocument::from_text("\xef\xbb\xbfx = \"\u00e9\" # \u00e9\n", "l.toml");
  CHECK(document.root().text("x", 9) == "\u00e9");
  for (const char* text : {"a = 1\n\u00e9 = 1", "a = 1\n\u00a0b = 1", "a = 1\nb = \u00e9"}) {
    CHECK(refusal_of([&] { (void)TomlDocument::from_text(text, "l.toml"); }) ==
          "l.toml:2: toml: only texts and comments may hold other letters than ASCII's");
  }
}

TEST_CASE("toml: a document written out is read the same, whatever its texts hold",
          "[mid_level][config]") {
  const auto document = TomlDocument::from_text(
      "x = \"a'''b\\n\\\"\\\\\\u0001\\u007f\\u00e9\"\ny = -0.1\nz = 1.0\n", "w.toml");
  const auto again = TomlDocument::from_text(document.to_text(), "again.toml");
  CHECK(again.root().text("x", 99) == "a'''b\n\"\\\x01\x7f\u00e9");
  CHECK(again.to_text() == document.to_text());
}

TEST_CASE("toml: what cannot be parsed is refused with its line", "[mid_level][config]") {
  const auto refusal =
      refusal_of([] { (void)TomlDocument::from_text("a = 1\na = 2\n", "d.toml"); });
  CHECK(refusal.rfind("d.toml:2: toml: ", 0) == 0);
  CHECK(refusal_of([] {
          (void)TomlDocument::from_text(std::string(TomlDocument::kMaxBytes + 1, '#'), "big.toml");
        }) == "big.toml:1: file: is larger than 1 MiB");
  CHECK(refusal_of([] { (void)TomlDocument::from_file("no/such/file.toml"); }) ==
        "no/such/file.toml:1: file: cannot be read");
  for (const char* number : {"nan", "inf", "-inf"}) {
    const auto document = TomlDocument::from_text(std::string{"x = "} + number, "n.toml");
    CHECK(refusal_of([&] { (void)document.root().number("x", Range::any()); }) ==
          "n.toml:1: x: must be finite");
  }
}
