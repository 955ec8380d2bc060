// SPDX-License-Identifier: Apache-2.0
// The driver and a box that does as it is told.
#include "drivers/roboclaw/roboclaw.h"

#include <cmath>

#include "mid_level/base/startup_error.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/roboclaw/scripted_box.h"

namespace lodesman {
namespace {

using testing::RoboClawBench;
using Bytes = std::vector<std::uint8_t>;
using State = RoboClaw::State;

[[nodiscard]] RoboClawOptions options_of(const std::string& rest) {
  return roboclaw_options(DeviceAddress{rest, roboclaw_settings()});
}

TEST_CASE("roboclaw: an address says which box and which motor", "[roboclaw]") {
  const RoboClawOptions plain = options_of("/dev/ttyACM0");
  CHECK(plain.address == 128);
  CHECK(plain.time_out == from_seconds(0.5));
  CHECK(plain.neutral_first);
  CHECK_FALSE(plain.swap);
  const RoboClawOptions all =
      options_of("/dev/ttyACM0?address=135&time_out_s=0.8&reverse=left&swap=on&neutral_first=off");
  CHECK(all.address == 135);
  CHECK(all.time_out == from_seconds(0.8));
  CHECK(all.left_reversed);
  CHECK_FALSE(all.right_reversed);
  CHECK(all.swap);
  CHECK_FALSE(all.neutral_first);
  for (const char* bad : {"x?address=127", "x?address=136", "x?time_out_s=1", "x?swap=left"}) {
    INFO(bad);
    CHECK_THROWS_AS(options_of(bad), StartupError);
  }
  MemoryLine line;
  CHECK_THROWS_AS((RoboClaw{line.near_end(), options_of("x?time_out_s=0.55"), {}}), StartupError);
  CHECK_NOTHROW((RoboClaw{line.near_end(), options_of("x?time_out_s=0.6"), {}}));
}

TEST_CASE("roboclaw: it is asked, stopped, set, left alone and then taken", "[roboclaw]") {
  RoboClawBench bench;
  bench.box.duties = {9000, -9000};  // of a program before this one
  std::vector<State> states;
  const Time began = bench.now;
  int silent_ms = 0;
  while (bench.step() != CommandStatus::kTaken) {
    REQUIRE(bench.now - began < from_seconds(10));
    CHECK(bench.status == CommandStatus::kNotReady);
    if (states.empty() || states.back() != bench.driver.state()) {
      states.push_back(bench.driver.state());
    }
    silent_ms += bench.sent.empty() ? 50 : 0;
    CHECK((bench.stopped() || bench.now - began < from_seconds(0.15)));
  }
  // That of each step's end: the first question is asked in the first.
  CHECK(states == std::vector{State::kIdentifying, State::kStopping, State::kSetting,
                              State::kReadingTimeOut, State::kPausing, State::kReadingDuties,
                              State::kReadingStatus, State::kHolding});
  CHECK(silent_ms >= 700);
  CHECK(bench.box.time_out == 5);
  CHECK(bench.driver.version() == "USB Roboclaw 2x30a v4.1.34\n");
  CHECK(bench.driver.status_word() == 0x1234);
  CHECK(bench.driver.fault() == DeviceFault::kNone);
}

TEST_CASE("roboclaw: each command byte comes out as its duty on both motors", "[roboclaw]") {
  RoboClawBench bench{{.address = 0x83}, options_of("x?address=131&swap=on&reverse=right")};
  REQUIRE(bench.start());
  for (int value = 0; value <= 255; ++value) {
    const ThrustCommand command{static_cast<std::uint8_t>(value),
                                static_cast<std::uint8_t>(255 - value)};
    const double share = (value <= 127 ? value - 127 : value - 128) / 127.0;
    const int duty = static_cast<int>(std::lround(share * 32767));
    // Once a while something is read in its place.
    for (int i = 0; i < 2; ++i) {
      REQUIRE(bench.step(command) == CommandStatus::kTaken);
    }
    CHECK(bench.box.duties[1] == duty);
    CHECK(bench.box.duties[0] == duty);  // the other way round, and reversed
  }
  CHECK(bench.box.refused == 0);
}

TEST_CASE("roboclaw: the duties of the table", "[roboclaw]") {
  RoboClawBench bench;
  REQUIRE(bench.start());
  const std::pair<int, int> rows[] = {{0, -32767}, {37, -23221}, {126, -258}, {127, 0},
                                      {128, 0},    {129, 258},   {156, 7224}, {255, 32767}};
  for (const auto& row : rows) {
    const auto command = static_cast<std::uint8_t>(row.first);
    bench.step({command, 128});
    bench.step({command, 128});
    CHECK(bench.box.duties[0] == row.second);
    CHECK(bench.box.duties[1] == 0);
  }
}

TEST_CASE("roboclaw: the battery is told at least once a second", "[roboclaw]") {
  RoboClawBench bench;
  CHECK(bench.driver.battery().measured == Time{});
  REQUIRE(bench.start());
  for (int i = 0; i < 200; ++i) {
    bench.box.volts = 25.2 - 0.01 * i;
    REQUIRE(bench.step({200, 60}) == CommandStatus::kTaken);
    if (i > 20) {
      CHECK(bench.now - bench.driver.battery().measured <= from_seconds(1.0));
      CHECK(bench.driver.battery().volts == Approx(bench.box.volts).margin(0.3));
    }
  }
}

TEST_CASE("roboclaw: neutral goes out in the very call that commands it", "[roboclaw]") {
  for (int ms = 1; ms <= 60; ++ms) {  // answers take two
    for (int steps = 0; steps < 20; ++steps) {
      RoboClawBench bench;
      REQUIRE(bench.start());
      for (int i = 0; i < 10 + steps; ++i) {
        bench.step({255, 0});
      }
      bench.step({255, 0}, ms);
      REQUIRE_FALSE(bench.stopped());
      CHECK(bench.step(kNeutralThrust) == CommandStatus::kTaken);
      CHECK(bench.stopped());
      for (int i = 0; i < 20; ++i) {
        CHECK(bench.step(kNeutralThrust) == CommandStatus::kTaken);
      }
      bench.step({255, 0});
      bench.step({255, 0});
      CHECK_FALSE(bench.stopped());
    }
    ms += ms > 4 ? 9 : 0;
  }
}

TEST_CASE("roboclaw: steps that come faster than answers cost nothing", "[roboclaw]") {
  RoboClawBench bench;
  REQUIRE(bench.start());
  bench.damage = [](Bytes&) { return 20; };
  for (int i = 0; i < 500; ++i) {
    REQUIRE(bench.step({200, 200}, 7) == CommandStatus::kTaken);
  }
  CHECK(bench.driver.counts().lost == 0);
  CHECK(bench.driver.counts().duties > 100);
}

TEST_CASE("roboclaw: what is said to it allocates nothing", "[roboclaw]") {
  RoboClawBench bench;
  const testing::AllocationScope scope;
  std::uint64_t allocated = 0;
  for (int i = 0; i < 120; ++i) {
    const std::uint64_t before = scope.count();
    const ThrustCommand command = i < 60 ? kNeutralThrust : ThrustCommand{200, 60};
    bench.status = bench.driver.command(command, bench.now);
    allocated += scope.count() - before;
    bench.pass(50);
  }
  CHECK(bench.status == CommandStatus::kTaken);
  CHECK(allocated == 0);
}

}  // namespace
}  // namespace lodesman
