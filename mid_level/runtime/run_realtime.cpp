// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/run_realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <ctime>
#include <system_error>
#include <thread>

#include "mid_level/base/clock.h"
#include "mid_level/runtime/health.h"

namespace lodesman {
namespace {

void sleep_until(Time deadline) noexcept {
  const auto ns = deadline.time_since_epoch().count();
  timespec at{};
  at.tv_sec = ns / 1'000'000'000;
  at.tv_nsec = ns % 1'000'000'000;
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR) {
  }
}

void name_thread(const TaskSpec& spec) noexcept {
  pthread_setname_np(pthread_self(), to_string(spec.id));
}

// Where it is not allowed, set_up_realtime has said so already.
void prefer_fifo(const TaskSpec& spec) noexcept {
  if (spec.fifo_priority > 0) {
    sched_param param{};
    param.sched_priority = spec.fifo_priority;
    pthread_setschedparam(pthread_self(), SCHED_FIFO, &param);
  }
}

}  // namespace

std::string set_up_realtime() {
  std::string missing;
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    missing = "memory cannot be locked (" + std::generic_category().message(errno) + ")";
  }
  sched_param param{};
  param.sched_priority = 1;
  if (pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0) {
    param.sched_priority = 0;
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &param);
  } else {
    missing += std::string{missing.empty() ? "" : "; "} + "SCHED_FIFO is not allowed";
  }
  return missing.empty() ? missing
                         : "no real-time rights: " + missing +
                               "; deadlines may be missed when the machine is busy";
}

struct RealtimeRunner::Worker {
  Worker(const TaskEntry& entry_in, Blackboard& board, Role role)
      : entry{entry_in}, health{board, entry_in.spec.id, role} {}

  void run(const std::stop_token& stop, Time start) noexcept {
    name_thread(entry.spec);
    prefer_fifo(entry.spec);
    Time deadline = start + entry.spec.phase;
    for (;;) {
      sleep_until(deadline);
      if (stop.stop_requested()) {
        return;
      }
      const Time began = clock.now();
      entry.task->step(began);
      const Time ended = clock.now();
      const auto periods = (ended - deadline) / entry.spec.period;  // 0 when it kept its period
      health.stepped(began, ended - began, static_cast<std::uint64_t>(periods));
      deadline += (periods + 1) * entry.spec.period;
    }
  }

  TaskEntry entry;
  SteadyClock clock;
  HealthKeeper health;
  std::jthread thread;
};

RealtimeRunner::RealtimeRunner(std::span<const TaskEntry> entries, Blackboard& board, Role role) {
  for (const auto& entry : entries) {
    workers_.push_back(std::make_unique<Worker>(entry, board, role));
  }
  const Time start = SteadyClock{}.now();
  for (auto& worker : workers_) {
    worker->thread = std::jthread{
        [w = worker.get(), start](const std::stop_token& stop) { w->run(stop, start); }};
  }
}

RealtimeRunner::~RealtimeRunner() {
  for (auto& worker : workers_) {
    worker->thread.request_stop();
  }
  for (auto& worker : workers_) {
    worker->thread.join();
  }
  for (auto& worker : workers_) {
    worker->entry.task->enter_safe_state(worker->clock.now());
  }
}

}  // namespace lodesman
