// SPDX-License-Identifier: Apache-2.0
// The analysis on examples whose answers stand in textbooks, and on others that were reckoned by
// hand.
#include "deploy/operator/rt_test/response_times.h"

#include "tests/support/catch.h"

namespace lodesman::cli {
namespace {

using std::chrono::milliseconds;
using Tasks = std::vector<AnalysedTask>;

AnalysedTask periodic(int priority, int execution_ms, int period_ms, int deadline_ms = 0) {
  return {priority,
          milliseconds{execution_ms},
          milliseconds{deadline_ms == 0 ? period_ms : deadline_ms},
          {},
          {{milliseconds{period_ms}, {}}}};
}

std::optional<Duration> on_one(const Tasks& tasks, std::size_t which, Duration blocking = {}) {
  return worst_response(tasks, which, {1, blocking});
}

std::optional<Duration> on_two(const Tasks& tasks, std::size_t which) {
  return worst_response(tasks, which, {2, {}});
}

}  // namespace

// Burns and Wellings, Real-Time Systems and Programming Languages, the task set with periods 7, 12
// and 20.
TEST_CASE("response times: the textbook's three tasks on one core", "[operator][rt_test]") {
  const Tasks tasks{periodic(3, 3, 7), periodic(2, 3, 12), periodic(1, 5, 20)};
  CHECK(on_one(tasks, 0) == milliseconds{3});
  CHECK(on_one(tasks, 1) == milliseconds{6});
  CHECK(on_one(tasks, 2) == milliseconds{20});
  CHECK(utilisation(tasks) == Approx(3.0 / 7 + 3.0 / 12 + 5.0 / 20));
  CHECK(utilisation(tasks) > rate_monotonic_bound(3));  // met all the same: the bound is no limit
}

// Lehoczky (1990): the fifth step of the busy period is the slowest.
TEST_CASE("response times: a step that waits for its own forerunners", "[operator][rt_test]") {
  const Tasks tasks{periodic(2, 26, 70), periodic(1, 62, 100, 120)};
  CHECK(on_one(tasks, 0) == milliseconds{26});
  CHECK(on_one(tasks, 1) == milliseconds{118});
}

TEST_CASE("response times: equals may run before each other", "[operator][rt_test]") {
  const Tasks tasks{periodic(1, 3, 20), periodic(1, 4, 20)};
  CHECK(on_one(tasks, 0) == milliseconds{7});
  CHECK(on_one(tasks, 1) == milliseconds{7});
}

TEST_CASE("response times: a late release comes close to the next one", "[operator][rt_test]") {
  Tasks tasks{periodic(2, 2, 10), periodic(1, 7, 30)};
  CHECK(on_one(tasks, 1) == milliseconds{9});
  tasks[0].releases[0].jitter = milliseconds{5};
  CHECK(releases_within(tasks[0], milliseconds{5}) == 1);
  CHECK(releases_within(tasks[0], milliseconds{6}) == 2);
  CHECK(on_one(tasks, 1) == milliseconds{11});
}

TEST_CASE("response times: however often it is rung for, its gap is kept", "[operator][rt_test]") {
  Tasks tasks{periodic(2, 1, 10), periodic(1, 10, 100)};
  tasks[0].releases.push_back({milliseconds{10}, {}});
  tasks[0].releases.push_back({milliseconds{10}, {}});
  CHECK(releases_within(tasks[0], milliseconds{10}) == 3);
  CHECK(on_one(tasks, 1) == milliseconds{16});  // 10 + 2 x 3
  tasks[0].least_gap = milliseconds{8};
  CHECK(releases_within(tasks[0], milliseconds{1}) == 1);
  CHECK(releases_within(tasks[0], milliseconds{10}) == 2);
  CHECK(on_one(tasks, 1) == milliseconds{12});  // 10 + 1 each 8 ms
  CHECK(utilisation(tasks) == Approx(1.0 / 8 + 0.1));
}

TEST_CASE("response times: what blocks delays all", "[operator][rt_test]") {
  const Tasks tasks{periodic(3, 3, 7), periodic(2, 3, 12)};
  CHECK(on_one(tasks, 0, milliseconds{1}) == milliseconds{4});
  CHECK(on_one(tasks, 1, milliseconds{1}) == milliseconds{7});
  CHECK(on_one(tasks, 1, milliseconds{2}) == milliseconds{11});  // meets the second of the other
}

TEST_CASE("response times: without end where there is more to do than time",
          "[operator][rt_test]") {
  const Tasks tasks{periodic(2, 6, 10), periodic(1, 5, 10)};
  CHECK(on_one(tasks, 0) == milliseconds{6});
  CHECK(on_one(tasks, 1) == std::nullopt);
}

TEST_CASE("response times: on more cores than tasks that would interfere nobody waits",
          "[operator][rt_test]") {
  const Tasks tasks{periodic(2, 3, 10, 5), periodic(1, 5, 20)};
  CHECK(on_two(tasks, 0) == milliseconds{3});
  // The other can take at most half of what it waits: 5 + (w - 5) / 2 is no more than 5 for long.
  const auto second = on_two(tasks, 1);
  REQUIRE(second);
  CHECK(*second >= milliseconds{5});
  CHECK(*second <= milliseconds{5} + std::chrono::microseconds{1});
}

// By hand, in steps of the formula: 4 + (3 + 3) / 2 = 7, where each of the others fits in once, and
// each once more for what may have been released before.
TEST_CASE("response times: two cores share what comes before", "[operator][rt_test]") {
  const Tasks tasks{periodic(3, 3, 100, 3), periodic(2, 3, 100, 3), periodic(1, 4, 100)};
  const auto third = on_two(tasks, 2);
  REQUIRE(third);
  CHECK(*third >= milliseconds{7} - std::chrono::microseconds{1});
  CHECK(*third <= milliseconds{7} + std::chrono::microseconds{1});
  CHECK(on_one(tasks, 2) == milliseconds{10});
}

TEST_CASE("response times: the bound of Liu and Layland", "[operator][rt_test]") {
  CHECK(rate_monotonic_bound(1) == Approx(1.0));
  CHECK(rate_monotonic_bound(2) == Approx(0.8284).margin(1e-4));
  CHECK(rate_monotonic_bound(3) == Approx(0.7798).margin(1e-4));
}

}  // namespace lodesman::cli
