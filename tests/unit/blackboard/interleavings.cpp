// SPDX-License-Identifier: Apache-2.0
// The channel's protocol in every order in which one writer and one reader can meet. The writer's
// stores are noted down as publish() makes them; then latest() or next() runs again and again, and
// before each of its loads a chosen number of those stores is let through, until all choices have
// been made. The same search over protocols that are wrong on purpose must find them out: they are
// made by changing the notes, so that the code under test is the channel's own.
#include <algorithm>
#include <functional>
#include <vector>

#include "mid_level/blackboard/channel.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

struct Store {
  std::function<void()> apply;
  const void* where = nullptr;
  std::uint64_t value = 0;
};

// The one meeting that is being played. A single thread plays both sides.
struct Meeting {
  std::vector<Store>* notes = nullptr;  // where stores go; nullptr: they take place at once
  std::function<void()> before_load = [] {};
};
Meeting meeting;  // NOLINT: the atomics below have no other way to know of it

template <class T>
class PlayedAtomic {
 public:
  constexpr PlayedAtomic(T value = T{}) noexcept : value_{value} {}  // NOLINT: as std::atomic
  void store(T value, std::memory_order) noexcept {
    if (meeting.notes == nullptr) {
      value_ = value;
      return;
    }
    meeting.notes->push_back(
        {[this, value] { value_ = value; }, this, static_cast<std::uint64_t>(value)});
  }
  [[nodiscard]] T load(std::memory_order) const noexcept {
    meeting.before_load();
    return value_;
  }
  bool compare_exchange_strong(T& expected, T wanted, std::memory_order) noexcept {
    const bool same = value_ == expected;
    (same ? value_ : expected) = same ? wanted : value_;
    return same;
  }

 private:
  T value_;
};

// Two words of one number: torn where they differ.
struct Value {
  std::uint64_t first = 0;
  std::uint64_t second = 0;
  static constexpr auto fields() noexcept {
    return std::tuple{field("first", &Value::first), field("second", &Value::second)};
  }
};

using PlayedChannel = Channel<Value, 2, PlayedAtomic>;
using PlayedReader = Reader<Value, PlayedAtomic>;
using Notes = std::vector<Store>;

void publish(Writer<Value, PlayedAtomic>& writer, std::uint64_t number) {
  writer.publish({number, number}, Time{Duration{static_cast<std::int64_t>(number)}});
}

struct Findings {
  std::size_t meetings = 0;
  std::size_t torn = 0;         // a value that was never published
  std::size_t mislabelled = 0;  // a whole value under another one's number or stamp
  std::size_t backwards = 0;
  std::size_t last_missing = 0;  // the reader never got to the last value
  std::size_t values = 0;
};

void judge(const Stamped<Value>* got, std::uint64_t& last, Findings& findings) {
  if (got == nullptr) {
    return;
  }
  const Value& value = got->value;
  const auto stamp = static_cast<std::uint64_t>(got->stamp.time_since_epoch().count());
  ++findings.values;
  findings.torn += value.first != value.second ? 1U : 0U;
  findings.mislabelled += value.first != got->sequence || stamp != got->sequence ? 1U : 0U;
  findings.backwards += got->sequence < last ? 1U : 0U;
  last = got->sequence;
}

enum class Wrong {
  kNothing,
  kNotMarkedOdd,       // the writer does not say that it is about to change a slot
  kAnnouncedFirst,     // `newest` before the value
  kSaidWholeTooEarly,  // version and `newest` before the last word
};

// What the wrong writers would have stored, from what the right one did.
Notes made_wrong(Notes notes, const PlayedChannel& channel, Wrong wrong) {
  const auto is_version = [&](const Store& store) {
    return store.where == &channel.slots[0].version || store.where == &channel.slots[1].version;
  };
  const auto is_odd = [&](const Store& store) { return is_version(store) && store.value % 2 == 1; };
  const auto is_newest = [&](const Store& store) { return store.where == &channel.head.newest; };
  if (wrong == Wrong::kNotMarkedOdd) {
    notes.erase(std::remove_if(notes.begin(), notes.end(), is_odd), notes.end());
  }
  for (std::size_t i = 1; i < notes.size(); ++i) {
    if (wrong == Wrong::kSaidWholeTooEarly && is_newest(notes[i])) {
      std::rotate(&notes[i - 2], &notes[i - 1], &notes[i] + 1);  // word, version, newest
    }
    if (wrong == Wrong::kAnnouncedFirst && is_newest(notes[i])) {
      for (std::size_t j = i; j > 0 && !is_odd(notes[j]); --j) {
        std::swap(notes[j], notes[j - 1]);
      }
    }
  }
  return notes;
}

// A way through all choices: a number a load, counted up like a number of many digits. Loads
// after the first kLoads, when the reader tries again, find no further stores: they are another
// meeting's first.
class Choices {
 public:
  // `newest`, all that taking one value loads, and `newest` again.
  static constexpr std::size_t kLoads = 8;

  // How many of `left` stores go before the next load.
  [[nodiscard]] std::size_t next(std::size_t left) {
    if (at_ == kLoads) {
      return 0;
    }
    if (at_ == taken_.size()) {
      taken_.push_back({0, left});
    }
    taken_[at_].left = left;
    return taken_[at_++].chosen;
  }
  // The next way; false after the last.
  [[nodiscard]] bool advance() {
    taken_.resize(at_);
    at_ = 0;
    while (!taken_.empty() && taken_.back().chosen == taken_.back().left) {
      taken_.pop_back();
    }
    if (taken_.empty()) {
      return false;
    }
    ++taken_.back().chosen;
    return true;
  }

 private:
  struct Choice {
    std::size_t chosen;
    std::size_t left;
  };
  std::vector<Choice> taken_;
  std::size_t at_ = 0;
};

// One value is there; `publications` more meet the first call of a reader. Then the writer ends,
// or was killed: nothing after the last store let through ever comes.
Findings play(std::uint64_t publications, bool one_by_one, Wrong wrong, bool killed) {
  Findings findings;
  Choices choices;
  do {
    PlayedChannel channel;
    meeting = {};
    Notes notes;
    Writer<Value, PlayedAtomic> writer{channel, Role::kLow, "played"};
    publish(writer, 1);
    PlayedReader reader{channel};
    std::uint64_t last = 0;
    meeting.notes = &notes;
    for (std::uint64_t i = 0; i < publications; ++i) {
      publish(writer, 2 + i);
    }
    meeting.notes = nullptr;
    notes = made_wrong(std::move(notes), channel, wrong);
    std::size_t let_through = 0;
    meeting.before_load = [&] {
      for (std::size_t n = choices.next(notes.size() - let_through); n > 0; --n) {
        notes[let_through++].apply();
      }
    };
    if (killed) {
      // A single choice: how far it got. The reader comes when it is long dead.
      meeting.before_load();
      meeting.before_load = [] {};
    }
    judge(one_by_one ? reader.next() : reader.latest(), last, findings);
    meeting.before_load = [] {};
    while (!killed && let_through < notes.size()) {
      notes[let_through++].apply();
    }
    judge(reader.latest(), last, findings);  // everything is there by now
    findings.last_missing += !killed && last != 1 + publications ? 1U : 0U;
    ++findings.meetings;
    meeting = {};
  } while (choices.advance());
  return findings;
}

}  // namespace

TEST_CASE("channel: whole values in order, whenever a reader looks while two are published",
          "[mid_level][blackboard]") {
  for (const bool one_by_one : {false, true}) {
    const Findings found = play(2, one_by_one, Wrong::kNothing, false);
    CHECK(found.meetings > 10000);
    CHECK(found.values > found.meetings);
    CHECK(found.torn == 0);
    CHECK(found.mislabelled == 0);
    CHECK(found.backwards == 0);
    CHECK((one_by_one || found.last_missing == 0));
  }
}

TEST_CASE("channel: a writer that dies between any two stores leaves the last whole value",
          "[mid_level][blackboard]") {
  for (const bool one_by_one : {false, true}) {
    const Findings found = play(3, one_by_one, Wrong::kNothing, true);
    CHECK(found.meetings > 20);
    CHECK(found.values >= 2 * found.meetings);
    CHECK(found.torn + found.mislabelled + found.backwards == 0);
  }
}

TEST_CASE("channel: protocols that are wrong on purpose are found out", "[mid_level][blackboard]") {
  CHECK(play(2, false, Wrong::kNotMarkedOdd, false).torn > 0);
  CHECK(play(2, false, Wrong::kSaidWholeTooEarly, false).torn > 0);
  const Findings announced = play(2, false, Wrong::kAnnouncedFirst, true);
  CHECK(announced.values < 2 * announced.meetings);  // the last whole value was lost
}
