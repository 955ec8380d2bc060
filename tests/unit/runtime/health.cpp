// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/health.h"

#include <memory>

#include "mid_level/runtime/health_watch.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Time kStart{seconds{100}};
constexpr auto kAhrs = static_cast<std::size_t>(TaskId::kAhrs);

class Resting final : public Task {
 public:
  void step(Time /*now*/) noexcept override {}
};

// Two tasks that tell their health, and a watch that expects both from kStart on.
struct Watched {
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Resting idle;
  std::array<TaskEntry, 2> tasks{scheduled(TaskId::kAhrs, idle),
                                 scheduled(TaskId::kPosition, idle)};
  Writer<TaskHealth> ahrs{board->task_health[kAhrs], Role::kLow, "ahrs"};
  Writer<TaskHealth> position{board->task_health[static_cast<std::size_t>(TaskId::kPosition)],
                              Role::kLow, "position"};
  HealthWatch watch{*board, tasks, kStart};
};

constexpr Duration kAhrsLimit = silence_limit(milliseconds{20});

}  // namespace

TEST_CASE("health: a step is counted by how late it began", "[mid_level][runtime]") {
  CHECK(late_bucket(-milliseconds{1}) == 0);
  CHECK(late_bucket(Duration{999}) == 0);
  CHECK(late_bucket(microseconds{1}) == 1);
  CHECK(late_bucket(microseconds{63}) == 6);
  CHECK(late_bucket(microseconds{64}) == 7);
  CHECK(late_bucket(milliseconds{262}) == TaskHealth::kLateBuckets - 2);
  CHECK(late_bucket(milliseconds{263}) == TaskHealth::kLateBuckets - 1);
  CHECK(late_bucket(Duration::max()) == TaskHealth::kLateBuckets - 1);
}

TEST_CASE("health: how late a share of the steps began at most", "[mid_level][runtime]") {
  TaskHealth health;
  CHECK(late_at_most(health, 0.99) == Duration::zero());
  health.late[3] = 98;
  health.late[10] = 1;
  health.late.back() = 1;
  health.worst_late_ns = 400'000'000;
  CHECK(late_at_most(health, 0.5) == microseconds{8});
  CHECK(late_at_most(health, 0.99) == microseconds{1024});
  CHECK(late_at_most(health, 1.0) == milliseconds{400});
  health.worst_late_ns = 5'000;
  CHECK(late_at_most(health, 0.5) == microseconds{5});
}

TEST_CASE("health: steps, the latest of them and missed periods are published once a second",
          "[mid_level][runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Reader<TaskHealth> reader{board->task_health[kAhrs]};
  HealthKeeper keeper{*board, TaskSpec{TaskId::kAhrs}, Role::kLow};
  keeper.holds_fifo_priority(60);
  for (int i = 0; i <= 150; ++i) {
    const bool slow = i == 7;
    keeper.stepped({kStart + i * milliseconds{20}, slow ? milliseconds{3} : Duration{500},
                    slow ? milliseconds{90} : milliseconds{1}, slow ? 4U : 0U, 3});
  }
  const auto* newest = reader.latest();
  REQUIRE(newest != nullptr);
  CHECK(newest->sequence == 4);
  CHECK(newest->stamp == kStart + seconds{3});
  CHECK(newest->value.steps == 151);
  CHECK(newest->value.overruns == 4);
  CHECK(newest->value.refused == 3);
  CHECK(newest->value.last_step_ns == 1'000'000);
  CHECK(newest->value.worst_step_ns == 90'000'000);
  CHECK(newest->value.worst_late_ns == 3'000'000);
  CHECK(newest->value.fifo_priority == 60);
  CHECK(newest->value.late[0] == 150);
  CHECK(newest->value.late[late_bucket(milliseconds{3})] == 1);
  CHECK(newest->value.took[late_bucket(milliseconds{1})] == 150);
  CHECK(newest->value.took[late_bucket(milliseconds{90})] == 1);
}

TEST_CASE("health watch: a task is silent when its word is overdue", "[mid_level][runtime]") {
  Watched run;
  CHECK(run.watch.silent(kStart + kAhrsLimit).empty());
  run.position.publish({}, kStart + seconds{5});
  const auto silent = run.watch.silent(kStart + seconds{5});
  REQUIRE(silent.size() == 1);  // it never told of itself, but was to
  CHECK(silent[0].task == TaskId::kAhrs);
  CHECK(silent[0].silent == seconds{5});
  run.ahrs.publish({}, kStart + seconds{6});
  CHECK(run.watch.silent(kStart + seconds{6} + kAhrsLimit - seconds{1}).empty());
  CHECK(run.watch.silent(kStart + seconds{6} + kAhrsLimit).size() == 1);  // position
  CHECK(run.watch.silent(kStart + seconds{7} + kAhrsLimit).size() == 2);
}

TEST_CASE("health watch: what is told twice as seldom as it is written is not silent",
          "[mid_level][runtime]") {
  for (const TaskSpec& spec : kTaskTable) {
    CHECK(silence_limit(spec.period) > 2 * (kHealthPeriod + spec.period));
  }
}

TEST_CASE("health watch: another run's words and those yet to come tell nothing",
          "[mid_level][runtime]") {
  Watched run;
  run.ahrs.publish({}, kStart - seconds{60});
  CHECK(run.watch.silent(kStart + kAhrsLimit).empty());
  run.ahrs.publish({}, kStart + seconds{3600});
  CHECK(run.watch.silent(kStart + kAhrsLimit + milliseconds{1}).size() == 1);
}

TEST_CASE("health watch: all step once each has told of itself in this run",
          "[mid_level][runtime]") {
  Watched run;
  run.ahrs.publish({}, kStart - seconds{1});
  run.position.publish({}, kStart + milliseconds{1});
  CHECK_FALSE(run.watch.all_step(kStart + milliseconds{2}));
  run.ahrs.publish({}, kStart + milliseconds{3});
  CHECK(run.watch.all_step(kStart + milliseconds{4}));
}

TEST_CASE("health watch: an observer calls silent only who has spoken", "[mid_level][runtime]") {
  Watched run;
  HealthWatch observer{*run.board};
  CHECK(observer.silent(kStart).empty());
  run.ahrs.publish({}, kStart - seconds{60});
  const auto silent = observer.silent(kStart);
  REQUIRE(silent.size() == 1);
  CHECK(silent[0].task == TaskId::kAhrs);
  CHECK(silent[0].silent == seconds{60});
}

TEST_CASE("health watch: a hang is news once, and so is its end", "[mid_level][runtime]") {
  Watched run;
  run.ahrs.publish({}, kStart);
  run.position.publish({}, kStart + seconds{2});
  CHECK(run.watch.news(kStart + kAhrsLimit).empty());
  using Lines = std::vector<std::string>;
  CHECK(run.watch.news(kStart + seconds{3}) == Lines{"task ahrs hangs: no word of it for 3.0 s"});
  CHECK(run.watch.news(kStart + seconds{4}).empty());
  run.position.publish({}, kStart + seconds{9});
  run.ahrs.publish({}, kStart + milliseconds{9270});
  CHECK(run.watch.news(kStart + seconds{10}) == Lines{"task ahrs steps again, after 9.2 s"});
  CHECK(run.watch.news(kStart + seconds{11}).empty());
  CHECK(run.watch.news(kStart + seconds{13}).size() == 2);
}

}  // namespace lodesman::testing
