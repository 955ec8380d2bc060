// SPDX-License-Identifier: Apache-2.0
// A program is killed at one instruction of a publication after another, between announcing and
// ringing too: whoever waits goes on, and so does its successor.
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <new>
#include <optional>
#include <thread>

#include "mid_level/base/clock.h"
#include "mid_level/runtime/run_realtime.h"
#include "mid_level/runtime/task_table.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kPlaces = 120;  // at which it is killed, from the first to the last

[[nodiscard]] HelmCommand said_twice(std::uint64_t number) {
  HelmCommand helm;
  helm.plan_id = number;
  helm.surge_ref = static_cast<std::int32_t>(number % 100);
  return helm;
}

class Thruster final : public Task {
 public:
  explicit Thruster(const Blackboard& board) : helm_{board.helm_command} {}
  void step(Time /*now*/) noexcept override {
    if (const auto* helm = helm_.latest(); helm != nullptr) {
      torn_ =
          torn_ || helm->value.surge_ref != static_cast<std::int32_t>(helm->value.plan_id % 100);
      heard_ = helm->value.plan_id;
    }
    ++steps_;
  }
  std::atomic<std::uint64_t> heard_{0};
  std::atomic<int> steps_{0};
  std::atomic<bool> torn_{false};

 private:
  Reader<HelmCommand> helm_;
};

// Publishes one command and rings, between two stops.
[[noreturn]] void publish_under_trace(Blackboard& board, std::uint64_t number) {
  auto helm = writer_of(board, board.helm_command, Role::kHigh);
  if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) {
    _exit(1);
  }
  (void)raise(SIGSTOP);
  helm.publish(said_twice(number), Time{Duration{1}});
  (void)raise(SIGSTOP);
  _exit(0);
}

// Kills such a program after so many of its instructions, or at its second stop. Gives how many it
// was let; nothing where programs cannot be traced here.
std::optional<std::size_t> run_and_kill(Blackboard& board, std::uint64_t number,
                                        std::size_t instructions) {
  const pid_t child = fork();
  if (child == 0) {
    publish_under_trace(board, number);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFSTOPPED(status)) {
    return std::nullopt;
  }
  std::size_t done = 0;
  bool stopped = false;
  while (done < instructions && !stopped &&
         ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) == 0) {
    waitpid(child, &status, 0);
    stopped = !WIFSTOPPED(status) || WSTOPSIG(status) == SIGSTOP;
    ++done;
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  return done;
}

}  // namespace

TEST_CASE("bells: a program killed anywhere in a publication leaves a boat that goes on",
          "[mid_level][runtime]") {
  auto* board = ::new (mmap(nullptr, sizeof(Blackboard), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0)) Blackboard;
  const auto all = run_and_kill(*board, 1, SIZE_MAX);
  if (!all) {
    WARN("skipped: no program may be traced here");
    return;
  }
  Thruster thruster{*board};
  const TaskEntry entry{{TaskId::kThruster, milliseconds{20}, milliseconds{0}, 0}, &thruster};
  std::size_t unrung = 0;  // announced, and nobody was told
  {
    const RealtimeRunner runner{std::span{&entry, 1}, *board, Role::kLow,
                                [](std::span<const TaskId>) {}};
    const auto wait_until_heard = [&](std::uint64_t number) {
      while (thruster.heard_ < number) {
        std::this_thread::sleep_for(milliseconds{1});
      }
    };
    std::uint64_t number = 1;
    const std::size_t stride = std::max<std::size_t>(1, *all / kPlaces);
    for (std::size_t place = 0; place <= *all; place += stride) {
      board->helm_command.release_claim_of(Role::kHigh);
      const std::uint32_t rung_before = look_at(board->bell_of(TaskId::kThruster));
      REQUIRE(run_and_kill(*board, ++number, place));
      Reader<HelmCommand> reader{board->helm_command};
      const bool announced = reader.latest()->value.plan_id == number;
      const bool rung = look_at(board->bell_of(TaskId::kThruster)) != rung_before;
      CHECK((announced || !rung));
      unrung += announced && !rung ? 1U : 0U;
      if (announced) {
        wait_until_heard(number);  // by its period where nobody rang
      }
      board->helm_command.release_claim_of(Role::kHigh);
      auto successor = writer_of(*board, board->helm_command, Role::kHigh);
      successor.publish(said_twice(++number), SteadyClock{}.now());
      wait_until_heard(number);
    }
  }
  CHECK_FALSE(thruster.torn_);
  CHECK(unrung > 0);
  munmap(board, sizeof(Blackboard));
}

}  // namespace lodesman::testing
