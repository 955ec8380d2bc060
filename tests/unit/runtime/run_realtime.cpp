// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/run_realtime.h"

#include <atomic>
#include <memory>
#include <thread>

#include "mid_level/base/clock.h"
#include "mid_level/runtime/health_watch.h"
#include "mid_level/runtime/task_table.h"
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
  void enter_safe_state(Time /*now*/) noexcept override {
    ++safe_;
    safe_on_ = std::this_thread::get_id();
  }

  std::atomic<int> steps_{0};
  std::atomic<int> safe_{0};
  std::thread::id safe_on_;
  bool went_back_ = false;
  Time last_{};
};

// A driver that does not come back.
class Hanging final : public Task {
 public:
  void step(Time /*now*/) noexcept override {
    hangs_ = true;
    while (!let_go_) {
      std::this_thread::sleep_for(milliseconds{1});
    }
    hangs_ = false;
  }
  void enter_safe_state(Time /*now*/) noexcept override { safe_ = true; }

  std::atomic<bool> hangs_{false};
  std::atomic<bool> let_go_{false};
  std::atomic<bool> safe_{false};
};

// How far beyond the steady clock's grid of its period it is stepped, at the least.
class OnGrid final : public Task {
 public:
  static constexpr Duration kPeriod = milliseconds{200};
  static Duration beyond(Time now) { return now.time_since_epoch() % kPeriod; }

  void step(Time now) noexcept override { least_ = std::min(least_.load(), beyond(now)); }

  std::atomic<Duration> least_{kPeriod};
};

template <class Condition>
void wait_for(Condition condition) {
  while (!condition()) {
    std::this_thread::sleep_for(milliseconds{1});
  }
}

void nothing_hangs(std::span<const TaskId> /*hung*/) {}

}  // namespace

TEST_CASE(
    "real time: a task steps until it is stopped and is then made safe, missed periods are "
    "counted",
    "[mid_level][runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Counting task;
  const TaskEntry entry{{TaskId::kAhrs, milliseconds{5}, milliseconds{0}, 0}, &task};
  {
    const RealtimeRunner runner{std::span{&entry, 1}, *board, Role::kLow, nothing_hangs};
    wait_for([&] { return task.steps_ >= 250; });
    CHECK(task.safe_ == 0);
  }
  CHECK(task.safe_ == 1);
  CHECK(task.safe_on_ != std::this_thread::get_id());
  CHECK_FALSE(task.went_back_);
  const int steps = task.steps_;
  std::this_thread::sleep_for(milliseconds{20});
  CHECK(task.steps_ == steps);
  Reader<TaskHealth> reader{board->task_health[static_cast<std::size_t>(TaskId::kAhrs)]};
  REQUIRE(reader.latest() != nullptr);
  const TaskHealth& health = reader.latest()->value;
  CHECK(health.overruns >= 4);
  std::uint64_t counted = 0;
  for (const std::uint64_t count : health.late) {
    counted += count;
  }
  CHECK(counted == health.steps);
  CHECK(health.worst_late_ns > 0);
}

TEST_CASE("real time: a task that hangs keeps no other from becoming safe, nor the end from coming",
          "[mid_level][runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Hanging driver;
  Counting thruster;
  const std::vector<TaskEntry> entries{
      {{TaskId::kDeltaT, milliseconds{5}, milliseconds{0}, 0}, &driver},
      {{TaskId::kThruster, milliseconds{5}, milliseconds{0}, 1}, &thruster}};
  std::vector<TaskId> hung;
  bool thruster_was_safe = false;
  {
    const RealtimeRunner runner{entries, *board, Role::kLow, [&](std::span<const TaskId> tasks) {
                                  hung.assign(tasks.begin(), tasks.end());
                                  thruster_was_safe = thruster.safe_ == 1;
                                  driver.let_go_ = true;  // on the boat the process ends here
                                }};
    wait_for([&] { return driver.hangs_ && thruster.steps_ > 0; });
  }
  CHECK(std::find(hung.begin(), hung.end(), TaskId::kDeltaT) != hung.end());
  CHECK(thruster.safe_ == 1);
  // On a machine that stands still for a second the thruster is late as well, and said to be.
  CHECK((thruster_was_safe || hung.size() == 2));
  CHECK(driver.safe_);
}

TEST_CASE("real time: a stop wakes who sleeps, however long its period", "[mid_level][runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Counting task;
  const TaskEntry entry{{TaskId::kAhrs, std::chrono::hours{24}, milliseconds{0}, 0}, &task};
  { const RealtimeRunner runner{std::span{&entry, 1}, *board, Role::kLow, nothing_hangs}; }
  CHECK(task.safe_ == 1);
}

TEST_CASE("real time: a task that hangs is told of while it does", "[mid_level][runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Hanging driver;
  Counting other;
  const std::vector<TaskEntry> entries{
      {{TaskId::kDeltaT, milliseconds{20}, milliseconds{0}, 0}, &driver},
      {{TaskId::kAhrs, milliseconds{20}, milliseconds{0}, 0}, &other}};
  const SteadyClock clock;
  HealthWatch watch{*board, entries, clock.now()};
  const RealtimeRunner runner{entries, *board, Role::kLow, nothing_hangs};
  std::vector<std::string> news;
  const auto says = [&](const std::string& words) {
    return [&news, &watch, &clock, words] {
      for (const std::string& line : watch.news(clock.now())) {
        news.push_back(line);
      }
      return std::any_of(news.begin(), news.end(),
                         [&](const auto& line) { return line.starts_with(words); });
    };
  };
  wait_for(says("task delta_t hangs: no word of it for "));
  driver.let_go_ = true;
  wait_for(says("task delta_t steps again, after "));
  SUCCEED();
}

TEST_CASE("real time: deadlines lie on the steady clock's own grid", "[mid_level][runtime]") {
  const TaskSpec spec{TaskId::kAhrs, milliseconds{50}, milliseconds{12}, 0};
  CHECK(next_due(spec, Time{}) == Time{milliseconds{12}});
  CHECK(next_due(spec, Time{milliseconds{12}}) == Time{milliseconds{62}});
  CHECK(next_due(spec, Time{milliseconds{12} - Duration{1}}) == Time{milliseconds{12}});
  CHECK(next_due(spec, Time{milliseconds{1'000'063}}) == Time{milliseconds{1'000'112}});
  // Whenever two programs start, their tasks are due in the order of their phases.
  for (const milliseconds start : {milliseconds{0}, milliseconds{17}, milliseconds{1'234'567}}) {
    const Time grid{(start / milliseconds{100} + 2) * milliseconds{100}};
    for (const TaskSpec& task : kTaskTable) {
      const Time before = grid - Duration{1};
      CHECK(next_due(task, std::max(Time{start}, before)) == grid + task.phase);
    }
  }
}

TEST_CASE("real time: two runners keep one grid, whenever each is started",
          "[mid_level][runtime]") {
  const auto board = std::make_unique<Blackboard>();
  OnGrid first;
  OnGrid second;
  const TaskEntry low{{TaskId::kAhrs, OnGrid::kPeriod, Duration::zero(), 0}, &first};
  const TaskEntry high{{TaskId::kPlanner, OnGrid::kPeriod, Duration::zero(), 0}, &second};
  const SteadyClock clock;
  const auto between_two_periods = [&] {
    return OnGrid::beyond(clock.now()) > milliseconds{80} &&
           OnGrid::beyond(clock.now()) < milliseconds{120};
  };
  wait_for(between_two_periods);
  const RealtimeRunner low_runner{std::span{&low, 1}, *board, Role::kLow, nothing_hangs};
  wait_for(between_two_periods);
  const RealtimeRunner high_runner{std::span{&high, 1}, *board, Role::kHigh, nothing_hangs};
  wait_for([&] {
    return first.least_.load() < milliseconds{50} && second.least_.load() < milliseconds{50};
  });
  SUCCEED();
}
