// SPDX-License-Identifier: Apache-2.0
// No step of any task asks anything of the heap once the boat is under way: the whole boat in
// lock-step, with the allocations inside each step counted.
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/voyage.h"
#include "mid_level/runtime/run_lockstep.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/support/self_start.h"

namespace lodesman {
namespace {

using testing::AllocationScope;

// Steps a task and counts.
class CountedTask final : public Task {
 public:
  explicit CountedTask(Task& task) : task_{task} {}
  void step(Time now) noexcept override {
    const AllocationScope scope;
    task_.step(now);
    ++steps_;
    allocations_ += scope.count();
  }
  void reset() noexcept { steps_ = allocations_ = 0; }
  [[nodiscard]] std::uint64_t steps() const noexcept { return steps_; }
  [[nodiscard]] std::uint64_t allocations() const noexcept { return allocations_; }

 private:
  Task& task_;
  std::uint64_t steps_ = 0;
  std::uint64_t allocations_ = 0;
};

// The whole boat with a counter round each task.
class CountedBoat {
 public:
  CountedBoat(const BoatConfig& configuration, const Scenario& scenario)
      : boat_{*board_, configuration, &scenario},
        high_{*board_, Role::kHigh,
              high_level_options(configuration, voyage_of(configuration, &scenario))},
        self_start_{*board_, configuration, scenario, [this] { return clock_.now(); }} {
    std::vector<TaskEntry> entries = boat_.tasks();
    for (const TaskEntry& entry : high_.tasks()) {
      entries.push_back(entry);
    }
    for (TaskEntry& entry : entries) {
      auto& counted = tasks_[entry.spec.id];
      counted = std::make_unique<CountedTask>(*entry.task);
      entry.task = counted.get();
    }
    clock_.advance_to(Time{std::chrono::seconds{1}});
    runner_ = std::make_unique<LockstepRunner>(entries, clock_, *board_, LockstepOptions{});
  }

  void sail(Duration duration) {
    const Time end = clock_.now() + duration;
    while (clock_.now() < end) {
      runner_->step();
      if (plans() == 0) {
        self_start_.look();
      }
    }
  }
  void reset() {
    for (const auto& [id, task] : tasks_) {
      task->reset();
    }
  }
  [[nodiscard]] const std::map<TaskId, std::unique_ptr<CountedTask>>& tasks() const {
    return tasks_;
  }
  [[nodiscard]] std::uint64_t plans() {
    const auto* newest = plan_.latest();
    return newest != nullptr ? newest->value.id : 0;
  }

 private:
  std::unique_ptr<Blackboard> board_ = std::make_unique<Blackboard>();
  AssembledBoat boat_;
  HighLevel high_;
  SimClock clock_;
  testing::SelfStart self_start_;
  std::map<TaskId, std::unique_ptr<CountedTask>> tasks_;
  std::unique_ptr<LockstepRunner> runner_;
  Reader<Plan> plan_{board_->plan};
};

void check_no_allocation(const std::string& profile, const std::string& scenario) {
  const BoatConfig configuration = load_configuration(profile, {});
  CountedBoat boat{configuration, load_named_scenario(scenario, configuration.speeds)};
  boat.sail(std::chrono::seconds{5});
  boat.reset();
  const std::uint64_t plans = boat.plans();
  boat.sail(std::chrono::seconds{60});
  CHECK(boat.plans() > plans + 30);
  CHECK(boat.tasks().size() == kTaskCount);
  for (const auto& [id, task] : boat.tasks()) {
    INFO(to_string(id));
    CHECK(task->steps() > 500);
    CHECK(task->allocations() == 0);
  }
}

TEST_CASE("no_allocation: no step of the paper's profile allocates", "[system][allocation]") {
  check_no_allocation("paper", "paper-moving");
}

TEST_CASE("no_allocation: no step of the default profile allocates", "[system][allocation]") {
  check_no_allocation("default", "paper-moving");
}

class AllocatingTask final : public Task {
 public:
  void step(Time /*now*/) noexcept override {
    numbers_ = std::make_unique<int>(3);
    // Volatile, so that no compiler leaves the call out.
    void* volatile block = std::malloc(16);
    std::free(block);
  }

 private:
  std::unique_ptr<int> numbers_;
};

TEST_CASE("no_allocation: a task that allocates is seen, by new and by malloc",
          "[system][allocation]") {
  AllocatingTask task;
  CountedTask counted{task};
  counted.step(Time{});
  counted.step(Time{});
  CHECK(counted.steps() == 2);
  CHECK(counted.allocations() == 4);
}

}  // namespace
}  // namespace lodesman
