// SPDX-License-Identifier: Apache-2.0
// Faults of answers, settings and speed controllers that such boxes were seen to have.
#include "tests/support/catch.h"
#include "tests/unit/maestro/scripted_box.h"

namespace lodesman {
namespace {

using testing::kAhead;
using testing::kAheadPulse;
using testing::MaestroBench;
using Bytes = std::vector<std::uint8_t>;
using State = Maestro::State;

// Steps neutral until the driver says what ails the box, or so many steps.
[[nodiscard]] bool comes_to(MaestroBench& bench, DeviceFault fault, int most = 200) {
  for (int i = 0; i < most; ++i) {
    bench.step();
    if (bench.driver.fault() == fault) {
      return true;
    }
  }
  return false;
}

[[nodiscard]] bool never_taken(MaestroBench& bench, int steps) {
  bool taken = false;
  for (int i = 0; i < steps; ++i) {
    taken = bench.step() == CommandStatus::kTaken || taken;
  }
  return !taken;
}

TEST_CASE("T1: a maestro in its factory mode is never taken, and its mode is named", "[maestro]") {
  MaestroBench bench{{.deaf = true}};
  REQUIRE(comes_to(bench, DeviceFault::kWrongMode, 40));
  for (int i = 0; i < 200; ++i) {
    CHECK(bench.step() == CommandStatus::kNotReady);
    CHECK(bench.driver.fault() == DeviceFault::kWrongMode);  // told once, not once a try
    for (const std::uint8_t byte : bench.sent) {
      CHECK(byte == 0xA1);  // nothing but the question
    }
  }
  bench.box.settings.deaf = false;
  CHECK(bench.start());
}

TEST_CASE("T2: a maestro without time-out is never taken", "[maestro]") {
  MaestroBench bench{{.time_out_ms = 0}};
  REQUIRE(comes_to(bench, DeviceFault::kNoTimeOut));
  CHECK(never_taken(bench, 400));
  CHECK(bench.driver.fault() == DeviceFault::kNoTimeOut);
  CHECK(bench.neutral());
  bench.box.settings.time_out_ms = 500;
  CHECK(bench.start());
}

TEST_CASE("T2: nor one whose time-out is longer than was said", "[maestro]") {
  MaestroBench bench{{.time_out_ms = 1000}};
  REQUIRE(comes_to(bench, DeviceFault::kNoTimeOut));
  CHECK(never_taken(bench, 200));
}

TEST_CASE("T2: nor one that keeps its pulses when it times out, or stops them", "[maestro]") {
  MaestroBench keeps{{.keeps_pulses = true}};
  CHECK(comes_to(keeps, DeviceFault::kNotNeutral));
  CHECK(never_taken(keeps, 200));
  MaestroBench off{{.home = 0}};
  CHECK(comes_to(off, DeviceFault::kNotNeutral));
  CHECK(never_taken(off, 200));
  MaestroBench elsewhere{{.home = 6040}};
  CHECK(comes_to(elsewhere, DeviceFault::kNotNeutral));
}

TEST_CASE("T3: without commands the maestro is not spoken to, and stops by itself", "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  for (int i = 0; i < 40; ++i) {
    bench.step(kAhead);
  }
  CHECK(bench.box.pulses[0] == kAheadPulse);
  const int commands = bench.box.commands;
  bench.pass(510);
  CHECK(bench.box.commands == commands);
  CHECK(bench.neutral());
  // Its time-out was ours: commands resume, and nothing is held against the box.
  for (int i = 0; i < 5; ++i) {
    CHECK(bench.step(kAhead) == CommandStatus::kTaken);
    CHECK(bench.box.pulses[0] == kAheadPulse);
    for (int step = 0; step < 20; ++step) {
      CHECK(bench.step(kAhead) == CommandStatus::kTaken);
    }
    bench.pass(600);
  }
  CHECK(bench.driver.counts().error_reports == 0);
  CHECK(bench.driver.counts().resets == 0);
}

TEST_CASE("T7: one lost byte of an answer costs nothing", "[maestro]") {
  for (int lost = 0; lost < 6; ++lost) {
    INFO("answer " << lost);
    MaestroBench bench;
    REQUIRE(bench.start());
    int answers = 0;
    bench.damage = [&](Bytes& reply) {
      if (answers++ == lost) {
        reply.pop_back();
      }
    };
    for (int i = 0; i < 60; ++i) {
      CHECK(bench.step(kAhead) == CommandStatus::kTaken);
      CHECK(bench.box.pulses[0] == kAheadPulse);
    }
    CHECK(bench.driver.counts().lost_answers == 1);
    CHECK(answers > 60);
  }
}

TEST_CASE("T7: a byte too many costs nothing either", "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  bool once = true;
  bench.damage = [&](Bytes& reply) {
    if (std::exchange(once, false)) {
      reply.insert(reply.begin(), 0x55);
    }
  };
  for (int i = 0; i < 60; ++i) {
    CHECK(bench.step(kAhead) == CommandStatus::kTaken);
  }
  CHECK(bench.driver.counts().lost_answers == 1);
  CHECK(bench.driver.counts().resets == 0);
}

TEST_CASE("T7: after the third lost answer in a row it is neutral and not ready", "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  bench.damage = [](Bytes& reply) { reply.clear(); };
  int taken = 0;
  while (bench.step(kAhead) == CommandStatus::kTaken) {
    REQUIRE(++taken < 40);
  }
  CHECK(taken < 30);  // three times 100 ms to wait and twice 300 ms of quiet
  CHECK(bench.driver.fault() == DeviceFault::kNoAnswer);
  CHECK(bench.driver.counts().lost_answers == 3);
  CHECK(bench.neutral());
  bench.damage = nullptr;
  CHECK(bench.start());
}

TEST_CASE("T7: answers that come late are given to no later question", "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  for (const int late_ms : {150, 200, 300}) {
    bench.reply_delay_ms = late_ms;
    bench.step(kAhead);
    bench.reply_delay_ms = 1;
    for (int i = 0; i < 40; ++i) {
      CHECK(bench.step(kAhead) == CommandStatus::kTaken);
    }
  }
  CHECK(bench.driver.counts().lost_answers == 3);
  CHECK(bench.driver.counts().resets == 0);
}

TEST_CASE("T9: an error is noticed within a second and commands resume", "[maestro]") {
  for (const unsigned bit : {0U, 1U, 2U, 3U, 4U, 5U, 8U}) {
    INFO("bit " << bit);
    MaestroBench bench;
    REQUIRE(bench.start());
    for (int i = 0; i < 30; ++i) {
      REQUIRE(bench.step(kAhead) == CommandStatus::kTaken);
    }
    bench.box.fail(bit);
    REQUIRE(bench.neutral());
    CHECK(bench.step(kAhead) == CommandStatus::kTaken);
    CHECK(bench.box.pulses[0] == kAheadPulse);
    for (int i = 0; i < 19; ++i) {
      CHECK(bench.step(kAhead) == CommandStatus::kTaken);
    }
    CHECK(bench.driver.counts().error_reports == 1);
    CHECK(bench.driver.counts().resets == 0);
  }
}

TEST_CASE("T9: three errors in ten seconds are a fault, three in longer are none", "[maestro]") {
  const auto after = [](int steps_between) {
    MaestroBench bench;
    REQUIRE(bench.start());
    for (int error = 0; error < 3; ++error) {
      for (int i = 0; i < steps_between; ++i) {
        REQUIRE(bench.step(kAhead) == CommandStatus::kTaken);
      }
      bench.box.fail(4);
    }
    for (int i = 0; i < 20 && bench.step(kAhead) == CommandStatus::kTaken; ++i) {
    }
    CHECK(bench.driver.counts().error_reports == 3);
    CHECK((bench.status == CommandStatus::kTaken || bench.neutral()));
    return bench.driver.fault();
  };
  CHECK(after(60) == DeviceFault::kBoxError);
  CHECK(after(140) == DeviceFault::kNone);
}

TEST_CASE("T10: a reversal pauses at zero, and stop is never delayed", "[maestro]") {
  ThrustShapeOptions shape;
  shape.slew_per_s = 2.0;
  shape.zero_pause = from_seconds(0.3);
  MaestroBench bench{{}, {}, shape};
  REQUIRE(bench.start());
  int steps = 0;
  for (; bench.box.pulses[0] < 6000 + 1905; ++steps) {
    REQUIRE(bench.step({255, 255}) == CommandStatus::kTaken);
    REQUIRE(steps < 40);
  }
  CHECK(steps == 10);  // half a second
  int neutral = 0;
  for (bench.step({0, 0}); bench.box.pulses[0] == 6000; bench.step({0, 0})) {
    ++neutral;
    REQUIRE(neutral < 40);
  }
  CHECK(neutral == 6);
  CHECK(bench.box.pulses[0] == 6000 - 190);  // a twentieth of a second at two per second: 0.1
  bench.step(kNeutralThrust);
  CHECK(bench.neutral());
}

TEST_CASE("T12: neutral pulses are held before the first command", "[maestro]") {
  for (const int hold_s : {0, 2, 5}) {
    MaestroOptions options;
    options.hold_neutral = std::chrono::seconds{hold_s};
    MaestroBench bench{{}, options};
    int exact_ms = 0;
    for (int i = 0; i < 200 && bench.step() != CommandStatus::kTaken; ++i) {
      exact_ms += bench.driver.state() == State::kHolding && bench.neutral() ? 50 : 0;
    }
    REQUIRE(bench.status == CommandStatus::kTaken);
    CHECK(exact_ms >= 1000 * hold_s);
    CHECK(exact_ms <= 1000 * hold_s + 100);
  }
}

TEST_CASE("T13: a command that is there from the beginning waits until neutral was commanded",
          "[maestro]") {
  MaestroBench bench;
  for (int i = 0; i < 200; ++i) {
    CHECK(bench.step(kAhead) == CommandStatus::kNotReady);
    CHECK(bench.nearly_neutral());
  }
  CHECK(bench.step(kNeutralThrust) == CommandStatus::kTaken);
  CHECK(bench.step(kAhead) == CommandStatus::kTaken);
  CHECK(bench.box.pulses[1] == kAheadPulse);

  MaestroOptions options;
  options.neutral_first = false;
  MaestroBench other{{}, options};
  for (int i = 0; i < 100 && other.step(kAhead) != CommandStatus::kTaken; ++i) {
    CHECK(other.nearly_neutral());
  }
  CHECK(other.status == CommandStatus::kTaken);
}

}  // namespace
}  // namespace lodesman
