// SPDX-License-Identifier: Apache-2.0
// The driver and a box that does as it is told.
#include "drivers/maestro/maestro.h"

#include "mid_level/base/startup_error.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/maestro/scripted_box.h"

namespace lodesman {
namespace {

using testing::MaestroBench;
using Bytes = std::vector<std::uint8_t>;
using State = Maestro::State;

[[nodiscard]] MaestroOptions options_of(const std::string& rest) {
  return maestro_options(DeviceAddress{rest, maestro_settings()});
}

TEST_CASE("maestro: an address says where the thrusters are", "[maestro]") {
  const MaestroOptions plain = options_of("/dev/ttyACM0");
  CHECK(plain.left_channel == 0);
  CHECK(plain.right_channel == 1);
  CHECK_FALSE(plain.left_reversed);
  CHECK_FALSE(plain.crc);
  CHECK(plain.neutral_first);
  CHECK(plain.time_out == from_seconds(0.5));
  const MaestroOptions all = options_of(
      "/dev/ttyACM0?left=5&right=4&reverse=right&neutral_us=1510&range_us=400&time_out_s=0.8"
      "&hold_neutral_s=3&crc=on&neutral_first=off");
  CHECK(all.left_channel == 5);
  CHECK(all.right_channel == 4);
  CHECK_FALSE(all.left_reversed);
  CHECK(all.right_reversed);
  CHECK(all.neutral_us == Approx(1510.0));
  CHECK(all.range_us == Approx(400.0));
  CHECK(all.time_out == from_seconds(0.8));
  CHECK(all.hold_neutral == from_seconds(3));
  CHECK(all.crc);
  CHECK_FALSE(all.neutral_first);
  CHECK(options_of("x?reverse=both").left_reversed);
  for (const char* bad : {"x?left=24", "x?time_out_s=0.29", "x?time_out_s=0.91", "x?crc=yes",
                          "x?reverse=ahead", "x?range_us=nan", "x?device=12"}) {
    INFO(bad);
    CHECK_THROWS_AS(options_of(bad), StartupError);
  }
}

TEST_CASE("maestro: thrusters on one channel, or pulses that cannot be, are refused", "[maestro]") {
  MemoryLine line;
  const auto made = [&](const char* rest) { Maestro{line.near_end(), options_of(rest), {}}; };
  CHECK_NOTHROW(made("x?left=1&right=0"));
  CHECK_THROWS_AS(made("x?left=1&right=1"), StartupError);
  CHECK_THROWS_AS(made("x?left=1"), StartupError);
  CHECK_THROWS_AS(made("x?neutral_us=1000&range_us=1000"), StartupError);
}

TEST_CASE("maestro: it is asked, proved, held at neutral and then taken", "[maestro]") {
  MaestroBench bench;
  std::vector<State> states;
  std::vector<DeviceFault> faults;
  const Time began = bench.now;
  while (bench.step() != CommandStatus::kTaken) {
    REQUIRE(bench.now - began < from_seconds(10));
    CHECK(bench.status == CommandStatus::kNotReady);
    CHECK(bench.nearly_neutral());
    if (states.empty() || states.back() != bench.driver.state()) {
      states.push_back(bench.driver.state());
      faults.push_back(bench.driver.fault());
    }
  }
  CHECK(states ==
        std::vector{State::kIdentifying, State::kPausing, State::kReadingBack, State::kHolding});
  CHECK(faults == std::vector{DeviceFault::kStarting, DeviceFault::kProving, DeviceFault::kProving,
                              DeviceFault::kStarting});
  CHECK(bench.driver.fault() == DeviceFault::kNone);
  CHECK(bench.now - began > from_seconds(0.75 + 2.0));
  CHECK(bench.now - began < from_seconds(3.2));
  CHECK(bench.driver.counts().starts == 1);
}

TEST_CASE("maestro: nothing at all is said while the time-out is proved", "[maestro]") {
  MaestroBench bench;
  for (int i = 0; i < 10 && bench.driver.state() != State::kPausing; ++i) {
    bench.step();
  }
  REQUIRE(bench.driver.state() == State::kPausing);
  int silent_ms = 0;
  for (bench.step(); bench.driver.state() == State::kPausing; bench.step()) {
    CHECK(bench.sent.empty());
    silent_ms += 50;
  }
  CHECK(silent_ms >= 650);
  CHECK(bench.sent == Bytes{0xA1, 0x90, 0x00, 0x90, 0x01});
}

TEST_CASE("maestro: each command byte comes out as its pulse on both channels", "[maestro]") {
  MaestroBench bench{{}, options_of("x?left=3&right=2&reverse=right")};
  REQUIRE(bench.start());
  for (int value = 0; value <= 255; ++value) {
    const ThrustCommand command{static_cast<std::uint8_t>(value),
                                static_cast<std::uint8_t>(255 - value)};
    REQUIRE(bench.step(command) == CommandStatus::kTaken);
    const int step = value <= 127 ? value - 127 : value - 128;
    CHECK(bench.box.pulses[3] == 6000 + 15 * step);
    CHECK(bench.box.pulses[2] == 6000 + 15 * step);  // the other way round, and reversed
  }
}

TEST_CASE("maestro: both channels leave in one write, behind the questions for what was before",
          "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  bench.step({156, 37});
  const Bytes targets{0x84, 0x00, 0x14, 0x32, 0x84, 0x01, 0x2A, 0x24};
  REQUIRE(bench.sent.size() >= targets.size());
  CHECK(std::equal(targets.rbegin(), targets.rend(), bench.sent.rbegin()));
  int asked_errors = 0;
  for (int i = 0; i < 160; ++i) {  // 8 s
    bench.step({156, 37});
    REQUIRE(bench.sent.size() >= 12);
    CHECK(std::equal(targets.rbegin(), targets.rend(), bench.sent.rbegin()));
    asked_errors += bench.sent[0] == 0xA1 ? 1 : 0;
  }
  CHECK(asked_errors == 10);
}

TEST_CASE("maestro: with its check the box is spoken to with checks", "[maestro]") {
  MaestroBench bench{{.crc = true}, options_of("x?crc=on")};
  REQUIRE(bench.start());
  REQUIRE(bench.step({156, 37}) == CommandStatus::kTaken);
  CHECK(bench.box.pulses[0] == 6420);
  CHECK(bench.box.pulses[1] == 4650);
  CHECK(bench.sent[bench.sent.size() - 10] == 0x84);
}

TEST_CASE("maestro: what is said to it allocates nothing", "[maestro]") {
  MaestroBench bench;
  const testing::AllocationScope scope;
  std::uint64_t allocated = 0;
  for (int i = 0; i < 120; ++i) {
    const std::uint64_t before = scope.count();
    const ThrustCommand command = i < 80 ? kNeutralThrust : ThrustCommand{200, 60};
    bench.status = bench.driver.command(command, bench.now);
    allocated += scope.count() - before;
    bench.pass(50);
  }
  CHECK(bench.status == CommandStatus::kTaken);
  CHECK(allocated == 0);
}

}  // namespace
}  // namespace lodesman
