// SPDX-License-Identifier: Apache-2.0
// What may happen to a channel, played in the weak memory: its own code writes and reads, and a
// judge looks at what readers are given.
#pragma once

#include <algorithm>
#include <ostream>
#include <utility>
#include <vector>

#include "mid_level/blackboard/channel.h"
#include "tests/unit/blackboard/weak_memory.h"

namespace lodesman::weak {

// Its size changes from one value of a slot to the next, so that every atomic of a slot matters.
struct Value {
  std::uint64_t count = 0;
  std::array<std::uint64_t, 2> numbers{};
  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(Value, numbers) + count * sizeof(std::uint64_t);
  }
  static constexpr auto fields() noexcept {
    return field_list(field("count", &Value::count),
                      field("numbers", &Value::numbers, &Value::count));
  }
};
using ValueWriter = Writer<Value, Atomic>;
using ValueReader = Reader<Value, Atomic>;
using Thread = Memory::Thread;

template <std::size_t kDepth>
struct Ring : Channel<Value, kDepth, Atomic> {
  Ring() {
    this->head.newest.is(Place::kNewest);
    this->head.writer.is(Place::kClaim);
    for (const auto& slot : this->slots) {
      slot.version.is(Place::kVersion);
      slot.stamp_ns.is(Place::kStamp);
      slot.bytes.is(Place::kBytes);
      for (const auto& word : slot.words) {
        word.is(Place::kWord);
      }
    }
  }
};

// Numbers tell their writer and, in their last two digits, the sequence they were published under.
constexpr std::uint64_t kSecondWriter = 100;

[[nodiscard]] inline Value value_of(std::uint64_t number) {
  const std::uint64_t count = 1 + (number + 2) / 2 % 2;
  Value value{count, {number, 0}};
  value.numbers[count - 1] = number;
  return value;
}

inline void publish(ValueWriter& writer, std::uint64_t from = 0) {
  const std::uint64_t number = from + writer.sequence() + 1;
  writer.publish(value_of(number), Time{Duration{static_cast<std::int64_t>(number)}});
}

struct Findings {
  std::size_t ways = 0;
  std::size_t values = 0;
  std::size_t torn = 0;         // a value that was never published
  std::size_t mislabelled = 0;  // a whole value under another one's number or stamp
  std::size_t backwards = 0;    // an older value after a newer one
  std::size_t lost = 0;         // a value was not given although it must have been
  std::size_t refused = 0;      // a value was called not sane, and none that is not was published
  std::size_t unordered = 0;    // stores of two threads to one place, with no order between them

  [[nodiscard]] std::size_t wrong() const {
    return torn + mislabelled + backwards + lost + refused + unordered;
  }
};

inline std::ostream& operator<<(std::ostream& out, const Findings& found) {
  return out << found.ways << " ways, " << found.values << " values, " << found.torn << " torn, "
             << found.mislabelled << " mislabelled, " << found.backwards << " backwards, "
             << found.lost << " lost, " << found.refused << " refused, " << found.unordered
             << " unordered";
}

// Looks at what one reader is given.
class Judge {
 public:
  explicit Judge(Findings& findings) : findings_{findings} {}

  void operator()(const Stamped<Value>* got) {
    if (got == nullptr) {
      return;
    }
    const std::uint64_t number = got->value.numbers[0];
    const Value published = value_of(number);
    ++findings_.values;
    findings_.torn += got->value.count != published.count ||
                              (published.count == 2 && got->value.numbers[1] != number)
                          ? 1U
                          : 0U;
    const auto stamp = static_cast<std::uint64_t>(got->stamp.time_since_epoch().count());
    findings_.mislabelled += number % kSecondWriter != got->sequence || stamp != number ? 1U : 0U;
    findings_.backwards += number < last_ ? 1U : 0U;
    last_ = number;
  }
  void must_be(const Stamped<Value>* got, std::uint64_t number) {
    (*this)(got);
    findings_.lost += got == nullptr || got->value.numbers[0] != number ? 1U : 0U;
  }

 private:
  Findings& findings_;
  std::uint64_t last_ = 0;
};

// Until something is wrong.
template <class Story>
Findings play(Memory& memory, const Story& story) {
  Findings findings;
  findings.ways = memory.explore([&] {
    story(findings);
    findings.unordered = memory.unordered();
    return findings.wrong() == 0;
  });
  return findings;
}

enum class By { kLatest, kNext, kNumber };

[[nodiscard]] inline const Stamped<Value>* look(ValueReader& reader, By by) {
  switch (by) {
    case By::kLatest: return reader.latest();
    case By::kNext: return reader.next();
    case By::kNumber: break;
  }
  return reader.at(reader.newest_sequence());
}

// Protocols that are wrong on purpose, made from the stores of the right one.
enum class Wrong {
  kNothing,
  kNotMarkedOdd,       // the writer does not say that it is about to change a slot
  kAnnouncedFirst,     // `newest` before the value
  kSaidWholeTooEarly,  // version and `newest` before the last word
};

using Stores = std::vector<Memory::Store>;

template <std::size_t kDepth>
Stores made_wrong(Stores stores, const Ring<kDepth>& ring, Wrong wrong) {
  const auto is_odd = [&](const Memory::Store& store) {
    return store.value % 2 == 1 &&
           std::any_of(ring.slots.begin(), ring.slots.end(),
                       [&](const auto& slot) { return slot.version.at() == store.at; });
  };
  if (wrong == Wrong::kNotMarkedOdd) {
    stores.erase(std::remove_if(stores.begin(), stores.end(), is_odd), stores.end());
  }
  for (auto store = stores.begin(); store != stores.end(); ++store) {
    if (store->at != ring.head.newest.at()) {
      continue;
    }
    if (wrong == Wrong::kSaidWholeTooEarly) {
      std::rotate(store - 2, store - 1, store + 1);  // word, version, newest
    }
    if (wrong == Wrong::kAnnouncedFirst) {
      const auto odd = std::find_if(std::make_reverse_iterator(store), stores.rend(), is_odd);
      std::rotate(odd.base() - 1, store, store + 1);
    }
  }
  return stores;
}

template <std::size_t kDepth>
void publish_all(Memory& memory, Ring<kDepth>& ring, ValueWriter& writer, int count, Wrong wrong) {
  Stores stores;
  memory.hold_back(stores);
  for (int i = 0; i < count; ++i) {
    publish(writer);
  }
  memory.perform(made_wrong(std::move(stores), ring, wrong));
}

// A writer goes round its ring twice while a reader looks twice; then everything has arrived.
inline Findings written_over(Memory& memory, By by, Wrong wrong = Wrong::kNothing) {
  return play(memory, [&](Findings& findings) {
    Ring<2> ring;
    Thread low;
    Thread high;
    memory.run_as(low);
    ValueWriter writer{ring, Role::kLow, "ring"};
    publish_all(memory, ring, writer, 4, wrong);
    memory.run_as(high);
    ValueReader reader{ring};
    Judge judge{findings};
    judge(look(reader, by));
    judge(look(reader, by));
    Memory::tell(low, high);
    judge.must_be(reader.latest(), 4);
    findings.refused += reader.refused();
    memory.run_as(low);
  });
}

// Nothing is written over: whatever number a reader has heard of, it can have.
inline Findings kept(Memory& memory, Wrong wrong = Wrong::kNothing) {
  return play(memory, [&](Findings& findings) {
    Ring<3> ring;
    Thread low;
    Thread high;
    memory.run_as(low);
    ValueWriter writer{ring, Role::kLow, "ring"};
    publish_all(memory, ring, writer, 3, wrong);
    memory.run_as(high);
    ValueReader reader{ring};
    Judge judge{findings};
    const std::uint64_t heard = reader.newest_sequence();
    for (std::uint64_t number = 1; number <= heard; ++number) {
      judge.must_be(reader.next(), number);
    }
    if (heard > 0) {
      ValueReader late{ring};
      Judge{findings}.must_be(late.at(heard), heard);
    }
    memory.run_as(low);
  });
}

// One writer ends and another begins, on another thread; a reader looks at both.
inline Findings handed_over(Memory& memory, By by) {
  return play(memory, [&](Findings& findings) {
    Ring<2> ring;
    Thread first;
    Thread second;
    Thread high;
    memory.run_as(first);
    {
      ValueWriter writer{ring, Role::kLow, "ring"};
      publish(writer);
      publish(writer);
    }
    memory.run_as(second);
    ValueWriter writer{ring, Role::kLow, "ring"};
    publish(writer, kSecondWriter);
    publish(writer, kSecondWriter);
    memory.run_as(high);
    ValueReader reader{ring};
    Judge judge{findings};
    judge(look(reader, by));
    judge(look(reader, by));
    Memory::tell(second, high);
    judge.must_be(reader.latest(), kSecondWriter + writer.sequence());
    findings.refused += reader.refused();
    memory.run_as(second);
  });
}

// A writer is killed before any of its stores. Who is told of it finds the last whole value and
// frees the claim; then comes a successor that knows of nothing but the freed claim.
inline Findings killed(Memory& memory, By by) {
  return play(memory, [&](Findings& findings) {
    Ring<2> ring;
    Thread first;
    Thread watcher;
    Thread second;
    Thread high;
    memory.run_as(first);
    ValueWriter dead{ring, Role::kLow, "ring"};
    first.stores_left = memory.choose(3 * 8 + 1);
    for (int i = 0; i < 3; ++i) {
      publish(dead);
    }
    first.stores_left = 0;
    Memory::tell(first, watcher);
    memory.run_as(watcher);
    ValueReader last{ring};
    if (const std::uint64_t whole = last.newest_sequence(); whole > 0) {
      Judge{findings}.must_be(last.latest(), whole);
    }
    ring.release_claim_of(Role::kLow);
    memory.run_as(second);
    ValueWriter writer{ring, Role::kLow, "ring"};
    publish(writer, kSecondWriter);
    publish(writer, kSecondWriter);
    memory.run_as(high);
    ValueReader reader{ring};
    Judge judge{findings};
    judge(by == By::kNumber ? reader.at(1 + memory.choose(5)) : look(reader, by));
    judge(look(reader, by));
    Memory::tell(second, high);
    judge.must_be(reader.latest(), kSecondWriter + writer.sequence());
    findings.refused += reader.refused();
    memory.run_as(first);
  });
}

// The head announces what is not there, or not yet: a value is whole all the same.
inline Findings forged(Memory& memory, By by) {
  return play(memory, [&](Findings& findings) {
    Ring<2> ring;
    Thread low;
    Thread high;
    memory.run_as(low);
    ValueWriter writer{ring, Role::kLow, "ring"};
    ring.head.newest.store(4, std::memory_order_relaxed);
    for (int i = 0; i < 4; ++i) {
      publish(writer);
    }
    memory.run_as(high);
    ValueReader reader{ring};
    Judge{findings}(look(reader, by));
    Judge{findings}(look(reader, by));
    memory.run_as(low);
  });
}

// Who has seen the answer to a question sees that question too, though it was told of neither.
inline Findings answered(Memory& memory) {
  return play(memory, [&](Findings& findings) {
    Ring<2> questions;
    Ring<2> answers;
    Thread asking;
    Thread answering;
    Thread looking;
    memory.run_as(asking);
    {
      ValueWriter writer{questions, Role::kHigh, "questions"};
      publish(writer);
      publish(writer);
    }
    memory.run_as(answering);
    {
      ValueWriter writer{answers, Role::kLow, "answers"};
      ValueReader reader{questions};
      Judge judge{findings};
      for (int i = 0; i < 2; ++i) {
        if (const auto* question = reader.latest(); question != nullptr) {
          judge(question);
          writer.publish(question->value, question->stamp);
        }
      }
    }
    memory.run_as(looking);
    ValueReader seen{answers};
    if (const auto* answer = seen.latest(); answer != nullptr) {
      ValueReader reader{questions};
      const auto* question = reader.latest();
      const bool there =
          question != nullptr && question->value.numbers[0] >= answer->value.numbers[0];
      findings.lost += there ? 0U : 1U;
    }
  });
}

}  // namespace lodesman::weak
