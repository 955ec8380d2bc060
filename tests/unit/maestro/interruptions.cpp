// SPDX-License-Identifier: Apache-2.0
// Boxes that forget, sleep, vanish or are others, and lines that are full.
#include "tests/support/catch.h"
#include "tests/unit/maestro/scripted_box.h"

namespace lodesman {
namespace {

using testing::kAhead;
using testing::kAheadPulse;
using testing::MaestroBench;
using Bytes = std::vector<std::uint8_t>;
using State = Maestro::State;

TEST_CASE("T15: a box that has forgotten its targets is found out within a second", "[maestro]") {
  for (const int home : {0, 6000}) {
    for (int phase = 0; phase < 17; ++phase) {  // of the question for errors
      INFO("home " << home << ", phase " << phase);
      MaestroBench bench;
      REQUIRE(bench.start());
      for (int i = 0; i < 5 + phase; ++i) {
        REQUIRE(bench.step(kAhead) == CommandStatus::kTaken);
      }
      bench.box.reset();
      bench.box.pulses.fill(home);
      int steps = 0;
      while (bench.step(kAhead) == CommandStatus::kTaken) {
        REQUIRE(++steps < 20);
      }
      CHECK(bench.driver.fault() == DeviceFault::kBoxReset);
      CHECK(bench.neutral());
      CHECK(bench.driver.counts().resets == 1);
    }
  }
}

TEST_CASE("T15: after a reset all begins anew, and neutral has to be commanded", "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  for (int i = 0; i < 10; ++i) {
    REQUIRE(bench.step(kAhead) == CommandStatus::kTaken);
  }
  bench.box.reset();
  for (int i = 0; i < 2; ++i) {
    bench.step(kAhead);
  }
  for (int i = 0; i < 200; ++i) {
    CHECK(bench.step(kAhead) == CommandStatus::kNotReady);
    CHECK(bench.nearly_neutral());
    CHECK(bench.driver.fault() == DeviceFault::kBoxReset);
  }
  CHECK(bench.step(kNeutralThrust) == CommandStatus::kTaken);
  CHECK(bench.step(kAhead) == CommandStatus::kTaken);
}

TEST_CASE("T15: one wrong answer is no reset", "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  bench.step(kAhead);
  int wrong = 0;
  for (int phase = 0; phase < 40; ++phase) {
    bool once = phase % 2 == 0;
    bench.damage = [&](Bytes& reply) {
      if (once && reply[1] != 0) {  // a position
        once = false;
        ++wrong;
        reply[1] = static_cast<std::uint8_t>(reply[1] ^ 0x40U);
      }
    };
    for (int i = 0; i < 10 + phase % 13; ++i) {  // of the question for errors, any phase
      CHECK(bench.step(kAhead) == CommandStatus::kTaken);
    }
  }
  CHECK(wrong == 20);
}

TEST_CASE("T15: one channel that does not obey is found out too", "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  bench.step(kAhead);
  bench.box.refused_channel = 1;
  for (int i = 0; i < 20 && bench.step({255, 255}) == CommandStatus::kTaken; ++i) {
  }
  CHECK(bench.driver.fault() == DeviceFault::kBoxReset);
}

TEST_CASE("S5: a box that is gone says so at once, and begins anew when it is back", "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  REQUIRE(bench.step(kAhead) == CommandStatus::kTaken);
  bench.line->unplug();
  CHECK(bench.step(kAhead) == CommandStatus::kDisconnected);
  CHECK(bench.driver.fault() == DeviceFault::kUnplugged);
  CHECK(bench.driver.state() == State::kDisconnected);
  bench.pass(600);
  bench.line->plug();
  for (int i = 0; i < 100; ++i) {
    CHECK(bench.step(kAhead) == CommandStatus::kNotReady);
    CHECK(bench.nearly_neutral());
  }
  CHECK(bench.start());
  CHECK(bench.driver.counts().starts == 2);
}

TEST_CASE("S6: a full line tears no command, and the newest is sent when there is room",
          "[maestro]") {
  for (std::size_t room = 0; room <= 24; ++room) {
    INFO("room for " << room);
    MaestroBench bench;
    REQUIRE(bench.start());
    REQUIRE(bench.step(kAhead) == CommandStatus::kTaken);
    bench.answers = false;
    bench.line->set_outward_room(room);
    int refused = 0;
    for (int i = 0; i < 5; ++i) {
      refused += bench.step({200, 200}, 40) == CommandStatus::kNotReady ? 1 : 0;
    }
    CHECK(refused >= 3);
    CHECK(bench.driver.fault() == DeviceFault::kLineFull);
    bench.answers = true;
    bench.pass(1);
    bench.line->set_outward_room(1000);
    CHECK(bench.step({60, 60}) == CommandStatus::kTaken);
    CHECK(bench.box.pulses[0] == 6000 - 15 * 67);
    CHECK(bench.box.pulses[1] == 6000 - 15 * 67);
    for (int i = 0; i < 40; ++i) {
      CHECK(bench.step({60, 60}) == CommandStatus::kTaken);
    }
    CHECK(bench.driver.counts().error_reports == 0);
    CHECK(bench.driver.counts().resets == 0);
  }
}

TEST_CASE("U3: another device on the port is not taken for the box, nor given targets",
          "[maestro]") {
  MaestroBench bench{{.deaf = true}};
  for (int i = 0; i < 100; ++i) {
    for (int byte = 0; byte < 39; ++byte) {
      bench.line->send(static_cast<std::uint8_t>(byte * 7), bench.now + from_seconds(0.001 * byte));
    }
    CHECK(bench.step() == CommandStatus::kNotReady);
    for (const std::uint8_t byte : bench.sent) {
      CHECK(byte == 0xA1);
    }
  }
  CHECK(bench.driver.fault() == DeviceFault::kWrongDevice);
}

TEST_CASE("U6: a box that slept begins anew, at neutral", "[maestro]") {
  MaestroBench bench;
  REQUIRE(bench.start());
  for (int i = 0; i < 20; ++i) {
    REQUIRE(bench.step(kAhead) == CommandStatus::kTaken);
  }
  bench.answers = false;
  for (int i = 0; i < 60; ++i) {
    bench.step(kAhead);
  }
  CHECK(bench.status == CommandStatus::kNotReady);
  CHECK(bench.driver.fault() == DeviceFault::kNoAnswer);
  // It wakes with outputs off, to whatever was said last.
  bench.box.reset();
  bench.box.pulses.fill(0);
  bench.answers = true;
  for (int i = 0; i < 100; ++i) {
    bench.step(kAhead);
    CHECK(bench.status == CommandStatus::kNotReady);
    CHECK((bench.nearly_neutral() || bench.box.pulses[0] == 0));
  }
  CHECK(bench.start());
}

}  // namespace
}  // namespace lodesman
