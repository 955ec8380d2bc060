// SPDX-License-Identifier: Apache-2.0
// A bell: one word a task, rung by whoever publishes what the task waits for, also from another
// process. Ringing and looking are wait-free and any thread's; it is waited for by the one thread
// that steps the task. A writer killed between publication and ring leaves a task that is one
// period late and nothing worse: every wait ends at its deadline.
#pragma once

#include <atomic>
#include <cstdint>
#include <type_traits>

#include "mid_level/base/time.h"

namespace lodesman {

// The one word of the blackboard with several writers. It counts rings, is compared for equality
// alone, may wrap and is never reset.
// - Who waits loads it before it reads its channels, and then waits for it to become another.
// - Who publishes stores `newest` first and rings then.
// - Ring, release, and look, acquire: whoever has seen a ring sees what was published before it. A
//   ring is one exchange, so that it passes on what the rings of other writers before it said.
template <template <class> class Atomic = std::atomic>
struct alignas(64) Bell {
  Atomic<std::uint32_t> rings{0};
  Atomic<std::int64_t> rung_ns{0};  // [ns] of the newest ring, measured: decides nothing
};

// Wakes whoever waits, in this process and in every other one that has the bell mapped.
void wake_waiters(Bell<>& bell) noexcept;
void note_time_of_ring(Bell<>& bell) noexcept;

// There is no asking whether anyone waits: the answer would be old when it came.
template <template <class> class Atomic>
void ring(Bell<Atomic>& bell) noexcept {
  constexpr bool kIsReal = std::is_same_v<Bell<Atomic>, Bell<>>;
  if constexpr (kIsReal) {
    note_time_of_ring(bell);
  }
  bell.rings.fetch_add(1, std::memory_order_release);
  if constexpr (kIsReal) {
    wake_waiters(bell);
  }
}

// How often it has been rung: what to wait on, taken before anything else is looked at.
template <template <class> class Atomic>
[[nodiscard]] std::uint32_t look_at(const Bell<Atomic>& bell) noexcept {
  return bell.rings.load(std::memory_order_acquire);
}

// Sleeps until the bell is no longer as it was `seen`: true, at once where it is not; false at
// `deadline`, on the steady clock. No lock, no allocation.
[[nodiscard]] bool wait_for_ring(const Bell<>& bell, std::uint32_t seen, Time deadline) noexcept;

// How long before `now` the newest ring was; zero where it claims to be of no past.
[[nodiscard]] Duration since_ring(const Bell<>& bell, Time now) noexcept;

}  // namespace lodesman
