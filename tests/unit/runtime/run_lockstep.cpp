// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/run_lockstep.h"

#include <memory>
#include <vector>

#include "mid_level/recording/recording_hash.h"
#include "mid_level/runtime/task_table.h"
#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;

namespace {

struct Call {
  TaskId id;
  Time at;
  friend bool operator==(const Call&, const Call&) = default;
};

class Noting final : public Task {
 public:
  Noting(TaskId id, std::vector<Call>& calls) : id_{id}, calls_{calls} {}
  void step(Time now) noexcept override { calls_.push_back({id_, now}); }

 private:
  TaskId id_;
  std::vector<Call>& calls_;
};

std::vector<Call> calls_with(Duration jitter, std::uint64_t seed) {
  std::vector<Call> calls;
  Noting fast{TaskId::kThruster, calls};
  Noting slow{TaskId::kWorld, calls};
  const auto board = std::make_unique<Blackboard>();
  SimClock clock;
  const std::vector<TaskEntry> entries{
      {{TaskId::kThruster, milliseconds{10}, milliseconds{0}, 0}, &fast},
      {{TaskId::kWorld, milliseconds{20}, milliseconds{0}, 0}, &slow}};
  LockstepRunner runner{entries, clock, *board, {jitter, seed}};
  for (int i = 0; i < 30; ++i) {
    runner.step();
  }
  return calls;
}

}  // namespace

TEST_CASE("lock-step: tasks run by due time, and by precedence when due together",
          "[mid_level][runtime]") {
  const auto calls = calls_with({}, 0);
  CHECK(calls[0] == Call{TaskId::kWorld, Time{}});
  CHECK(calls[1] == Call{TaskId::kThruster, Time{}});
  CHECK(calls[2] == Call{TaskId::kThruster, Time{milliseconds{10}}});
  CHECK(calls[3] == Call{TaskId::kWorld, Time{milliseconds{20}}});
}

TEST_CASE("lock-step: jitter comes from its seed alone and never adds up", "[mid_level][runtime]") {
  CHECK(calls_with(milliseconds{5}, 1) == calls_with(milliseconds{5}, 1));
  CHECK(calls_with(milliseconds{5}, 1) != calls_with(milliseconds{5}, 2));
  int fast = 0;
  for (const auto& call : calls_with(milliseconds{5}, 3)) {
    if (call.id == TaskId::kThruster) {
      CHECK(call.at - Time{fast * milliseconds{10}} <= milliseconds{5});
      ++fast;
    }
  }
}

TEST_CASE("task table: rows stand in the order of their tasks", "[mid_level][runtime]") {
  for (std::size_t i = 0; i < kTaskCount; ++i) {
    CHECK(static_cast<std::size_t>(kTaskTable[i].id) == i);
    CHECK(kTaskTable[i].period > kTaskTable[i].phase);
  }
}

TEST_CASE("recording hash: any published value, stamp or order changes it, wall times do not",
          "[mid_level][recording]") {
  const auto digest = [](std::int32_t head_ref, std::int64_t stamp, std::uint32_t wall_time) {
    const auto board = std::make_unique<Blackboard>();
    RecordingHash hash{*board};
    Writer<HelmCommand> helm{board->helm_command, Role::kHigh, "helm"};
    Writer<SonarPath> paths{board->sonar_path, Role::kLow, "path"};
    Writer<TaskHealth> health{board->task_health[0], Role::kLow, "world"};
    HelmCommand command;
    command.head_ref = head_ref;
    helm.publish(command, Time{Duration{stamp}});
    const auto path = std::make_unique<SonarPath>();
    path->plan_time_ns = wall_time;
    paths.publish(*path, Time{Duration{stamp}});
    TaskHealth measured{1, 0, 0, wall_time, wall_time, wall_time, wall_time};
    measured.late[wall_time] = 1;
    health.publish(measured, Time{Duration{stamp}});
    hash.update();
    return hash.digest();
  };
  CHECK(digest(1, 1, 5).size() == 32);
  CHECK(digest(1, 1, 5) == digest(1, 1, 6));
  CHECK(digest(1, 1, 5) != digest(2, 1, 5));
  CHECK(digest(1, 1, 5) != digest(1, 2, 5));
}
