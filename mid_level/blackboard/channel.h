// SPDX-License-Identifier: Apache-2.0
// A channel: one writer, many readers, a ring of the last few whole values. There is no lock and no
// pointer in it, so it may lie in shared memory, and a writer that is killed in the middle of a
// publication leaves the last whole value in place. publish() and the Reader's calls are wait-free
// or bounded and allocate nothing; a Writer or Reader belongs to one thread.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "mid_level/base/check.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/base/time.h"
#include "mid_level/blackboard/bell.h"
#include "mid_level/blackboard/channel_look.h"
#include "mid_level/messages/fields.h"
#include "mid_level/messages/sane.h"

namespace lodesman {

template <class T>
concept Wire = std::is_trivially_copyable_v<T> && std::is_standard_layout_v<T> &&
    std::is_default_constructible_v<T> && HasFields<T>;

// A published value. `sequence` counts the publications of a channel from 1 on.
template <class T>
struct Stamped {
  T value{};
  Time stamp{};
  std::uint64_t sequence = 0;
};

// What is not lock-free has a lock in this process, which another process does not know of.
static_assert(std::atomic<std::uint64_t>::is_always_lock_free &&
              std::atomic<std::int64_t>::is_always_lock_free &&
              std::atomic<std::uint32_t>::is_always_lock_free);

// Which program writes a channel; stored in the channel as its writer's claim.
enum class Role : std::uint32_t { kNobody = 0, kLow = 1, kHigh = 2 };

// One place of a ring. The value lies in 64-bit atomic words; the version is odd while they change.
// What each order is for (tests/unit/blackboard/memory_order.cpp takes each away, and fails):
// - stamp, size and words, release and acquire: whoever reads a new one also sees the odd version
//   before it, so that his second look at the version differs. That look and the odd store may then
//   be relaxed themselves.
// - the even version, release and acquire: whoever reads it sees all of the value, whatever number
//   the head announces.
// - newest, release and acquire: whoever hears of a number can have it, or it was written over.
// - the writer's claim: a successor begins after its predecessor's last number.
// There is no stand-alone fence: the thread sanitizer does not model them.
template <Wire T, template <class> class Atomic = std::atomic>
struct ChannelSlot {
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
  Atomic<std::uint64_t> version{0};  // 2 s - 1 while value s is written, 2 s once it is whole
  Atomic<std::int64_t> stamp_ns{0};
  Atomic<std::uint64_t> bytes{0};  // how much of the value was written
  std::array<Atomic<std::uint64_t>, kWords> words{};
};

template <Wire T, template <class> class Atomic = std::atomic>
struct ChannelHead {
  alignas(64) Atomic<std::uint64_t> newest{0};  // sequence of the last whole value
  Atomic<std::uint32_t> writer{0};              // the Role that claimed it
};

// Atomic is std::atomic; a test puts one in its place that lets it choose what comes before what.
template <Wire T, std::size_t kDepth, template <class> class Atomic = std::atomic>
class Channel {
  static_assert(kDepth >= 2, "a ring needs a whole value beside the one being written");

 public:
  using Value = T;
  static constexpr std::size_t kSlots = kDepth;

  ChannelHead<T, Atomic> head;
  std::array<ChannelSlot<T, Atomic>, kDepth> slots;

  // Frees the claim of a program that is known to be dead; true where there was one.
  bool release_claim_of(Role role) noexcept {
    auto held = static_cast<std::uint32_t>(role);
    return head.writer.compare_exchange_strong(held, 0, std::memory_order_acq_rel);
  }

  // Whether a successor of its writer can go on with it: the value that the head announces has
  // been in its place, and whoever claims it is the one that may. A living writer does no harm.
  [[nodiscard]] bool is_sound(Role writer) const noexcept {
    const std::uint64_t newest = head.newest.load(std::memory_order_acquire);
    const std::uint32_t claim = head.writer.load(std::memory_order_acquire);
    return newest <= kLastSequence &&
           slots[newest % kDepth].version.load(std::memory_order_acquire) >= 2 * newest &&
           (claim == 0 || claim == static_cast<std::uint32_t>(writer));
  }
};

// No publication wakes more tasks than this.
inline constexpr std::size_t kMaxWoken = 2;

// The one writer of a channel: made once, before the tasks run. It rings the bells it was given
// after each publication; writer_of() in blackboard.h gives it those of its channel.
template <Wire T, template <class> class Atomic = std::atomic>
class Writer {
 public:
  // Throws StartupError when the channel has a writer already.
  template <std::size_t kDepth>
  Writer(Channel<T, kDepth, Atomic>& channel, Role role, const char* name)
      : head_{&channel.head}, slots_{channel.slots.data()}, count_{kDepth} {
    std::uint32_t nobody = 0;
    if (!head_->writer.compare_exchange_strong(nobody, static_cast<std::uint32_t>(role),
                                               std::memory_order_acq_rel)) {
      head_ = nullptr;
      throw StartupError(std::string{"channel "} + name + " already has a writer");
    }
    sequence_ = head_->newest.load(std::memory_order_acquire);
    pass_over_ghost();
  }
  Writer(Writer&& other) noexcept
      : head_{std::exchange(other.head_, nullptr)},
        slots_{other.slots_},
        count_{other.count_},
        sequence_{other.sequence_},
        bells_{other.bells_},
        bell_count_{other.bell_count_} {}
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  Writer& operator=(Writer&&) = delete;
  ~Writer() {
    if (head_ != nullptr) {
      head_->writer.store(0, std::memory_order_release);
    }
  }

  // From now on it rings this bell too. The bell must outlive the writer.
  void rings(Bell<Atomic>& bell) noexcept {
    LODESMAN_CHECK(bell_count_ < kMaxWoken);
    bells_[bell_count_++] = &bell;
  }

  void publish(const T& value, Time now) noexcept {
    publish_quietly(value, now);
    for (std::size_t i = 0; i < bell_count_; ++i) {
      ring(*bells_[i]);
    }
  }

  // For what is no news: nobody is woken.
  void publish_quietly(const T& value, Time now) noexcept {
    const std::uint64_t sequence = ++sequence_;
    ChannelSlot<T, Atomic>& slot = slots_[sequence % count_];
    const std::size_t bytes = used_bytes(value);
    LODESMAN_CHECK(bytes <= sizeof(T));
    slot.version.store(2 * sequence - 1, std::memory_order_relaxed);
    slot.stamp_ns.store(now.time_since_epoch().count(), std::memory_order_release);
    slot.bytes.store(bytes, std::memory_order_release);
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    std::size_t word = 0;
    for (; (word + 1) * 8 <= bytes; ++word) {
      std::uint64_t bits;
      std::memcpy(&bits, from + word * 8, 8);
      slot.words[word].store(bits, std::memory_order_release);
    }
    if (word * 8 < bytes) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, from + word * 8, bytes - word * 8);
      slot.words[word].store(bits, std::memory_order_release);
    }
    slot.version.store(2 * sequence, std::memory_order_release);
    head_->newest.store(sequence, std::memory_order_release);
  }

  // The next publication has the number after this one, which must not be below the last: numbers
  // of a recording are those that they were.
  void go_on_after(std::uint64_t sequence) noexcept {
    LODESMAN_CHECK(sequence >= sequence_ && sequence < kLastSequence);
    sequence_ = sequence;
  }

  // Of the last publication, or of the ghost that its predecessor left.
  [[nodiscard]] std::uint64_t sequence() const noexcept { return sequence_; }

 private:
  // A predecessor that was killed while it published may have left the value after the newest in
  // its place, half or whole, but not announced. That number is never used again: a reader that
  // copies the ghost would take half of it and half of its namesake for one whole value. Nor does
  // the ghost ever come to count, however whole it is.
  void pass_over_ghost() noexcept {
    const std::uint64_t ghost = sequence_ + 1;
    auto& version = slots_[ghost % count_].version;
    if (version.load(std::memory_order_acquire) + 1 >= 2 * ghost) {
      version.store(2 * ghost - 1, std::memory_order_release);
      sequence_ = ghost;
    }
  }

  ChannelHead<T, Atomic>* head_;
  ChannelSlot<T, Atomic>* slots_;
  std::size_t count_;
  std::uint64_t sequence_ = 0;
  std::array<Bell<Atomic>*, kMaxWoken> bells_{};
  std::size_t bell_count_ = 0;
};

// A reader with a copy of its own: what it hands out stays valid until its next call, and is sane.
// What is published and is not sane is passed over, as if it had never been published, and counted.
template <Wire T, template <class> class Atomic = std::atomic>
class Reader : public ChannelLook<Atomic> {
 public:
  using ChannelLook<Atomic>::newest_sequence;

  template <std::size_t kDepth>
  explicit Reader(const Channel<T, kDepth, Atomic>& channel)
      : ChannelLook<Atomic>{channel.head.newest},
        slots_{channel.slots.data()},
        count_{kDepth},
        held_{std::make_unique<Stamped<T>>()},
        spare_{std::make_unique<Stamped<T>>()} {}

  // The newest whole value; nullptr as long as there was none.
  [[nodiscard]] const Stamped<T>* latest() noexcept {
    for (std::size_t attempt = 0; attempt < kMaxAttempts; ++attempt) {
      const std::uint64_t newest = newest_sequence();
      if (newest == 0 || newest == held_->sequence || is_behind_held(newest)) {
        break;
      }
      const Taken taken = take(newest);
      if (taken == Taken::kNotSane) {
        take_newest_before(newest, [](const Stamped<T>&) { return true; });
      }
      if (taken != Taken::kNotWhole) {
        break;
      }
      this->look_again();
    }
    return held_->sequence == 0 ? nullptr : held_.get();
  }

  // The newest value that was measured (or, where it does not say when, published) in the time from
  // now - max_age to now; nullptr when there is none. What is later than `now`, as another thread's
  // may be by a moment, is not of now yet.
  [[nodiscard]] const Stamped<T>* fresh(Time now, Duration max_age) noexcept {
    const Stamped<T>* newest = latest();
    if (newest != nullptr && measured_at(*newest) > now) {
      const std::uint64_t later = newest->sequence;
      newest = take_newest_before(
                   later, [now](const Stamped<T>& value) { return measured_at(value) <= now; })
                   ? held_.get()
                   : nullptr;
    }
    // Times are at least 0, so that their difference is one too.
    return newest != nullptr && now - measured_at(*newest) <= max_age ? newest : nullptr;
  }

  // The oldest value after the one held that the ring still has; nullptr when there is none yet.
  // Values that were overwritten before they were read are counted in missed().
  [[nodiscard]] const Stamped<T>* next() noexcept {
    const std::uint64_t held = held_->sequence;
    std::uint64_t wanted = held + 1;
    for (std::size_t attempt = 0; attempt < kMaxAttempts + count_; ++attempt) {
      const std::uint64_t newest = newest_sequence();
      if (newest < wanted) {
        if (newest < held && !is_behind_held(newest)) {
          held_->sequence = newest;
        }
        return nullptr;
      }
      const std::uint64_t oldest = newest >= count_ ? newest - count_ + 1 : 1;
      wanted = std::max(wanted, oldest);
      if (take(wanted) == Taken::kWhole) {
        missed_ += wanted - held - 1;
        return held_.get();
      }
      // Its slot is being written over, perhaps for ever by a writer that is dead: it is gone.
      if (is_written_over(wanted)) {
        this->look_again();
      }
      ++wanted;
    }
    return nullptr;
  }

  // The value with this sequence number; nullptr when the ring no longer (or not yet) has it.
  [[nodiscard]] const Stamped<T>* at(std::uint64_t sequence) noexcept {
    if (sequence == 0 || sequence > newest_sequence()) {
      return nullptr;  // what is not announced does not count, even if it is whole
    }
    if (held_->sequence == sequence || take(sequence) == Taken::kWhole) {
      return held_.get();
    }
    note_if_written_over(sequence);
    return nullptr;
  }

  [[nodiscard]] std::uint64_t missed() const noexcept { return missed_; }
  // How many values were passed over because they were not sane.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  static constexpr std::size_t kMaxAttempts = 64;
  enum class Taken : std::uint8_t { kWhole, kNotWhole, kNotSane };

  [[nodiscard]] static Time measured_at(const Stamped<T>& published) noexcept {
    if constexpr (HasMeasuredAt<T>) {
      return published.value.measured_at();
    } else {
      return published.stamp;
    }
  }

  // Whether a head below the value held is what is wrong: as long as that value stands in its
  // place it was the newest. If it does not, it was never what the head said then.
  [[nodiscard]] bool is_behind_held(std::uint64_t newest) const noexcept {
    const std::uint64_t held = held_->sequence;
    return newest < held &&
           slots_[held % count_].version.load(std::memory_order_acquire) == 2 * held;
  }

  // Whether a later value has the place of this one, or is about to.
  [[nodiscard]] bool is_written_over(std::uint64_t sequence) const noexcept {
    return slots_[sequence % count_].version.load(std::memory_order_acquire) > 2 * sequence;
  }
  void note_if_written_over(std::uint64_t sequence) noexcept {
    if (is_written_over(sequence)) {
      this->note_written_over();
    }
  }

  // Takes the newest whole and sane value older than `sequence` that the ring has and that is
  // wanted; the one held counts too.
  template <class Wanted>
  bool take_newest_before(std::uint64_t sequence, Wanted wanted) noexcept {
    for (std::size_t back = 1; back < count_ && back < sequence; ++back) {
      const std::uint64_t older = sequence - back;
      if ((older == held_->sequence || take(older) == Taken::kWhole) && wanted(*held_)) {
        return true;
      }
      note_if_written_over(older);
    }
    return false;
  }

  // Copies value `sequence` into held_; leaves held_ as it was when that value is not whole or not
  // sane.
  [[nodiscard]] Taken take(std::uint64_t sequence) noexcept {
    const ChannelSlot<T, Atomic>& slot = slots_[sequence % count_];
    if (slot.version.load(std::memory_order_acquire) != 2 * sequence) {
      return Taken::kNotWhole;
    }
    const std::int64_t stamp_ns = slot.stamp_ns.load(std::memory_order_acquire);
    const std::uint64_t bytes = slot.bytes.load(std::memory_order_acquire);
    auto* to = reinterpret_cast<std::byte*>(&spare_->value);
    const std::uint64_t copied = std::min<std::uint64_t>(bytes, sizeof(T));
    std::size_t word = 0;
    for (; (word + 1) * 8 <= copied; ++word) {
      const std::uint64_t bits = slot.words[word].load(std::memory_order_acquire);
      std::memcpy(to + word * 8, &bits, 8);
    }
    if (word * 8 < copied) {
      const std::uint64_t bits = slot.words[word].load(std::memory_order_acquire);
      std::memcpy(to + word * 8, &bits, copied - word * 8);
    }
    if (slot.version.load(std::memory_order_relaxed) != 2 * sequence) {
      return Taken::kNotWhole;
    }
    spare_->stamp = Time{Duration{stamp_ns}};
    spare_->sequence = sequence;
    if (!sane(spare_->stamp) || !sane(spare_->value) || used_bytes(spare_->value) != bytes) {
      if (sequence > last_refused_ || sequence + count_ <= last_refused_) {
        ++refused_;
        last_refused_ = sequence;
      }
      return Taken::kNotSane;
    }
    std::swap(held_, spare_);
    return Taken::kWhole;
  }

  const ChannelSlot<T, Atomic>* slots_;
  std::size_t count_;
  std::unique_ptr<Stamped<T>> held_;
  std::unique_ptr<Stamped<T>> spare_;
  std::uint64_t missed_ = 0;
  std::uint64_t refused_ = 0;
  std::uint64_t last_refused_ = 0;  // each is counted once, however often it is met
};

}  // namespace lodesman
