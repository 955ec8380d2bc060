// SPDX-License-Identifier: Apache-2.0
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

}  // namespace
}  // namespace lodesman::tidy
