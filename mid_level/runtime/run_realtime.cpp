// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/run_realtime.h"

#include <pthread.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "mid_level/base/clock.h"
#include "mid_level/runtime/health.h"
#include "mid_level/runtime/realtime_rights.h"
#include "mid_level/runtime/step_witness.h"

namespace lodesman {
namespace {

// Said once, inside this process.
class Signal {
 public:
  void say() noexcept { ring(bell_); }
  [[nodiscard]] bool said() const noexcept { return look_at(bell_) != 0; }
  // True as soon as it has been said; false at `deadline`.
  [[nodiscard]] bool wait_until(Time deadline) const noexcept {
    return wait_for_ring(bell_, 0, deadline);
  }

 private:
  Bell<> bell_;
};

}  // namespace

struct RealtimeRunner::Worker {
  Worker(const TaskEntry& entry_in, Blackboard& board, Role role)
      : entry{entry_in},
        health{board, entry_in.spec, role},
        witness{board, entry_in, role},
        bell{board.bell_of(entry_in.spec.id)},
        seen{look_at(bell)} {}

  void run() noexcept {
    pthread_setname_np(pthread_self(), to_string(entry.spec.id));
    health.holds_fifo_priority(hold_fifo_priority(entry.spec.fifo_priority));
    witness.begin(clock.now());
    due = next_due(entry.spec, clock.now());
    while (wait_for_work()) {
      step();
    }
    entry.task->enter_safe_state(clock.now());
    safe.say();
  }

  // Told by another thread.
  void end() noexcept {
    stop.say();
    ring(bell);
  }

  // Until it is due or rung for, and its last step is long enough past; false: to be ended. The
  // bell is looked at before all it may have been rung for: what comes later rings again.
  [[nodiscard]] bool wait_for_work() noexcept {
    if (wait_for_ring(bell, seen, due)) {
      (void)stop.wait_until(std::min(began + entry.spec.least_gap, due));
    }
    seen = look_at(bell);
    return !stop.said();
  }

  void step() noexcept {
    began = clock.now();
    witness.look();
    const Duration rung_ago = since_ring(bell, began);
    entry.task->step(began);
    witness.stepped(began);
    const Time ended = clock.now();
    StepTimes times{began, began - due, ended - began, 0, entry.task->refused()};
    if (began < due) {
      times.cause = StepCause::kRing;
      times.late = rung_ago;
    } else {
      const Time next = next_due(entry.spec, ended);
      // 0 when it kept its period
      times.missed_periods = static_cast<std::uint64_t>((next - due) / entry.spec.period - 1);
      due = next;
    }
    health.stepped(times);
  }

  TaskEntry entry;
  SteadyClock clock;
  HealthKeeper health;
  StepWitness witness;
  Bell<>& bell;
  std::uint32_t seen;  // of the bell, when the last step began
  Time due{};          // by its period
  Time began{};        // the last step
  Signal stop;
  Signal safe;  // said by the thread as it ends
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
    worker->end();
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
