// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/bench.h"
#include "tests/support/catch.h"

namespace lodesman::conformance {
namespace {

using ThrusterPairs = std::tuple<SimThrusterBench>;
using std::chrono::milliseconds;

TEMPLATE_LIST_TEST_CASE("thruster pair: stopped until the first command", "[conformance]",
                        ThrusterPairs) {
  TestType bench;
  bench.pass(milliseconds{100});
  CHECK(bench.applied() == kNeutralThrust);
}

TEMPLATE_LIST_TEST_CASE("thruster pair: takes and applies every command of both sides",
                        "[conformance]", ThrusterPairs) {
  TestType bench;
  for (int value = 0; value <= 255; ++value) {
    const ThrustCommand command{static_cast<std::uint8_t>(value),
                                static_cast<std::uint8_t>(255 - value)};
    REQUIRE(bench.device().command(command, bench.now()) == CommandStatus::kTaken);
    bench.pass(milliseconds{50});
    CHECK(bench.applied() == command);
  }
}

TEMPLATE_LIST_TEST_CASE("thruster pair: a command holds, and falls at the time-out",
                        "[conformance]", ThrusterPairs) {
  TestType bench;
  const ThrustCommand command{200, 60};
  REQUIRE(bench.device().command(command, bench.now()) == CommandStatus::kTaken);
  bench.pass(TestType::time_out() / 2);
  CHECK(bench.applied() == command);
  REQUIRE(bench.device().command(command, bench.now()) ==
          CommandStatus::kTaken);  // sets the time-out anew
  bench.pass(TestType::time_out() * 3 / 4);
  CHECK(bench.applied() == command);
  bench.pass(TestType::time_out() / 2);
  CHECK(bench.applied() == kNeutralThrust);
  REQUIRE(bench.device().command(command, bench.now()) == CommandStatus::kTaken);
  bench.pass(milliseconds{50});
  CHECK(bench.applied() == command);
}

TEMPLATE_LIST_TEST_CASE("thruster pair: a box that is gone says so, stops, and comes back",
                        "[conformance]", ThrusterPairs) {
  TestType bench;
  const ThrustCommand command{200, 60};
  REQUIRE(bench.device().command(command, bench.now()) == CommandStatus::kTaken);
  bench.fail(BenchFault::kDisconnect);
  CommandStatus status = CommandStatus::kTaken;
  for (Duration waited{}; waited <= 2 * TestType::time_out(); waited += milliseconds{50}) {
    status = bench.device().command(command, bench.now());
    bench.pass(milliseconds{50});
  }
  CHECK(status == CommandStatus::kDisconnected);
  CHECK(bench.applied() == kNeutralThrust);
  bench.mend();
  for (int i = 0; i < 40 && status != CommandStatus::kTaken; ++i) {
    status = bench.device().command(command, bench.now());
    bench.pass(milliseconds{50});
  }
  CHECK(status == CommandStatus::kTaken);
  CHECK(bench.applied() == command);
}

}  // namespace
}  // namespace lodesman::conformance
