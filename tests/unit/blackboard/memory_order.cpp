// SPDX-License-Identifier: Apache-2.0
// The protocols of channel and bell, their own code, in every way in which C++ lets its loads and
// stores meet: any schedule, any store that a load may read, any store at which the writer is
// killed. And each acquire and release taken away, one at a time: each must be missed by something
// that is promised.
#include <algorithm>
#include <functional>
#include <set>
#include <vector>

#include "tests/support/catch.h"
#include "tests/unit/blackboard/bell_stories.h"

namespace lodesman::weak {
namespace {

struct Story {
  const char* name;
  std::function<Findings(Memory&)> play;
};

const std::vector<Story> kStories{
    {"written over, latest", [](Memory& m) { return written_over(m, By::kLatest); }},
    {"written over, next", [](Memory& m) { return written_over(m, By::kNext); }},
    {"written over, by number", [](Memory& m) { return written_over(m, By::kNumber); }},
    {"kept", [](Memory& m) { return kept(m); }},
    {"handed over, latest", [](Memory& m) { return handed_over(m, By::kLatest); }},
    {"handed over, next", [](Memory& m) { return handed_over(m, By::kNext); }},
    {"killed, latest", [](Memory& m) { return killed(m, By::kLatest); }},
    {"killed, next", [](Memory& m) { return killed(m, By::kNext); }},
    {"killed, by number", [](Memory& m) { return killed(m, By::kNumber); }},
    {"forged, latest", [](Memory& m) { return forged(m, By::kLatest); }},
    {"forged, by number", [](Memory& m) { return forged(m, By::kNumber); }},
    {"answered", answered},
    {"rung", [](Memory& m) { return rung(m); }},
};

// What each acquire and each release of channel.h is for: what goes wrong without it.
struct Needed {
  Site site;
  const char* what_for;
};

const std::vector<Needed> kNeeded{
    {{Place::kNewest, Access::kStore, Half::kRelease}, "whoever hears of a number can have it"},
    {{Place::kNewest, Access::kLoad, Half::kAcquire}, "its other side"},
    {{Place::kVersion, Access::kStore, Half::kRelease}, "an even version says: all is there"},
    {{Place::kVersion, Access::kLoad, Half::kAcquire}, "its other side, before the value is read"},
    {{Place::kStamp, Access::kStore, Half::kRelease}, "a new stamp tells of the odd version"},
    {{Place::kStamp, Access::kLoad, Half::kAcquire}, "its other side, before the second look"},
    {{Place::kBytes, Access::kStore, Half::kRelease}, "a new size tells of the odd version"},
    {{Place::kBytes, Access::kLoad, Half::kAcquire}, "its other side, before the second look"},
    {{Place::kWord, Access::kStore, Half::kRelease}, "a new word tells of the odd version"},
    {{Place::kWord, Access::kLoad, Half::kAcquire}, "its other side, before the second look"},
    {{Place::kClaim, Access::kStore, Half::kRelease}, "a successor begins after the last number"},
    {{Place::kClaim, Access::kExchange, Half::kAcquire}, "its other side"},
    {{Place::kClaim, Access::kExchange, Half::kRelease}, "the same for who frees a dead one's"},
    {{Place::kBell, Access::kExchange, Half::kRelease}, "a ring says: there is something new"},
    {{Place::kBell, Access::kLoad, Half::kAcquire}, "its other side, before channels are read"},
};

}  // namespace

TEST_CASE("memory order: no value is torn, lost or out of turn in any way that C++ allows",
          "[mid_level][blackboard]") {
  std::set<Site> asked;
  for (const Story& story : kStories) {
    Memory memory;
    const Findings found = story.play(memory);
    INFO(story.name << ": " << found);
    CHECK(found.wrong() == 0);
    CHECK(found.ways > 1);
    CHECK(found.values > 0);
    for (const Site& site : memory.sites()) {
      asked.insert(site);
    }
  }
  // Those below, and no other.
  std::set<Site> needed;
  for (const Needed& row : kNeeded) {
    needed.insert(row.site);
  }
  CHECK(asked == needed);
}

TEST_CASE("memory order: without any one acquire or release something goes wrong",
          "[mid_level][blackboard][plain]") {
  for (const Needed& needed : kNeeded) {
    INFO(needed.what_for);
    CHECK(std::any_of(kStories.begin(), kStories.end(), [&](const Story& story) {
      Memory memory{needed.site};
      return story.play(memory).wrong() > 0;
    }));
  }
}

TEST_CASE("memory order: protocols that are wrong on purpose are found out",
          "[mid_level][blackboard]") {
  const auto wrong_with = [](Wrong wrong) {
    Memory memory;
    return written_over(memory, By::kLatest, wrong).wrong();
  };
  CHECK(wrong_with(Wrong::kNothing) == 0);
  CHECK(wrong_with(Wrong::kNotMarkedOdd) > 0);
  CHECK(wrong_with(Wrong::kSaidWholeTooEarly) > 0);
  Memory memory;
  CHECK(kept(memory, Wrong::kAnnouncedFirst).lost > 0);
}

TEST_CASE("memory order: nobody sleeps over what was rung for, unless a bell is used wrongly",
          "[mid_level][blackboard]") {
  const auto lost_with = [](Misuse misuse) {
    Memory memory;
    return rung(memory, misuse).lost;
  };
  CHECK(lost_with(Misuse::kNothing) == 0);
  CHECK(lost_with(Misuse::kLookedAtLast) > 0);
  CHECK(lost_with(Misuse::kRungFirst) > 0);
}

}  // namespace lodesman::weak
