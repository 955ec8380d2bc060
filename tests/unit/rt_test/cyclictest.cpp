// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/cyclictest.h"

#include "deploy/operator/rt_test/load.h"
#include "tests/support/catch.h"

namespace lodesman::cli {

using std::chrono::microseconds;

// The form of rt-tests 2.4.
TEST_CASE("cyclictest: its own report is read", "[operator][rt_test]") {
  const auto figures = read_cyclictest(R"({"file_version": 1, "num_threads": 1, "thread": {"0": {
    "histogram": {"3": 90, "17": 8, "400": 2}, "cycles": 100, "min": 3, "max": 412, "avg": 4.2,
    "cpu": 0, "node": 0}}})");
  REQUIRE(figures);
  CHECK(figures->wakes == 100);
  CHECK(figures->median == microseconds{3});
  CHECK(figures->p99 == microseconds{400});
  CHECK(figures->worst == microseconds{412});
  CHECK(figures->late[late_bucket(microseconds{3})] == 90);
  CHECK(figures->late[late_bucket(microseconds{17})] == 8);
  CHECK(figures->late[late_bucket(microseconds{400})] == 2);
}

TEST_CASE("cyclictest: what is no report, or counts nothing, is none", "[operator][rt_test]") {
  for (const char* text :
       {"", "{", "[]", "{\"thread\": 3}", "{\"thread\": {\"0\": 1}}",
        "{\"thread\": {\"0\": {\"histogram\": {}}}}",
        "{\"thread\": {\"0\": {\"histogram\": {\"x\": 1, \"-4\": 1, \"5\": -1, \"6\": \"a\", "
        "\"99999999999\": 1}, \"max\": -3}}}"}) {
    INFO(text);
    CHECK_FALSE(read_cyclictest(text));
  }
}

TEST_CASE("load: its kinds and their names", "[operator][rt_test]") {
  for (const LoadKind kind : {LoadKind::kIdle, LoadKind::kCpu, LoadKind::kAll}) {
    CHECK(load_named(to_string(kind)) == kind);
  }
  CHECK(load_named("much") == std::nullopt);
  CHECK(load_words(LoadKind::kIdle, 2, 10).empty());
  // Whatever happens to this program, the load ends by itself.
  for (const LoadKind kind : {LoadKind::kCpu, LoadKind::kAll}) {
    const auto words = load_words(kind, 2, 10);
    REQUIRE(words.size() > 4);
    CHECK(words[0] == "stress-ng");
    CHECK(words[2] == "--timeout");
    CHECK(words[3] == "10s");
  }
}

}  // namespace lodesman::cli
