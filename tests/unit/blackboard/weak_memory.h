// SPDX-License-Identifier: Apache-2.0
// C++'s atomics as their standard means them, and not as this machine happens to run them: a model
// in which every load chooses among all the stores that it may read, and a search through all
// choices. One thread plays every thread of a story, one after the other.
//
// Each place keeps the order of its stores (modification order). Each thread has a view: for every
// place the oldest store that it may still read. A store with release carries its thread's view,
// one without carries only itself; a load with acquire joins the view that it finds; an exchange
// reads the newest store and passes on the view that it finds there (release sequence). What the
// model leaves out cannot happen here: a thread that stores first and loads later, or the other way
// round, in a circle with another; fences; sequentially consistent order.
//
// A thread's part may be played as a whole before the parts of those that read it: who would have
// looked earlier chooses the older stores instead. So the choices of the loads hold every schedule,
// as long as no two threads store to one place without order between them (unordered()).
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

namespace lodesman::weak {

// What an atomic is to the channel.
enum class Place : std::uint8_t { kNewest, kClaim, kVersion, kStamp, kBytes, kWord, kBell, kOther };
enum class Access : std::uint8_t { kLoad, kStore, kExchange };
enum class Half : std::uint8_t { kAcquire, kRelease };

// One acquire or release of the protocol.
struct Site {
  Place place = Place::kOther;
  Access access = Access::kLoad;
  Half half = Half::kAcquire;
  friend auto operator<=>(const Site&, const Site&) = default;
};

// A way through all choices, counted up like a number of many digits.
class Choices {
 public:
  // Choices after this many are no choices: they take 0, the newest. A reader that tries again and
  // again has no choice that it did not have before.
  static constexpr std::size_t kCount = 12;

  [[nodiscard]] std::size_t choose(std::size_t options) {
    if (options < 2 || at_ == kCount) {
      return 0;
    }
    if (at_ == taken_.size()) {
      taken_.push_back({0, options});
    }
    return taken_[at_++].chosen;
  }
  // The next way; false after the last.
  [[nodiscard]] bool advance() {
    taken_.resize(at_);
    at_ = 0;
    while (!taken_.empty() && taken_.back().chosen + 1 == taken_.back().options) {
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
    std::size_t options;
  };
  std::vector<Choice> taken_;
  std::size_t at_ = 0;
};

class Memory {
 public:
  static constexpr std::size_t kPlaces = 32;
  using View = std::array<std::uint8_t, kPlaces>;
  struct Thread {
    View view{};
    std::size_t stores_left = SIZE_MAX;  // it is killed before the one after these
  };
  struct Store {
    std::size_t at;
    std::uint64_t value;
    bool release;
  };

  explicit Memory(std::optional<Site> weakened = {}) : weakened_{weakened} { current = this; }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { current = nullptr; }

  // Plays `story` once for every way through all choices, as long as it returns true. Returns how
  // many ways that were.
  template <class Story>
  std::size_t explore(const Story& story) {
    for (std::size_t ways = 1;; ++ways) {
      used_ = 0;
      held_back_ = nullptr;
      Thread first;
      run_as(first);
      if (!story() || !choices_.advance()) {
        return ways;
      }
    }
  }

  void run_as(Thread& thread) noexcept { thread_ = &thread; }
  // From now on `later` sees all that `earlier` saw and did, by means other than this memory: the
  // kernel that tells of a death, say.
  static void tell(const Thread& earlier, Thread& later) noexcept {
    join(later.view, earlier.view);
  }
  [[nodiscard]] std::size_t choose(std::size_t options) { return choices_.choose(options); }

  // Until perform(), stores are noted down instead of being made.
  void hold_back(std::vector<Store>& stores) noexcept { held_back_ = &stores; }
  void perform(const std::vector<Store>& stores) {
    held_back_ = nullptr;
    for (const Store& store : stores) {
      append(store.at, store.value, store.release, View{});
    }
  }

  [[nodiscard]] std::size_t add(std::uint64_t value) {
    if (used_ == kPlaces) {
      throw std::length_error("weak_memory.h: more atomics than Memory::kPlaces");
    }
    places_[used_] = Place::kOther;
    history_[used_].assign(1, {value, View{}});
    return used_++;
  }
  void name(std::size_t at, Place place) noexcept { places_[at] = place; }

  [[nodiscard]] std::uint64_t load(std::size_t at, std::memory_order order) {
    const auto& history = history_[at];
    const std::size_t readable = history.size() - thread_->view[at];
    return read(at, history.size() - 1 - choices_.choose(readable),
                asks(at, Access::kLoad, Half::kAcquire, order));
  }
  void store(std::size_t at, std::uint64_t value, std::memory_order order) {
    const bool release = asks(at, Access::kStore, Half::kRelease, order);
    if (held_back_ != nullptr) {
      held_back_->push_back({at, value, release});
    } else {
      append(at, value, release, View{});
    }
  }
  // Returns what it found; stores `wanted` where that was `expected`.
  std::uint64_t exchange(std::size_t at, std::uint64_t expected, std::uint64_t wanted,
                         std::memory_order order) {
    const bool acquire = asks(at, Access::kExchange, Half::kAcquire, order);
    const bool release = asks(at, Access::kExchange, Half::kRelease, order);
    const View passed_on = history_[at].back().view;
    const std::uint64_t found = read(at, history_[at].size() - 1, acquire);
    if (found == expected) {
      append(at, wanted, release, passed_on);
    }
    return found;
  }

  // Adds to the newest store, and returns what it found there.
  std::uint64_t add_to(std::size_t at, std::uint64_t amount, std::memory_order order) {
    const std::uint64_t found = history_[at].back().value;
    return exchange(at, found, found + amount, order);
  }

  // Every acquire and release that was asked for, weakened or not.
  [[nodiscard]] std::vector<Site> sites() const {
    std::vector<Site> sites;
    for (std::size_t i = 0; i < kSites; ++i) {
      if (asked_[i]) {
        sites.push_back(
            {static_cast<Place>(i / 6), static_cast<Access>(i / 2 % 3), static_cast<Half>(i % 2)});
      }
    }
    return sites;
  }
  // Stores whose thread had not seen the store before them at that place.
  [[nodiscard]] std::size_t unordered() const noexcept { return unordered_; }

  static inline Memory* current = nullptr;  // where atomics that are made now belong

 private:
  struct Message {
    std::uint64_t value;
    View view;
  };

  static constexpr std::size_t kSites = 8 * 3 * 2;
  [[nodiscard]] static std::size_t index_of(const Site& site) noexcept {
    return (static_cast<std::size_t>(site.place) * 3 + static_cast<std::size_t>(site.access)) * 2 +
           static_cast<std::size_t>(site.half);
  }
  static void join(View& view, const View& other) noexcept {
    for (std::size_t i = 0; i < kPlaces; ++i) {
      view[i] = std::max(view[i], other[i]);
    }
  }
  [[nodiscard]] bool asks(std::size_t at, Access access, Half half, std::memory_order order) {
    const bool asked =
        order == std::memory_order_acq_rel ||
        order == (half == Half::kAcquire ? std::memory_order_acquire : std::memory_order_release);
    const Site site{places_[at], access, half};
    asked_[index_of(site)] = asked_[index_of(site)] || asked;
    return asked && weakened_ != site;
  }
  [[nodiscard]] std::uint64_t read(std::size_t at, std::size_t index, bool acquire) noexcept {
    const Message& message = history_[at][index];
    thread_->view[at] = static_cast<std::uint8_t>(index);
    if (acquire) {
      join(thread_->view, message.view);
    }
    return message.value;
  }
  void append(std::size_t at, std::uint64_t value, bool release, const View& passed_on) {
    if (thread_->stores_left == 0) {
      return;
    }
    --thread_->stores_left;
    auto& history = history_[at];
    unordered_ += thread_->view[at] + 1U != history.size() ? 1U : 0U;
    thread_->view[at] = static_cast<std::uint8_t>(history.size());
    Message message{value, passed_on};
    message.view[at] = thread_->view[at];
    if (release) {
      join(message.view, thread_->view);
    }
    history.push_back(message);
  }

  std::optional<Site> weakened_;
  Choices choices_;
  std::array<std::vector<Message>, kPlaces> history_;
  std::array<Place, kPlaces> places_{};
  std::size_t used_ = 0;
  Thread* thread_ = nullptr;
  std::vector<Store>* held_back_ = nullptr;
  std::array<bool, kSites> asked_{};
  std::size_t unordered_ = 0;
};

// Stands where std::atomic would.
template <class T>
class Atomic {
 public:
  Atomic(T value = T{}) : at_{Memory::current->add(static_cast<std::uint64_t>(value))} {}  // NOLINT
  [[nodiscard]] T load(std::memory_order order) const noexcept {
    return static_cast<T>(Memory::current->load(at_, order));
  }
  void store(T value, std::memory_order order) noexcept {
    Memory::current->store(at_, static_cast<std::uint64_t>(value), order);
  }
  bool compare_exchange_strong(T& expected, T wanted, std::memory_order order) noexcept {
    const auto found = static_cast<T>(Memory::current->exchange(
        at_, static_cast<std::uint64_t>(expected), static_cast<std::uint64_t>(wanted), order));
    const bool same = found == expected;
    expected = found;
    return same;
  }
  T fetch_add(T amount, std::memory_order order) noexcept {
    return static_cast<T>(Memory::current->add_to(at_, static_cast<std::uint64_t>(amount), order));
  }
  void is(Place place) const noexcept { Memory::current->name(at_, place); }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }

 private:
  std::size_t at_;
};

}  // namespace lodesman::weak
