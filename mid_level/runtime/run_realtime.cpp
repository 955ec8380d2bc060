// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/run_realtime.h"

#include <linux/futex.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <ctime>
#include <thread>
#include <utility>

#include "mid_level/base/clock.h"
#include "mid_level/runtime/health.h"
#include "mid_level/runtime/realtime_rights.h"

namespace lodesman {
namespace {

// Rung once. Waiting for it is also how a thread sleeps until a time: no lock, no allocation.
class Bell {
 public:
  void ring() noexcept {
    rung_.store(1, std::memory_order_release);
    syscall(SYS_futex, &rung_, FUTEX_WAKE_PRIVATE, INT_MAX, nullptr, nullptr, 0);
  }
  // True as soon as it has been rung; false at `deadline`.
  [[nodiscard]] bool wait_until(Time deadline) noexcept {
    const auto ns = deadline.time_since_epoch().count();
    timespec at{};  // of CLOCK_MONOTONIC
    at.tv_sec = ns / 1'000'000'000;
    at.tv_nsec = ns % 1'000'000'000;
    bool expired = false;
    while (!has_rung() && !expired) {
      expired = syscall(SYS_futex, &rung_, FUTEX_WAIT_BITSET_PRIVATE, 0, &at, nullptr,
                        FUTEX_BITSET_MATCH_ANY) != 0 &&
                errno == ETIMEDOUT;
    }
    return has_rung();
  }

 private:
  [[nodiscard]] bool has_rung() const noexcept {
    return rung_.load(std::memory_order_acquire) != 0;
  }

  std::atomic<std::uint32_t> rung_{0};
};

}  // namespace

struct RealtimeRunner::Worker {
  Worker(const TaskEntry& entry_in, Blackboard& board, Role role)
      : entry{entry_in}, health{board, entry_in.spec.id, role} {}

  void run() noexcept {
    pthread_setname_np(pthread_self(), to_string(entry.spec.id));
    health.holds_fifo_priority(hold_fifo_priority(entry.spec.fifo_priority));
    Time due = next_due(entry.spec, clock.now());
    while (!stop.wait_until(due)) {
      const Time began = clock.now();
      entry.task->step(began);
      const Time ended = clock.now();
      const Time next = next_due(entry.spec, ended);
      const auto missed = (next - due) / entry.spec.period - 1;  // 0 when it kept its period
      health.stepped({began, began - due, ended - began, static_cast<std::uint64_t>(missed),
                      entry.task->refused()});
      due = next;
    }
    entry.task->enter_safe_state(clock.now());
    safe.ring();
  }

  TaskEntry entry;
  SteadyClock clock;
  HealthKeeper health;
  Bell stop;
  Bell safe;  // rung by the thread as it ends
  std::thread thread;
};

RealtimeRunner::RealtimeRunner(std::span<const TaskEntry> entries, Blackboard& board, Role role,
                               OnHang on_hang)
    : on_hang_{std::move(on_hang)} {
  for (const auto& entry : entries) {
    workers_.push_back(std::make_unique<Worker>(entry, board, role));
  }
  std::stable_sort(workers_.begin(), workers_.end(), [](const auto& a, const auto& b) {
    return a->entry.spec.fifo_priority > b->entry.spec.fifo_priority;
  });
  for (auto& worker : workers_) {
    worker->thread = std::thread{[w = worker.get()] { w->run(); }};
  }
}

RealtimeRunner::~RealtimeRunner() {
  for (auto& worker : workers_) {
    worker->stop.ring();
  }
  if (const std::vector<TaskId> hung = wait_for_end(); !hung.empty()) {
    on_hang_(hung);
  }
  for (auto& worker : workers_) {
    worker->thread.join();
  }
}

// Those that have not ended when patience has.
std::vector<TaskId> RealtimeRunner::wait_for_end() const {
  const Time deadline = SteadyClock{}.now() + kLastStepPatience;
  std::vector<TaskId> hung;
  for (const auto& worker : workers_) {
    if (!worker->safe.wait_until(deadline)) {
      hung.push_back(worker->entry.spec.id);
    }
  }
  return hung;
}

}  // namespace lodesman
