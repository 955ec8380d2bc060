// SPDX-License-Identifier: Apache-2.0
// Wakes on the simulated clock: when they come, in which order, and that chance does not move them.
#include <functional>
#include <memory>
#include <vector>

#include "mid_level/runtime/run_lockstep.h"
#include "mid_level/runtime/task_table.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

struct Call {
  TaskId id;
  Time at;
  friend bool operator==(const Call&, const Call&) = default;
};

class Scripted final : public Task {
 public:
  Scripted(TaskId id, std::vector<Call>& calls, std::function<void(Time)> work = {})
      : id_{id}, calls_{calls}, work_{std::move(work)} {}
  void step(Time now) noexcept override {
    calls_.push_back({id_, now});
    if (work_) {
      work_(now);
    }
  }

 private:
  TaskId id_;
  std::vector<Call>& calls_;
  std::function<void(Time)> work_;
};

[[nodiscard]] TaskSpec every(TaskId id, Duration period, Duration phase = {}) {
  TaskSpec spec{id, period, phase, 0};
  spec.nominal = microseconds{100};
  return spec;
}

// The controller publishes every 10 ms and rings for the thruster, which has a period of 35 ms.
struct Chain {
  explicit Chain(const LockstepOptions& options, Duration least_gap = milliseconds{1},
                 bool rings = true)
      : controller{TaskId::kController, calls,
                   [this, rings](Time now) {
                     rings ? helm.publish({}, now) : helm.publish_quietly({}, now);
                   }},
        thruster{TaskId::kThruster, calls} {
    TaskSpec woken = every(TaskId::kThruster, milliseconds{35});
    woken.least_gap = least_gap;
    const std::vector<TaskEntry> entries{
        {every(TaskId::kController, milliseconds{10}), &controller}, {woken, &thruster}};
    LockstepRunner runner{entries, clock, *board, options};
    for (int i = 0; i < 40; ++i) {
      runner.step();
    }
  }
  [[nodiscard]] std::vector<Time> times_of(TaskId id) const {
    std::vector<Time> times;
    for (const Call& call : calls) {
      if (call.id == id) {
        times.push_back(call.at);
      }
    }
    return times;
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Writer<HelmCommand> helm = writer_of(*board, board->helm_command, Role::kHigh);
  SimClock clock;
  std::vector<Call> calls;
  Scripted controller;
  Scripted thruster;
};

[[nodiscard]] Time at(Duration time) { return Time{time}; }

}  // namespace

TEST_CASE("lock-step: who is rung for is due a nominal time after the publication",
          "[mid_level][runtime]") {
  const Chain chain{{}};
  const std::vector<Call> first(chain.calls.begin(), chain.calls.begin() + 9);
  // At 0 both are due, and the ring came before the thruster looked at its bell.
  CHECK(first == std::vector<Call>{{TaskId::kController, at({})},
                                   {TaskId::kThruster, at({})},
                                   {TaskId::kController, at(milliseconds{10})},
                                   {TaskId::kThruster, at(microseconds{10'100})},
                                   {TaskId::kController, at(milliseconds{20})},
                                   {TaskId::kThruster, at(microseconds{20'100})},
                                   {TaskId::kController, at(milliseconds{30})},
                                   {TaskId::kThruster, at(microseconds{30'100})},
                                   {TaskId::kThruster, at(milliseconds{35})}});
}

TEST_CASE("lock-step: nobody is stepped twice at one instant, and wakes move no period",
          "[mid_level][runtime]") {
  const Chain chain{{}};
  const auto times = chain.times_of(TaskId::kThruster);
  for (std::size_t i = 1; i < times.size(); ++i) {
    CHECK(times[i] > times[i - 1]);
  }
  for (int period = 0; at(period * milliseconds{35}) < times.back(); ++period) {
    CHECK(std::count(times.begin(), times.end(), at(period * milliseconds{35})) == 1);
  }
}

TEST_CASE("lock-step: a wake comes no sooner than the least gap after the last step",
          "[mid_level][runtime]") {
  constexpr Duration kGap = milliseconds{25};
  const Chain chain{{}, kGap};
  const auto times = chain.times_of(TaskId::kThruster);
  std::size_t wakes = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const bool by_period = times[i].time_since_epoch() % milliseconds{35} == Duration::zero();
    wakes += by_period ? 0U : 1U;
    CHECK((by_period || times[i] - times[i - 1] >= kGap));
  }
  CHECK(wakes > 3);
}

TEST_CASE("lock-step: without a ring it is the next period", "[mid_level][runtime]") {
  const Chain chain{{}, milliseconds{1}, false};
  for (const Time time : chain.times_of(TaskId::kThruster)) {
    CHECK(time.time_since_epoch() % milliseconds{35} == Duration::zero());
  }
}

TEST_CASE("lock-step: how late a task is follows from seed, task and number, whoever else runs",
          "[mid_level][runtime]") {
  const LockstepOptions jitter{milliseconds{3}, 7};
  CHECK(Chain{jitter}.calls == Chain{jitter}.calls);
  CHECK(Chain{jitter}.calls != Chain{{milliseconds{3}, 8}}.calls);
  // Its periods are as late with wakes as without.
  const auto with = Chain{jitter}.times_of(TaskId::kThruster);
  const auto without = Chain{jitter, milliseconds{1}, false}.times_of(TaskId::kThruster);
  REQUIRE(without.size() > 4);
  for (std::size_t period = 0; period < 4; ++period) {
    CHECK(std::count(with.begin(), with.end(), without[period]) == 1);
  }
}

}  // namespace lodesman::testing
