// SPDX-License-Identifier: Apache-2.0
// What may happen between those who ring a bell and who waits for it, played in the weak memory
// with the bell's and the channel's own code.
#pragma once

#include "mid_level/blackboard/bell.h"
#include "tests/unit/blackboard/channel_stories.h"

namespace lodesman::weak {

// How a bell is used wrongly.
enum class Misuse {
  kNothing,
  kLookedAtLast,  // who waits reads its channels first and looks at its bell then
  kRungFirst,     // who publishes rings before there is anything to be found
};

struct SharedBell : Bell<Atomic> {
  SharedBell() { rings.is(Place::kBell); }
};

// A publication of one of the two whom the bell hears.
inline void publish_and_ring(ValueWriter& writer, SharedBell& bell, Misuse misuse) {
  const std::uint64_t number = writer.sequence() + 1;
  const Time stamp{Duration{static_cast<std::int64_t>(number)}};
  if (misuse == Misuse::kRungFirst) {
    ring(bell);
    writer.publish_quietly(value_of(number), stamp);
  } else {
    writer.publish(value_of(number), stamp);
  }
}

// Two writers, in any order, wake one who waits for either. When all rings are over it sleeps if
// the bell is as it saw it; it must not sleep over anything that it has not seen.
inline Findings rung(Memory& memory, Misuse misuse = Misuse::kNothing) {
  return play(memory, [&](Findings& findings) {
    Ring<2> twice;
    Ring<2> once;
    SharedBell bell;
    Thread low;
    Thread high;
    Thread waiting;
    constexpr std::size_t kRings = 3;
    const std::size_t turn_of_high = memory.choose(kRings);
    memory.run_as(low);
    ValueWriter writer{twice, Role::kLow, "twice"};
    memory.run_as(high);
    ValueWriter other{once, Role::kHigh, "once"};
    if (misuse != Misuse::kRungFirst) {
      writer.rings(bell);
      other.rings(bell);
    }
    for (std::size_t turn = 0; turn < kRings; ++turn) {
      memory.run_as(turn == turn_of_high ? high : low);
      publish_and_ring(turn == turn_of_high ? other : writer, bell, misuse);
    }
    memory.run_as(waiting);
    ValueReader of_twice{twice};
    ValueReader of_once{once};
    std::uint32_t seen = misuse == Misuse::kLookedAtLast ? 0 : look_at(bell);
    const auto* newest = of_twice.latest();
    const auto* only = of_once.latest();
    if (misuse == Misuse::kLookedAtLast) {
      seen = look_at(bell);
    }
    if (seen == kRings) {
      Judge{findings}.must_be(newest, 2);
      Judge{findings}.must_be(only, 1);
    }
    memory.run_as(low);
    { const ValueWriter ends{std::move(writer)}; }
    memory.run_as(high);
  });
}

}  // namespace lodesman::weak
