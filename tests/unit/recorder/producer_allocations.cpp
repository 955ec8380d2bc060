// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "deploy/operator/recorder/publication_queue.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::cli;

TEST_CASE("publication queue: the producer asks nothing of the heap", "[recorder]") {
  PublicationQueue queue{PublicationQueue::kLeast_bytes};
  const lodesman::testing::AllocationScope scope;
  Publication publication{3, 100'000, Time{Duration{5}}, 0};
  for (bool has_room = true; has_room;) {
    ++publication.sequence;
    const auto room = queue.room_for(publication);
    has_room = !room.empty();
    if (has_room) {
      std::fill(room.begin(), room.end(), std::byte{1});
      queue.take(publication);
    }
  }
  queue.note({4, GapCause::kOverwritten, 1, 2});
  queue.tell_gaps();
  CHECK(publication.sequence > 10);
  CHECK(scope.count() == 0);
}
