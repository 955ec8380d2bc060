// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/session_places.h"

#include <vector>

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::seconds;

namespace {

constexpr NetworkId kAttacker = 9;
constexpr NetworkId kOperator = 5;

// Sessions of one standing and network, each heard a second after the one before.
void add(std::vector<SessionPlace>& places, std::size_t count, Standing standing,
         NetworkId network) {
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back({standing, network, Time{seconds{places.size()}}});
  }
}

}  // namespace

TEST_CASE("session places: of strangers the one that has been silent longest gives way",
          "[high_level][mission]") {
  std::vector<SessionPlace> places;
  add(places, 64, Standing::kKnown, kOwnMachine);
  add(places, 64, Standing::kStranger, kOwnMachine);
  CHECK(whose_place_to_give(places) == 64);
}

TEST_CASE("session places: a crowd of one network puts out its own, and nobody of another",
          "[high_level][mission]") {
  std::vector<SessionPlace> places;
  add(places, 1, Standing::kStranger, kOwnMachine);  // has been silent longer than all
  add(places, 1, Standing::kStranger, kOperator);
  add(places, 62, Standing::kStranger, kAttacker);
  add(places, 64, Standing::kKnown, kOperator);
  CHECK(whose_place_to_give(places) == 2);
  // Two that have two places each: this machine's come last.
  places.clear();
  add(places, 60, Standing::kStranger, kOwnMachine);
  add(places, 2, Standing::kStranger, kOperator);
  add(places, 2, Standing::kStranger, kAttacker);
  CHECK(whose_place_to_give(places) == 60);
}

TEST_CASE("session places: who waits for an abort keeps its place, whatever comes",
          "[high_level][mission]") {
  std::vector<SessionPlace> places;
  add(places, 1, Standing::kAwaitsAbort, kOperator);
  add(places, 63, Standing::kAwaitsAnswer, kOperator);
  add(places, 64, Standing::kStranger, kAttacker);
  CHECK(whose_place_to_give(places) == 64);
  // The last to ask where all wait.
  places.clear();
  add(places, 2, Standing::kAwaitsAbort, kOperator);
  add(places, 3, Standing::kAwaitsAnswer, kOperator);
  CHECK(whose_place_to_give(places) == 4);
  places.clear();
  add(places, kMaxSessions, Standing::kAwaitsAbort, kOperator);
  CHECK(whose_place_to_give(places) == places.size());
  CHECK(whose_place_to_give({}) == 0);
}
