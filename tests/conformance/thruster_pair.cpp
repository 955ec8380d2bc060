// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tests/conformance/driver_bench.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"

namespace lodesman::conformance {
namespace {

using ThrusterPairs = std::tuple<SimThrusterBench, MaestroBench, RoboClawBench>;

// 127 stops as 128 does, and a box has one word for both.
[[nodiscard]] ThrustCommand as_run(ThrustCommand command) noexcept {
  const auto side = [](std::uint8_t value) noexcept {
    return value == 127 ? std::uint8_t{128} : value;
  };
  return {side(command.left), side(command.right)};
}

// Commands as its task does until that is applied; false where it takes more steps than it may, or
// is not taken.
template <class Bench>
[[nodiscard]] bool applies(Bench& bench, ThrustCommand command) {
  for (int step = 0; step < Bench::steps_to_apply(); ++step) {
    if (bench.device().command(command, bench.now()) != CommandStatus::kTaken) {
      return false;
    }
    bench.pass(kTaskPeriod);
    if (as_run(bench.applied()) == as_run(command)) {
      return true;
    }
  }
  return false;
}

// Gives a command at each step for so long; what the last one came to.
template <class Bench>
CommandStatus command_for(Bench& bench, ThrustCommand command, Duration span) {
  CommandStatus status = CommandStatus::kTaken;
  for (const Time end = bench.now() + span; bench.now() < end;) {
    status = bench.device().command(command, bench.now());
    bench.pass(kTaskPeriod);
  }
  return status;
}

constexpr ThrustCommand kSome{200, 60};

TEMPLATE_LIST_TEST_CASE("thruster pair: stopped until the first command", "[conformance]",
                        ThrusterPairs) {
  TestType bench;
  bench.pass(2 * kTaskPeriod);
  CHECK(bench.applied() == kNeutralThrust);
  bench.come_up();
  CHECK(bench.applied() == kNeutralThrust);
}

TEMPLATE_LIST_TEST_CASE("thruster pair: takes and applies every command of both sides",
                        "[conformance]", ThrusterPairs) {
  TestType bench;
  bench.come_up();
  for (int value = 0; value <= 255; ++value) {
    CAPTURE(value);
    REQUIRE(
        applies(bench, {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(255 - value)}));
  }
}

TEMPLATE_LIST_TEST_CASE("thruster pair: neutral waits for nothing", "[conformance]",
                        ThrusterPairs) {
  TestType bench;
  bench.come_up();
  for (int steps = 2; steps < 40; ++steps) {  // in any phase of what else is asked
    CAPTURE(steps);
    REQUIRE(applies(bench, kSome));
    REQUIRE(command_for(bench, kSome, steps * kTaskPeriod) == CommandStatus::kTaken);
    REQUIRE(bench.applied() == kSome);
    REQUIRE(bench.device().command(kNeutralThrust, bench.now()) == CommandStatus::kTaken);
    bench.pass(kTaskPeriod);
    CHECK(as_run(bench.applied()) == kNeutralThrust);
  }
}

TEMPLATE_LIST_TEST_CASE("thruster pair: a command holds, and falls at the time-out",
                        "[conformance]", ThrusterPairs) {
  TestType bench;
  bench.come_up();
  REQUIRE(applies(bench, kSome));
  bench.pass(TestType::time_out() / 2);
  CHECK(bench.applied() == kSome);
  REQUIRE(applies(bench, kSome));  // sets the time-out anew
  bench.pass(TestType::time_out() * 3 / 4);
  CHECK(bench.applied() == kSome);
  bench.pass(TestType::time_out() / 2);
  CHECK(bench.applied() == kNeutralThrust);
  CHECK(applies(bench, kSome));
}

TEMPLATE_LIST_TEST_CASE("thruster pair: a box that is gone says so, stops, and comes back",
                        "[conformance]", ThrusterPairs) {
  TestType bench;
  bench.come_up();
  REQUIRE(applies(bench, kSome));
  bench.fail(BenchFault::kDisconnect);
  const CommandStatus status = command_for(bench, kSome, 2 * TestType::time_out());
  CHECK(status == CommandStatus::kDisconnected);
  CHECK(bench.applied() == kNeutralThrust);
  bench.mend();
  bench.come_up();
  CHECK(applies(bench, kSome));
}

// It falls silent, or what it says is garbled: it may take commands or not, and turns nothing that
// was not commanded.
TEMPLATE_LIST_TEST_CASE("thruster pair: a box at fault runs as commanded or stops, and comes back",
                        "[conformance]", ThrusterPairs) {
  for (const BenchFault fault : {BenchFault::kStall, BenchFault::kCorrupt}) {
    CAPTURE(static_cast<int>(fault));
    TestType bench;
    bench.come_up();
    REQUIRE(applies(bench, kSome));
    bench.fail(fault);
    for (const Time end = bench.now() + 20 * TestType::time_out(); bench.now() < end;) {
      const CommandStatus status = bench.device().command(kSome, bench.now());
      CHECK(status != CommandStatus::kDisconnected);
      bench.pass(kTaskPeriod);
      CHECK((bench.applied() == kSome || bench.applied() == kNeutralThrust));
    }
    CHECK(bench.applied() == kNeutralThrust);
    bench.mend();
    bench.come_up();
    CHECK(applies(bench, kSome));
  }
}

TEMPLATE_LIST_TEST_CASE("thruster pair: nothing is taken from the heap, whatever happens",
                        "[conformance]", ThrusterPairs) {
  TestType bench;
  int taken = 0;
  std::uint64_t taken_from_heap = 0;
  const auto use = [&](ThrustCommand command) {
    for (int i = 0; i < 200; ++i) {
      {
        const testing::AllocationScope scope;
        taken += bench.device().command(command, bench.now()) == CommandStatus::kTaken ? 1 : 0;
        taken_from_heap += scope.count();
      }
      bench.pass(kTaskPeriod);
    }
  };
  use(kNeutralThrust);  // its start-up too
  use(kSome);
  for (const auto fault : {BenchFault::kStall, BenchFault::kCorrupt, BenchFault::kDisconnect}) {
    bench.fail(fault);
    use(kSome);
    bench.mend();
    use(kNeutralThrust);
    use(kSome);
  }
  CHECK(taken > 800);
  CHECK(taken_from_heap == 0);
}

}  // namespace
}  // namespace lodesman::conformance
