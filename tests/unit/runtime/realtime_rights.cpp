// SPDX-License-Identifier: Apache-2.0
// Rights are taken from a child process of ours: this one may have all of them.
#include "mid_level/runtime/realtime_rights.h"

#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <thread>

#include "mid_level/runtime/run_realtime.h"
#include "mid_level/runtime/task_table.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

constexpr int kAllowed = 50;
constexpr uid_t kNobody = 65534;

class Idle final : public Task {
 public:
  void step(Time /*now*/) noexcept override {}
};

bool try_fifo(int priority) {
  sched_param param{};
  param.sched_priority = priority;
  const bool granted = sched_setscheduler(0, SCHED_FIFO, &param) == 0;
  param.sched_priority = 0;
  sched_setscheduler(0, SCHED_OTHER, &param);
  return granted;
}

// The priority that a task with this row of the table comes to hold.
std::uint64_t priority_of(TaskId id) {
  const auto board = std::make_unique<Blackboard>();
  Idle idle;
  const TaskEntry entry = scheduled(id, idle);
  Reader<TaskHealth> health{board->task_health[static_cast<std::size_t>(id)]};
  const RealtimeRunner runner{std::span{&entry, 1}, *board, Role::kLow,
                              [](std::span<const TaskId>) {}};
  while (health.latest() == nullptr) {
    std::this_thread::sleep_for(std::chrono::milliseconds{2});
  }
  return health.latest()->value.fifo_priority;
}

enum Verdict : int { kAsGranted = 0, kWrongPriority, kWrongLine, kLeftRealtime, kNoLimits };

// Without privileges, and with the right to SCHED_FIFO up to kAllowed where that can be had.
Verdict verdict_with_fewer_rights() {
  const rlimit limit{kAllowed, kAllowed};
  (void)setrlimit(RLIMIT_RTPRIO, &limit);
  if (geteuid() == 0 && setresuid(kNobody, kNobody, kNobody) != 0) {
    return kNoLimits;
  }
  if (try_fifo(kAllowed + 1)) {
    return kNoLimits;
  }
  const int granted = try_fifo(kAllowed) ? kAllowed : 0;
  const std::string line = set_up_realtime();
  if (line.find(refused_priorities(granted)) == std::string::npos) {
    return kWrongLine;
  }
  if (sched_getscheduler(0) == SCHED_FIFO) {
    return kLeftRealtime;
  }
  const auto expected = static_cast<std::uint64_t>(granted);
  const bool held = priority_of(TaskId::kThruster) == expected &&
                    priority_of(TaskId::kEstimator) == expected &&
                    priority_of(TaskId::kPlanner) == std::min<std::uint64_t>(expected, 20);
  return held ? kAsGranted : kWrongPriority;
}

}  // namespace

TEST_CASE("real-time rights: each task says what it holds where less is granted than it asks for",
          "[mid_level][runtime]") {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    _exit(verdict_with_fewer_rights());
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kNoLimits) {
    WARN("skipped: this machine lets everybody be SCHED_FIFO, or nobody be somebody else");
  } else {
    CHECK(WEXITSTATUS(status) == kAsGranted);
  }
}

TEST_CASE("real-time rights: one line names every task that wants more than is granted",
          "[mid_level][runtime]") {
  CHECK(refused_priorities(70).empty());
  CHECK(refused_priorities(0) == "SCHED_FIFO is not allowed");
  CHECK(refused_priorities(50) ==
        "SCHED_FIFO is allowed up to priority 50 only (ahrs asks for 60, thruster asks for 70)");
}

}  // namespace lodesman::testing
