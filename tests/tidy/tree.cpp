// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>

#include "tests/support/catch.h"
#include "tests/tidy/rules.h"

namespace lodesman::tidy {
namespace {

TEST_CASE("tidy: the tree keeps every house rule", "[tidy]") {
  const auto tree = read_tree(LODESMAN_SOURCE_DIR);
  REQUIRE(tree.size() > 100);
  for (const Rule& rule : rules()) {
    for (const SourceFile& file : tree) {
      for (const std::string& finding : rule.check(file)) {
        FAIL_CHECK(rule.name << ": " << finding);
      }
    }
  }
}

TEST_CASE("tidy: every source file of the tree is built", "[tidy]") {
  for (const std::string& finding : unlisted_sources(read_tree(LODESMAN_SOURCE_DIR))) {
    FAIL_CHECK(finding);
  }
}

TEST_CASE("tidy: every test that a document cites exists", "[tidy]") {
  for (const std::string& finding : missing_tests(read_tree(LODESMAN_SOURCE_DIR))) {
    FAIL_CHECK(finding);
  }
}

TEST_CASE("tidy: every threat has its test", "[tidy]") {
  const std::vector<SourceFile> tree = read_tree(LODESMAN_SOURCE_DIR);
  CHECK(std::any_of(tree.begin(), tree.end(), [](const SourceFile& file) {
    return file.path == "docs/security.md" && file.text.find("| test |\n") != std::string::npos;
  }));
  for (const std::string& finding : threats_without_tests(tree)) {
    FAIL_CHECK(finding);
  }
}

TEST_CASE("docs: the table of rooms is the law's own", "[tidy][docs]") {
  std::vector<std::string> rows;
  for (const Arrow& arrow : arrows()) {
    std::string row = "| `" + std::string{arrow.room} + "` |";
    for (const std::string_view place : arrow.may_include) {
      row += std::string{place == arrow.may_include.front() ? " " : ", "} +
             (place.empty() ? "everything" : "`" + std::string{place} + "`");
    }
    rows.push_back(row + " |");
  }
  std::ifstream file{LODESMAN_SOURCE_DIR "/docs/architecture.md"};
  std::vector<std::string> documented;
  std::string line;
  while (std::getline(file, line) && line != "| room | may include |") {
  }
  std::getline(file, line);  // the rule below the head
  while (std::getline(file, line) && line.starts_with("|")) {
    documented.push_back(line);
  }
  CHECK(documented == rows);
}

}  // namespace
}  // namespace lodesman::tidy
