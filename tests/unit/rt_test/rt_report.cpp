// SPDX-License-Identifier: Apache-2.0
// Figures and verdict of two looks that are made up.
#include "deploy/operator/rt_test/rt_report.h"

#include "tests/support/catch.h"

namespace lodesman::cli {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr pid_t kFirstThread = 100;

std::uint64_t ns(Duration duration) { return static_cast<std::uint64_t>(duration.count()); }

// A boat that keeps its table: each task's steps take 100 us and begin 10 us late.
BoatLook good_look(int after_s) {
  BoatLook look;
  look.at = Time{seconds{1000 + after_s}};
  look.counts_allocations = true;
  for (std::size_t i = 0; i < kTaskCount; ++i) {
    TaskHealth health;
    health.fifo_priority = static_cast<std::uint64_t>(kTaskTable[i].fifo_priority);
    health.steps = static_cast<std::uint64_t>(100 + 10 * after_s);
    health.late[late_bucket(microseconds{10})] = health.steps;
    health.took[late_bucket(microseconds{100})] = health.steps;
    health.worst_late_ns = ns(milliseconds{40});  // of the start, before the first look
    health.worst_step_ns = ns(microseconds{100});
    health.over_budget = 1;  // likewise
    look.health[i] = health;
    ThreadFacts thread;
    thread.thread = kFirstThread + static_cast<pid_t>(i);
    thread.minor_faults = 5;  // likewise
    look.threads[to_string(static_cast<TaskId>(i))] = thread;
    look.allocations[thread.thread] = 1000;  // likewise
  }
  for (const WakeEdge& edge : kWakeEdges) {
    look.publications[std::string{edge.channel}] = static_cast<std::uint64_t>(10 * after_s);
  }
  return look;
}

struct Judged {
  BoatLook first = good_look(0);
  BoatLook last = good_look(10);
  std::optional<CyclictestFigures> cyclictest;

  TaskHealth& health(TaskId task) { return *last.health[static_cast<std::size_t>(task)]; }
  [[nodiscard]] RtReport report() const {
    RtConditions conditions;
    conditions.wanted_s = 10.0;
    conditions.seconds = 10.0;
    conditions.cores = 2;
    return report_of(conditions, first, last, cyclictest);
  }
  [[nodiscard]] std::vector<std::string> reasons() const { return objections(report()); }
};

using Reasons = std::vector<std::string>;

}  // namespace

TEST_CASE("rt report: what was before the first look does not count", "[operator][rt_test]") {
  const Judged boat;
  CHECK(boat.reasons() == Reasons{});
  const RtReport report = boat.report();
  REQUIRE(report.tasks.size() == kTaskCount);
  for (const TaskFigures& figures : report.tasks) {
    CHECK(figures.steps == 100);
    CHECK(figures.over_budget == 0);
    CHECK(figures.worst_late == microseconds{16});
    CHECK(figures.worst_took <= microseconds{128});
    CHECK(figures.allocations == 0U);
    REQUIRE(figures.thread);
    CHECK(figures.thread->minor_faults == 0);
  }
}

TEST_CASE("rt report: what the table does not allow is an objection each", "[operator][rt_test]") {
  Judged boat;
  boat.health(TaskId::kThruster).overruns += 2;
  boat.health(TaskId::kThruster).past_deadline += 3;
  boat.health(TaskId::kPlanner).over_budget += 4;
  boat.health(TaskId::kAhrs).fifo_priority = 0;
  boat.last.threads["controller"].major_faults += 1;
  boat.last.allocations[kFirstThread] += 6;
  CHECK(boat.reasons() ==
        Reasons{"world: 6 allocations in steps", "ahrs: holds SCHED_FIFO priority 0 of 60",
                "planner: 4 steps were longer than their budget", "controller: 1 page faults",
                "thruster: 2 periods missed", "thruster: 3 steps ended after their deadline"});
}

TEST_CASE("rt report: who was begun anew, or never stepped, cannot be counted",
          "[operator][rt_test]") {
  Judged boat;
  boat.health(TaskId::kPlanner).steps = 3;
  boat.last.health[static_cast<std::size_t>(TaskId::kAhrs)].reset();
  CHECK(boat.reasons() ==
        Reasons{"ahrs: its steps could not be counted", "planner: its steps could not be counted"});
}

TEST_CASE("rt report: allocations that were not counted are not said to be none",
          "[operator][rt_test]") {
  Judged boat;
  boat.last.counts_allocations = false;
  const auto document = to_json(boat.report());
  CHECK(document["tasks"][0]["allocations"].is_null());
  CHECK(document["verdict"] == "pass");
}

TEST_CASE("rt report: steps that are too long for all others fail the analysis",
          "[operator][rt_test]") {
  Judged boat;
  TaskHealth& thruster = boat.health(TaskId::kThruster);
  thruster.worst_step_ns = ns(milliseconds{6});
  ++thruster.took[late_bucket(milliseconds{6})];
  const Reasons reasons = boat.reasons();
  REQUIRE(!reasons.empty());
  CHECK(reasons.back() ==
        "thruster: by the analysis a step may end 12.00 ms after its release on 2 cores, its "
        "deadline is 5 ms");
}

TEST_CASE("rt report: what the machine itself takes to wake up is part of the analysis",
          "[operator][rt_test]") {
  Judged boat;
  boat.cyclictest = CyclictestFigures{};
  boat.cyclictest->wakes = 1;
  const auto before = boat.report().responses.back().one_core;
  boat.cyclictest->worst = milliseconds{2};
  const auto after = boat.report().responses.back().one_core;
  REQUIRE(before);
  REQUIRE(after);
  CHECK(*after >= *before + milliseconds{2});
  boat.cyclictest->worst = milliseconds{6};
  CHECK(!boat.reasons().empty());
}

TEST_CASE("rt report: one that ended early does not pass", "[operator][rt_test]") {
  const Judged boat;
  RtReport report = boat.report();
  report.conditions.seconds = 4.0;
  CHECK(objections(report) == Reasons{"it ended after 4.0 of 10.0 s"});
}

TEST_CASE("rt report: the table has a line for each task, twice, and cyclictest's",
          "[operator][rt_test]") {
  Judged boat;
  boat.cyclictest = CyclictestFigures{};
  boat.cyclictest->wakes = 1;
  std::map<std::string, int> lines;
  for (const std::string& line : table_lines(boat.report())) {
    ++lines[line.substr(0, line.find(' '))];
  }
  for (const TaskSpec& spec : kTaskTable) {
    CHECK(lines[to_string(spec.id)] == 2);
  }
  CHECK(lines["cyclictest"] == 1);
}

}  // namespace lodesman::cli
