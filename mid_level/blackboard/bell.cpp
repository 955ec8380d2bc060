// SPDX-License-Identifier: Apache-2.0
#include "mid_level/blackboard/bell.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <ctime>

#include "mid_level/base/clock.h"

namespace lodesman {
namespace {

// The kernel looks at the word itself.
static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t) &&
              std::atomic<std::uint32_t>::is_always_lock_free);
static_assert(sizeof(Bell<>) == 64);

[[nodiscard]] timespec on_steady_clock(Time at) noexcept {
  const auto ns = at.time_since_epoch().count();
  timespec spec{};
  spec.tv_sec = ns / 1'000'000'000;
  spec.tv_nsec = ns % 1'000'000'000;
  return spec;
}

}  // namespace

// Not FUTEX_PRIVATE: by the page and not by the address, so that it reaches other processes.
void wake_waiters(Bell<>& bell) noexcept {
  syscall(SYS_futex, &bell.rings, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

void note_time_of_ring(Bell<>& bell) noexcept {
  bell.rung_ns.store(SteadyClock{}.now().time_since_epoch().count(), std::memory_order_relaxed);
}

bool wait_for_ring(const Bell<>& bell, std::uint32_t seen, Time deadline) noexcept {
  const timespec at = on_steady_clock(deadline);
  bool expired = false;
  while (look_at(bell) == seen && !expired) {
    expired = syscall(SYS_futex, &bell.rings, FUTEX_WAIT_BITSET, seen, &at, nullptr,
                      FUTEX_BITSET_MATCH_ANY) != 0 &&
              errno == ETIMEDOUT;
  }
  return look_at(bell) != seen;
}

Duration since_ring(const Bell<>& bell, Time now) noexcept {
  const std::int64_t rung_ns = bell.rung_ns.load(std::memory_order_relaxed);
  const std::int64_t now_ns = now.time_since_epoch().count();
  return Duration{rung_ns > 0 && rung_ns <= now_ns ? now_ns - rung_ns : 0};
}

}  // namespace lodesman
