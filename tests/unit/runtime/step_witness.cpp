// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/step_witness.h"

#include <array>
#include <memory>
#include <vector>

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;

namespace {

constexpr Time kStart{std::chrono::seconds{1}};

// In the middle of its step another one publishes what it reads.
class Interrupted final : public Task {
 public:
  explicit Interrupted(Blackboard& board)
      : attitude_{board.attitude},
        plan_{board.plan},
        others_{writer_of(board, board.attitude, Role::kLow)} {}
  void step(Time now) noexcept override {
    others_.publish({}, now);
    const auto* newest = attitude_.latest();
    seen.push_back(newest != nullptr ? newest->sequence : 0);
  }
  [[nodiscard]] std::span<ChannelLook<>* const> inputs() noexcept override { return inputs_; }

  std::vector<std::uint64_t> seen;

 private:
  Reader<Attitude> attitude_;
  Reader<Plan> plan_;
  std::array<ChannelLook<>*, 2> inputs_{&attitude_, &plan_};
  Writer<Attitude> others_;
};

// A task of which nothing is to be made again.
class Blind final : public Task {
 public:
  void step(Time /*now*/) noexcept override {}
};

}  // namespace

TEST_CASE("step witness: it tells what each step saw, and a step sees no more", "[runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Interrupted task{*board};
  Writer<Plan> plans{board->plan, Role::kHigh, "plan"};
  StepWitness witness{*board, {TaskSpec{.id = TaskId::kController}, &task}, Role::kHigh};
  constexpr std::size_t kController = 4;
  Reader<StepInputs> told{board->step_inputs[kController]};
  witness.begin(kStart);
  REQUIRE(told.latest() != nullptr);
  CHECK(told.latest()->value.step == 0);
  for (int i = 1; i <= 3; ++i) {
    const Time now = kStart + i * milliseconds{50};
    plans.publish({}, now);
    witness.look();
    plans.publish({}, now);
    task.step(now);
    witness.stepped(now);
    const auto* newest = told.latest();
    REQUIRE(newest->stamp == now);
    const StepInputs& inputs = newest->value;
    CHECK(inputs.step == static_cast<std::uint64_t>(i));
    CHECK(inputs.whole);
    REQUIRE(inputs.count == 2);
    CHECK(inputs.inputs[0].channel == place_named(*board, "attitude"));
    CHECK(inputs.inputs[0].sequence == static_cast<std::uint64_t>(i - 1));
    CHECK(inputs.inputs[1].channel == place_named(*board, "plan"));
    CHECK(inputs.inputs[1].sequence == static_cast<std::uint64_t>(2 * i - 1));
  }
  CHECK(task.seen == std::vector<std::uint64_t>{0, 1, 2});
}

TEST_CASE("step witness: what comes between a task's making and its first step is the step's",
          "[runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Writer<Plan> plans{board->plan, Role::kHigh, "plan"};
  plans.publish({}, kStart);
  Interrupted task{*board};
  plans.publish({}, kStart);
  StepWitness witness{*board, {TaskSpec{.id = TaskId::kController}, &task}, Role::kHigh};
  Reader<StepInputs> told{board->step_inputs[4]};
  plans.publish({}, kStart);
  witness.begin(kStart);
  REQUIRE(told.latest() != nullptr);
  CHECK(told.latest()->value.step == 0);
  CHECK(told.latest()->value.inputs[1].sequence == 1);
  witness.look();
  task.step(kStart);
  witness.stepped(kStart);
  CHECK(told.latest()->value.inputs[1].sequence == 3);
}

TEST_CASE("step witness: of a task that is stepped on by another runner no beginning is told",
          "[runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Interrupted task{*board};
  const TaskEntry entry{TaskSpec{.id = TaskId::kController}, &task};
  {
    StepWitness first{*board, entry, Role::kHigh};
    first.begin(kStart);
    first.look();
    task.step(kStart);
    first.stepped(kStart);
  }
  StepWitness second{*board, entry, Role::kHigh};
  second.begin(kStart);
  Reader<StepInputs> told{board->step_inputs[4]};
  CHECK(told.newest_sequence() == 2);
  CHECK(told.latest()->value.step == 1);
}

TEST_CASE("step witness: a task without inputs is told nothing of", "[runtime]") {
  const auto board = std::make_unique<Blackboard>();
  Blind task;
  StepWitness witness{*board, {TaskSpec{.id = TaskId::kController}, &task}, Role::kHigh};
  witness.begin(kStart);
  witness.stepped(kStart);
  CHECK(board->step_inputs[4].head.newest.load() == 0);
}
