// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/run_realtime.h"

#include <atomic>
#include <memory>
#include <thread>

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;

namespace {

class Counting final : public Task {
 public:
  void step(Time now) noexcept override {
    const auto offset = (now - last_).count();
    went_back_ = went_back_ || offset < 0;
    last_ = now;
    ++steps_;
    if (steps_ == 3) {
      std::this_thread::sleep_for(milliseconds{25});  // an overrun
    }
  }
  void enter_safe_state(Time /*now*/) noexcept override { safe_ = true; }

  std::atomic<int> steps_{0};
  std::atomic<bool> safe_{false};
  bool went_back_ = false;
  Time last_{};
};

}  // namespace

TEST_CASE(
    "real time: a task steps until it is stopped and is then made safe, missed periods are "
    "counted",
    "[mid_level][runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Counting task;
  const TaskEntry entry{{TaskId::kAhrs, milliseconds{5}, milliseconds{0}, 0}, &task};
  {
    const RealtimeRunner runner{std::span{&entry, 1}, *board, Role::kLow};
    while (task.steps_ < 250) {
      std::this_thread::sleep_for(milliseconds{5});
    }
    CHECK_FALSE(task.safe_);
  }
  CHECK(task.safe_);
  CHECK_FALSE(task.went_back_);
  const int steps = task.steps_;
  std::this_thread::sleep_for(milliseconds{20});
  CHECK(task.steps_ == steps);
  Reader<TaskHealth> health{board->task_health[static_cast<std::size_t>(TaskId::kAhrs)]};
  REQUIRE(health.latest() != nullptr);
  CHECK(health.latest()->value.overruns >= 4);
}
