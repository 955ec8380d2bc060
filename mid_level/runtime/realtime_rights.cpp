// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/realtime_rights.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "mid_level/runtime/task_table.h"

namespace lodesman {
namespace {

constexpr int kHighestPriority =
    std::max_element(kTaskTable.begin(), kTaskTable.end(), [](const auto& a, const auto& b) {
      return a.fifo_priority < b.fifo_priority;
    }) -> fifo_priority;

bool schedule(int policy, int priority) noexcept {
  sched_param param{};
  param.sched_priority = priority;
  return sched_setscheduler(0, policy, &param) == 0;  // 0: the calling thread
}

[[nodiscard]] int priority_held() noexcept {
  sched_param param{};
  const bool fifo = sched_getscheduler(0) == SCHED_FIFO && sched_getparam(0, &param) == 0;
  return fifo ? param.sched_priority : 0;
}

// What a program without privileges may ask for.
[[nodiscard]] int priority_limit() noexcept {
  rlimit limit{};
  (void)getrlimit(RLIMIT_RTPRIO, &limit);
  return static_cast<int>(std::min<rlim_t>(limit.rlim_cur, kHighestPriority));
}

}  // namespace

int hold_fifo_priority(int wanted) noexcept {
  if (wanted > 0 && !schedule(SCHED_FIFO, wanted)) {
    schedule(SCHED_FIFO, std::min(wanted, priority_limit()));
  }
  return priority_held();
}

std::string refused_priorities(int granted) {
  if (granted >= kHighestPriority) {
    return "";
  }
  if (granted == 0) {
    return "SCHED_FIFO is not allowed";
  }
  std::string tasks;
  for (const TaskSpec& spec : kTaskTable) {
    if (spec.fifo_priority > granted) {
      tasks += std::string{tasks.empty() ? "" : ", "} + to_string(spec.id) + " asks for " +
               std::to_string(spec.fifo_priority);
    }
  }
  return "SCHED_FIFO is allowed up to priority " + std::to_string(granted) + " only (" + tasks +
         ")";
}

namespace {

// Locks what there is and what will be; gives why it cannot. Under a limit even a lock that is
// granted is none to keep: once it is met, no more memory is to be had at all.
[[nodiscard]] std::string lock_memory() {
  rlimit limit{};
  const bool limited =
      geteuid() != 0 && getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  if (limited) {
    return "memory cannot be locked (RLIMIT_MEMLOCK is " + std::to_string(limit.rlim_cur / 1024) +
           " KiB, not unlimited)";
  }
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    return "memory cannot be locked (" + std::generic_category().message(errno) + ")";
  }
  return {};
}

}  // namespace

std::string set_up_realtime() {
  std::string missing = lock_memory();
  const std::string refused = refused_priorities(hold_fifo_priority(kHighestPriority));
  schedule(SCHED_OTHER, 0);
  if (!refused.empty()) {
    missing += (missing.empty() ? "" : "; ") + refused;
  }
  return missing.empty() ? missing
                         : "no real-time rights: " + missing +
                               "; deadlines may be missed when the machine is busy";
}

}  // namespace lodesman
