// SPDX-License-Identifier: Apache-2.0
// Hands the fixes of a NAV440's packets N0 and N1 from the task that polls the unit (the AHRS's) to
// the one that wants positions, and how the unit is. One writer, one reader, each its own thread or
// both the same; nobody waits.
//
// The ring has one index a side. The writer fills a slot and then stores `written_` with a release;
// the reader loads it with an acquire before it reads the slot, and stores `read_` with a release
// behind that; the writer loads `read_` with an acquire before it fills a slot anew. So a slot is
// never read and written at once, and a fix is read as it was written. Where the ring is full the
// newest is dropped. The state is one atomic word of its own: that it is a moment older or newer
// than a fix means nothing.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>

#include "mid_level/messages/health.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

class Nav440FixRelay {
 public:
  static constexpr std::size_t kCapacity = 16;

  // What is known of the unit by its last poll.
  struct alignas(2) State {  // clang takes a lock for an atomic that is not aligned to its size
    bool is_connected = false;
    DeviceFault fault = DeviceFault::kNone;
  };

  // Writer.
  bool push(const PositionFix& fix) noexcept {
    const std::size_t at = written_.load(std::memory_order_relaxed);
    if (at - read_.load(std::memory_order_acquire) == kCapacity) {
      return false;
    }
    ring_[at % kCapacity] = fix;
    written_.store(at + 1, std::memory_order_release);
    return true;
  }
  void tell(State state) noexcept { state_.store(state, std::memory_order_release); }

  // Reader.
  [[nodiscard]] std::optional<PositionFix> pop() noexcept {
    const std::size_t at = read_.load(std::memory_order_relaxed);
    if (at == written_.load(std::memory_order_acquire)) {
      return std::nullopt;
    }
    const PositionFix fix = ring_[at % kCapacity];
    read_.store(at + 1, std::memory_order_release);
    return fix;
  }
  [[nodiscard]] State state() const noexcept { return state_.load(std::memory_order_acquire); }

 private:
  static_assert(sizeof(State) == alignof(State) && std::atomic<State>::is_always_lock_free);
  static_assert(std::atomic<std::size_t>::is_always_lock_free);

  std::array<PositionFix, kCapacity> ring_{};
  alignas(64) std::atomic<std::size_t> written_{0};
  alignas(64) std::atomic<std::size_t> read_{0};
  alignas(64) std::atomic<State> state_{State{}};
};

}  // namespace lodesman
