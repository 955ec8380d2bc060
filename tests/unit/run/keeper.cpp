// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/keeper.h"

#include <algorithm>

#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::cli;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr Time kNow{seconds{100}};
using Event = Keeper::Event;
using State = Keeper::State;

// So long until it may be started again, after it has run for that and ended so.
Duration pause_after(Keeper& keeper, Event event, Duration ran, Time& now) {
  REQUIRE(keeper.is_due(now));
  REQUIRE(keeper.happen(Event::kStarted, now));
  now += ran;
  REQUIRE(keeper.happen(event, now));
  const Duration pause = keeper.due() - now;
  CHECK_FALSE(keeper.is_due(keeper.due() - Duration{1}));
  now = keeper.due();
  return pause;
}

}  // namespace

TEST_CASE("keeper: how a program ended says whether it is started again", "[operator][run]") {
  CHECK(Keeper::event_of(75) == Event::kNotYet);
  CHECK(Keeper::event_of(2) == Event::kRefused);
  for (const std::optional<int> other : {std::optional{0}, std::optional{1}, std::optional{4},
                                         std::optional{127}, std::optional<int>{}}) {
    CHECK(Keeper::event_of(other) == Event::kFailed);
  }
}

TEST_CASE("keeper: what fails again and again is started with pauses that grow to a bound",
          "[operator][run]") {
  Keeper keeper;
  Time now = kNow;
  Duration expected = Keeper::kFirstPause;
  for (int i = 0; i < 12; ++i) {
    CHECK(pause_after(keeper, Event::kFailed, milliseconds{300}, now) == expected);
    expected = std::min(2 * expected, Keeper::kLongestPause);
  }
  CHECK(expected == Keeper::kLongestPause);
  CHECK(keeper.restarts() == 11);
  // Who ran for a while begins with the least pause again.
  CHECK(pause_after(keeper, Event::kFailed, Keeper::kSteady, now) == Keeper::kFirstPause);
}

TEST_CASE("keeper: what is not yet possible is tried again soon, however often",
          "[operator][run]") {
  Keeper keeper;
  Time now = kNow;
  for (int i = 0; i < 50; ++i) {
    CHECK(pause_after(keeper, Event::kNotYet, milliseconds{10}, now) == Keeper::kSoon);
  }
}

TEST_CASE("keeper: a refusal and a stop are the end of it", "[operator][run]") {
  Keeper refused;
  REQUIRE(refused.happen(Event::kStarted, kNow));
  REQUIRE(refused.happen(Event::kRefused, kNow));
  Keeper stopped;
  REQUIRE(stopped.happen(Event::kStop, kNow));
  for (Keeper* keeper : {&refused, &stopped}) {
    CHECK(keeper->state() == State::kOver);
    CHECK_FALSE(keeper->is_due(kNow + seconds{1000}));
    for (const Event event : {Event::kStarted, Event::kNotYet, Event::kRefused, Event::kFailed}) {
      CHECK_FALSE(keeper->happen(event, kNow));
    }
  }
}

TEST_CASE("keeper: what does not run cannot end, and what runs is not started twice",
          "[operator][run]") {
  Keeper keeper;
  CHECK_FALSE(keeper.happen(Event::kFailed, kNow));
  CHECK_FALSE(keeper.happen(Event::kNotYet, kNow));
  REQUIRE(keeper.happen(Event::kStarted, kNow));
  CHECK_FALSE(keeper.happen(Event::kStarted, kNow));
  CHECK_FALSE(keeper.is_due(kNow + seconds{1000}));
}
