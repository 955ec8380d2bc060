// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/oracle.h"

#include <set>

#include "tests/fuzz/mutation.h"
#include "tests/support/catch.h"

namespace lodesman::fuzz {
namespace {

TEST_CASE("fuzz: a refusal out of its form and any other exception are found", "[fuzz]") {
  CHECK_NOTHROW(accepted_or_refused([] {}));
  CHECK_NOTHROW(accepted_or_refused([] { throw StartupError("f.toml", 3, "a.b", "missing"); }));
  for (const char* refusal : {"", "bad", "f.toml: a: missing", "f.toml:0: a: missing", "f.toml:3:",
                              "f.toml:3: missing", "f.toml:3: a: ", "f.toml:3: a: mis\nsing"}) {
    CHECK_THROWS_AS(require_refusal_form(refusal), Violation);
  }
  CHECK_THROWS_AS(require_refusal_form("f:1: a: " + std::string(1000, 'x')), Violation);
  CHECK_THROWS_AS(accepted_or_refused([] { throw std::out_of_range{"at"}; }), std::out_of_range);
}

TEST_CASE("fuzz: mutations differ, and are the same for the same chance", "[fuzz]") {
  const std::vector<std::string> seeds{"", "a = 1\n[b]\nc = [1.0, 2.0]\n"};
  std::mt19937_64 chance{7};
  std::mt19937_64 again{7};
  std::set<std::string> all;
  for (int i = 0; i < 200; ++i) {
    const std::string text = mutated(seeds[1], seeds, chance);
    CHECK(text == mutated(seeds[1], seeds, again));
    all.insert(text);
  }
  CHECK(all.size() > 150);
  CHECK_NOTHROW(mutated(seeds[0], seeds, chance));
}

}  // namespace
}  // namespace lodesman::fuzz
