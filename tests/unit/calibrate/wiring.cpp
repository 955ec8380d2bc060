// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/calibrate/wiring.h"

#include <set>

#include "tests/support/catch.h"

namespace lodesman::cli {
namespace {

TEST_CASE("wiring: eight pairs of answers have a wiring each, and the other eight none", "[cli]") {
  int known = 0;
  std::set<int> wirings;
  for (const Answer ahead : {Answer::kAhead, Answer::kAstern, Answer::kStarboard, Answer::kPort}) {
    for (const Answer right :
         {Answer::kAhead, Answer::kAstern, Answer::kStarboard, Answer::kPort}) {
      if (const auto wiring = wiring_of(ahead, right)) {
        ++known;
        wirings.insert((wiring->swapped ? 4 : 0) + (wiring->left_reversed ? 2 : 0) +
                       (wiring->right_reversed ? 1 : 0));
      }
    }
  }
  CHECK(known == 8);
  CHECK(wirings.size() == 8);
  CHECK(wiring_of(Answer::kAhead, Answer::kStarboard)->is_right());
  CHECK(wiring_of(Answer::kAhead, Answer::kPort)->swapped);
  CHECK(wiring_of(Answer::kPort, Answer::kAstern)->left_reversed);
  CHECK_FALSE(wiring_of(Answer::kAhead, Answer::kAhead).has_value());
}

TEST_CASE("wiring: what is said through it does what was wished", "[cli]") {
  for (int i = 0; i < 8; ++i) {
    const Wiring wiring{(i & 4) != 0, (i & 2) != 0, (i & 1) != 0};
    INFO(described(wiring));
    const Stick said = through(wiring, {30, 12});
    const int first = said.surge_ref + said.head_ref;
    const int second = said.surge_ref - said.head_ref;
    const int left = (wiring.swapped ? second : first) * (wiring.left_reversed ? -1 : 1);
    const int right = (wiring.swapped ? first : second) * (wiring.right_reversed ? -1 : 1);
    CHECK(left == 42);
    CHECK(right == 18);
  }
}

}  // namespace
}  // namespace lodesman::cli
