// SPDX-License-Identifier: Apache-2.0
// Both levels over one segment as on the boat, but in one process, so that the thread sanitizer
// sees every access of every task from both sides. What is asserted is that it works; that nothing
// races is the sanitizer's to say.
#include <sys/wait.h>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/configuration.h"
#include "deploy/boat/exit_status.h"
#include "deploy/boat/process_main.h"
#include "deploy/boat/voyage.h"
#include "mid_level/recording/recording_hash.h"
#include "mid_level/runtime/run_realtime.h"
#include "tests/support/catch.h"
#include "tests/support/self_start.h"
#include "tests/system/boat.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// Reads every channel as displays and recordings do, until it is told to stop.
class Onlooker {
 public:
  explicit Onlooker(const Blackboard& board)
      : thread_{[this, &board](const std::stop_token& stop) {
          RecordingHash hash{board};
          while (!stop.stop_requested()) {
            hash.update();
            ++looks_;
          }
        }} {}
  [[nodiscard]] int looks() const noexcept { return looks_; }

 private:
  std::atomic<int> looks_{0};
  std::jthread thread_;
};

}  // namespace

TEST_CASE("one process: both levels sail over one segment, and an onlooker reads it all",
          "[system]") {
  for (const char* profile : {"paper", "default"}) {
    const std::string segment = "lodesman-test-one-" + std::to_string(getpid());
    auto low_board = SharedBlackboard::create(segment);
    auto high_board = SharedBlackboard::open(segment, Role::kHigh, Duration::zero());
    const auto board = SharedBlackboard::observe(segment, Duration::zero());
    const BoatConfig configuration = load_configuration(profile, CommonOptions{});
    const Scenario scenario = load_named_scenario("paper-static", configuration.speeds);
    AssembledBoat boat{low_board.writable(), configuration, &scenario};
    HighLevel high{high_board.writable(), Role::kHigh,
                   high_level_options(configuration, voyage_of(configuration, &scenario))};
    SelfStart self_start{high_board.writable(), configuration, scenario,
                         [] { return SteadyClock{}.now(); }};
    Reader<ThrustApplied> thrust{board->thrust_applied};
    Reader<Plan> plan{board->plan};
    {
      const Onlooker onlooker{*board};
      const auto low_tasks = boat.tasks();
      const auto high_tasks = high.tasks();
      const RealtimeRunner low_runner{low_tasks, low_board.writable(), Role::kLow, end_without};
      const RealtimeRunner high_runner{high_tasks, high_board.writable(), Role::kHigh, end_without};
      REQUIRE(eventually([&] {
        self_start.look();
        return drives(thrust.latest());
      }));
      CHECK(eventually([&] {
        const auto* newest = plan.latest();
        return newest != nullptr && newest->value.id >= 3 &&
               newest->value.reason == PathReason::kFound;
      }));
      CHECK(eventually([&] { return onlooker.looks() > 100; }));
    }
    // The runners have made every task safe.
    CHECK(int{await_first(thrust).value.left} == 128);
    CHECK(int{await_first(thrust).value.right} == 128);
  }
}

namespace {

// A driver that never comes back.
class Hanging final : public Task {
 public:
  void step(Time /*now*/) noexcept override {
    hangs_ = true;
    for (;;) {
      pause();
    }
  }
  std::atomic<bool> hangs_{false};
};

}  // namespace

TEST_CASE("one process: a program with a task that hangs ends by itself, and with a fault",
          "[system]") {
  const pid_t program = fork();
  REQUIRE(program >= 0);
  if (program == 0) {
    const auto board = std::make_unique<Blackboard>();
    Hanging driver;
    const TaskEntry entry = scheduled(TaskId::kDeltaT, driver);
    {
      const RealtimeRunner runner{std::span{&entry, 1}, *board, Role::kLow, end_without};
      (void)eventually([&] { return driver.hangs_.load(); });
    }
    _exit(kExitDone);
  }
  int status = 0;
  REQUIRE(eventually([&] { return waitpid(program, &status, WNOHANG) == program; }));
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == kExitFault);
}
