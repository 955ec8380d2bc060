// SPDX-License-Identifier: Apache-2.0
// Bells between processes and in the real-time runner. Waits end at a time that no machine needs.
#include "mid_level/blackboard/bell.h"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <new>
#include <thread>

#include "mid_level/base/clock.h"
#include "mid_level/runtime/health.h"
#include "mid_level/runtime/run_realtime.h"
#include "mid_level/runtime/task_table.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;

// Long past all that a test waits for: whoever needs it has been forgotten.
[[nodiscard]] Time much_later() { return SteadyClock{}.now() + std::chrono::seconds{60}; }

template <class Condition>
void wait_for(Condition condition) {
  while (!condition()) {
    std::this_thread::sleep_for(milliseconds{1});
  }
}

void nothing_hangs(std::span<const TaskId> /*hung*/) {}

// Takes up the newest helm command at each step.
class Listening final : public Task {
 public:
  explicit Listening(const Blackboard& board) : helm_{board.helm_command} {}

  void step(Time now) noexcept override {
    const auto* helm = helm_.latest();
    if (began_ > Time{} && now - began_ < shortest_gap_.load()) {
      shortest_gap_ = now - began_;
    }
    began_ = now;
    heard_ = helm != nullptr ? helm->value.plan_id : 0;
    ++steps_;
  }

  std::atomic<std::uint64_t> heard_{0};
  std::atomic<int> steps_{0};
  std::atomic<Duration> shortest_gap_{Duration::max()};

 private:
  Reader<HelmCommand> helm_;
  Time began_{};
};

[[nodiscard]] HelmCommand numbered(std::uint64_t number) {
  HelmCommand helm;
  helm.plan_id = number;
  return helm;
}

[[nodiscard]] TaskHealth last_health(const Blackboard& board, TaskId task) {
  Reader<TaskHealth> health{board.task_health[static_cast<std::size_t>(task)]};
  const auto* newest = health.latest();
  return newest != nullptr ? newest->value : TaskHealth{};
}

// A blackboard that a child process shares.
struct SharedBoard {
  SharedBoard()
      : board{::new (mmap(nullptr, sizeof(Blackboard), PROT_READ | PROT_WRITE,
                          MAP_SHARED | MAP_ANONYMOUS, -1, 0)) Blackboard} {}
  SharedBoard(const SharedBoard&) = delete;
  SharedBoard& operator=(const SharedBoard&) = delete;
  ~SharedBoard() { munmap(board, sizeof(Blackboard)); }

  Blackboard* board;
};

}  // namespace

TEST_CASE("bell: what was rung since it was looked at is not slept over",
          "[mid_level][blackboard]") {
  Bell<> bell;
  for (const std::uint32_t before : {std::uint32_t{0}, std::numeric_limits<std::uint32_t>::max()}) {
    bell.rings.store(before, std::memory_order_relaxed);
    const std::uint32_t seen = look_at(bell);
    ring(bell);  // beyond the last number it counts from 0 again
    CHECK(look_at(bell) != seen);
    CHECK(wait_for_ring(bell, seen, much_later()));
  }
}

TEST_CASE("bell: who waits in vain is let go at its deadline", "[mid_level][blackboard]") {
  const Bell<> bell;
  const Time deadline = SteadyClock{}.now() + milliseconds{20};
  CHECK_FALSE(wait_for_ring(bell, look_at(bell), deadline));
  CHECK(SteadyClock{}.now() >= deadline);
  CHECK_FALSE(wait_for_ring(bell, look_at(bell), Time{}));
}

TEST_CASE("bell: a ring wakes who sleeps in another process", "[mid_level][blackboard]") {
  const SharedBoard shared;
  Bell<>& there = shared.board->bell_of(TaskId::kThruster);
  Bell<>& here = shared.board->bell_of(TaskId::kController);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const std::uint32_t seen = look_at(there);
    ring(here);
    _exit(wait_for_ring(there, seen, much_later()) ? 0 : 1);
  }
  CHECK(wait_for_ring(here, 0, much_later()));
  std::this_thread::sleep_for(milliseconds{20});  // so that it most likely sleeps by now
  ring(there);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("bell: how long ago it rang is told of the past alone", "[mid_level][blackboard]") {
  Bell<> bell;
  const Time now{std::chrono::seconds{100}};
  CHECK(since_ring(bell, now) == Duration::zero());
  for (const std::int64_t forged : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1},
                                    std::numeric_limits<std::int64_t>::max()}) {
    bell.rung_ns.store(forged, std::memory_order_relaxed);
    CHECK(since_ring(bell, now) == Duration::zero());
  }
  bell.rung_ns.store((now - milliseconds{3}).time_since_epoch().count(), std::memory_order_relaxed);
  CHECK(since_ring(bell, now) == milliseconds{3});
}

TEST_CASE("bells: a publication rings for whom its channel wakes, and for nobody else",
          "[mid_level][blackboard]") {
  const auto board = std::make_unique<Blackboard>();
  std::size_t rung = 0;
  for_each_channel(*board, [&]<class C>(const ChannelInfo& info, C& channel) {
    std::array<std::uint32_t, kTaskCount> before{};
    std::transform(board->bells.begin(), board->bells.end(), before.begin(),
                   [](const Bell<>& bell) { return look_at(bell); });
    auto writer = writer_of(*board, channel, info.writer);
    const auto value = std::make_unique<typename C::Value>();
    writer.publish_quietly(*value, Time{Duration{1}});
    for (std::size_t i = 0; i < kTaskCount; ++i) {
      CHECK(look_at(board->bells[i]) == before[i]);
    }
    writer.publish(*value, Time{Duration{1}});
    for (std::size_t i = 0; i < kTaskCount; ++i) {
      INFO(info.name << " and " << to_string(static_cast<TaskId>(i)));
      const std::uint32_t rings = look_at(board->bells[i]) - before[i];
      CHECK(rings == (wakes(info.name, static_cast<TaskId>(i)) ? 1U : 0U));
      rung += rings;
    }
  });
  CHECK(rung > 5);
}

TEST_CASE("bells: a task is woken by what it waits for, however long its period",
          "[mid_level][runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Listening thruster{*board};
  auto helm = writer_of(*board, board->helm_command, Role::kHigh);
  const TaskEntry entry{{TaskId::kThruster, hours{24}, milliseconds{0}, 0}, &thruster};
  const RealtimeRunner runner{std::span{&entry, 1}, *board, Role::kLow, nothing_hangs};
  for (std::uint64_t number = 1; number <= 20; ++number) {
    helm.publish(numbered(number), SteadyClock{}.now());
    wait_for([&] { return thruster.heard_ == number; });
  }
  wait_for([&] {
    helm.publish(numbered(20), SteadyClock{}.now());
    return last_health(*board, TaskId::kThruster).wakes > 1;
  });
  const TaskHealth health = last_health(*board, TaskId::kThruster);
  CHECK(health.wakes == health.steps);
  CHECK(health.worst_late_ns == 0);
}

TEST_CASE("bells: a publication whose ring was lost is found at the next period, not later",
          "[mid_level][runtime]") {
  constexpr Duration kPeriod = milliseconds{50};
  const auto board = std::make_unique<Blackboard>();
  Listening thruster{*board};
  auto helm = writer_of(*board, board->helm_command, Role::kHigh);
  const TaskEntry entry{{TaskId::kThruster, kPeriod, milliseconds{0}, 0}, &thruster};
  const RealtimeRunner runner{std::span{&entry, 1}, *board, Role::kLow, nothing_hangs};
  for (std::uint64_t number = 1; number <= 10; ++number) {
    // As if killed after `newest` was stored. Whoever begins from now on finds it; one step may
    // have begun before.
    helm.publish_quietly(numbered(number), SteadyClock{}.now());
    const int begun = thruster.steps_;
    wait_for([&] { return thruster.heard_ == number || thruster.steps_ >= begun + 2; });
    CHECK(thruster.heard_ == number);
  }
}

TEST_CASE("bells: a storm of rings starves nobody", "[mid_level][runtime]") {
  constexpr Duration kGap = milliseconds{2};
  const auto board = std::make_unique<Blackboard>();
  Listening stormed{*board};
  Listening other{*board};
  TaskSpec spec{TaskId::kThruster, hours{24}, milliseconds{0}, 0};
  spec.least_gap = kGap;
  const std::vector<TaskEntry> entries{
      {spec, &stormed}, {{TaskId::kAhrs, milliseconds{5}, milliseconds{0}, 0}, &other}};
  std::atomic<std::uint64_t> rings{0};
  {
    const RealtimeRunner runner{entries, *board, Role::kLow, nothing_hangs};
    const std::jthread storm{[&](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        ring(board->bell_of(TaskId::kThruster));
        ++rings;
      }
    }};
    wait_for([&] { return stormed.steps_ >= 100 && other.steps_ >= 50; });
  }  // the stop is heard in the storm
  CHECK(rings > 100);
  CHECK(stormed.shortest_gap_.load() >= kGap);
}

TEST_CASE("bells: wakes move no period", "[mid_level][runtime]") {
  constexpr Duration kPeriod = milliseconds{100};
  const auto board = std::make_unique<Blackboard>();
  Listening thruster{*board};
  const TaskEntry entry{{TaskId::kThruster, kPeriod, milliseconds{0}, 0}, &thruster};
  const RealtimeRunner runner{std::span{&entry, 1}, *board, Role::kLow, nothing_hangs};
  wait_for([&] {
    ring(board->bell_of(TaskId::kThruster));
    return last_health(*board, TaskId::kThruster).steps > 100;
  });
  const TaskHealth health = last_health(*board, TaskId::kThruster);
  std::uint64_t by_period = 0;
  for (const std::uint64_t count : health.late) {
    by_period += count;
  }
  CHECK(by_period + health.wakes == health.steps);
  CHECK(by_period >= 1);  // health is told once a second: periods have gone by
  CHECK(health.wakes > by_period);
}

}  // namespace lodesman::testing
