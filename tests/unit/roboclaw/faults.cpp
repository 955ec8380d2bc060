// SPDX-License-Identifier: Apache-2.0
// Faults that such boxes were seen to have, one test a fault.
#include "tests/support/catch.h"
#include "tests/unit/roboclaw/scripted_box.h"

namespace lodesman {
namespace {

using testing::RoboClawBench;
using Bytes = std::vector<std::uint8_t>;
using State = RoboClaw::State;

constexpr ThrustCommand kAhead{191, 191};  // 63 of 127
constexpr int kAheadDuty = 16254;

[[nodiscard]] bool comes_to(RoboClawBench& bench, DeviceFault fault, int most = 200) {
  for (int i = 0; i < most; ++i) {
    bench.step();
    if (bench.driver.fault() == fault) {
      return true;
    }
  }
  return false;
}

[[nodiscard]] bool never_taken(RoboClawBench& bench, int steps) {
  bool taken = false;
  for (int i = 0; i < steps; ++i) {
    taken = bench.step() == CommandStatus::kTaken || taken;
  }
  return !taken;
}

TEST_CASE("T1: a roboclaw that does not answer is never taken, nor moved", "[roboclaw]") {
  RoboClawBench bench{{.address = 0x81}};
  REQUIRE(comes_to(bench, DeviceFault::kNoAnswer, 40));
  for (int i = 0; i < 200; ++i) {
    CHECK(bench.step() == CommandStatus::kNotReady);
    CHECK(bench.driver.fault() == DeviceFault::kNoAnswer);
    CHECK((bench.sent.empty() || bench.sent == Bytes{0x80, 0x15}));
  }
  bench.box.settings.address = 0x80;
  CHECK(bench.start());
}

TEST_CASE("T2: a roboclaw that keeps another time-out is never taken", "[roboclaw]") {
  for (const int stored : {0, 10}) {
    RoboClawBench bench{{.stored_time_out = stored, .keeps_time_out = true}};
    REQUIRE(comes_to(bench, DeviceFault::kSettingRefused));
    CHECK(never_taken(bench, 200));
    CHECK(bench.driver.fault() == DeviceFault::kSettingRefused);
  }
}

TEST_CASE("T2: nor one that does not stand still by itself", "[roboclaw]") {
  RoboClawBench bench{{.drift = 100}};
  REQUIRE(comes_to(bench, DeviceFault::kNotNeutral));
  CHECK(never_taken(bench, 200));
}

TEST_CASE("T3: without commands the roboclaw is not spoken to, and stops by itself", "[roboclaw]") {
  RoboClawBench bench;
  REQUIRE(bench.start());
  for (int i = 0; i < 40; ++i) {
    bench.step(kAhead);
  }
  CHECK(bench.box.duties[0] == kAheadDuty);
  bench.sent.clear();
  bench.pass(560);
  CHECK(bench.sent.empty());
  CHECK(bench.stopped());
  CHECK(bench.step(kAhead) == CommandStatus::kTaken);
  CHECK(bench.step(kAhead) == CommandStatus::kTaken);
  CHECK(bench.box.duties[0] == kAheadDuty);
}

TEST_CASE("T6: an acknowledge that comes late is credited to no other command", "[roboclaw]") {
  for (const int late_ms : {101, 150, 230, 300}) {
    for (const bool overtaken : {false, true}) {
      INFO(late_ms << (overtaken ? " ms, out of turn" : " ms, and all behind it"));
      RoboClawBench bench;
      REQUIRE(bench.start());
      const std::uint64_t before = bench.driver.counts().acknowledged;
      const std::uint64_t told = bench.box.accepted;
      int answers = 0;
      std::uint64_t in_time = 0;
      Time free_at{};
      bench.damage = [&](Bytes& reply) {
        const bool acknowledge = reply.size() == 1;
        int late = acknowledge && ++answers % 20 == 0 ? late_ms : 0;
        const Time due = bench.now + std::chrono::milliseconds{late};
        if (!overtaken && due < free_at) {  // a line keeps the order
          late = static_cast<int>((free_at - bench.now).count() / 1000000);
        }
        free_at = std::max(free_at, bench.now + std::chrono::milliseconds{late});
        in_time += acknowledge && late == 0 ? 1 : 0;
        return late;
      };
      // Every seventh packet is damaged on its way, and gets no acknowledge at all.
      int packets = 0;
      bench.noise = [&](std::uint8_t byte) {
        packets += byte == 0x22 ? 1 : 0;
        return packets % 7 == 3 && byte == 0x22 ? std::uint8_t{0x23} : byte;
      };
      int ready = 0;
      int not_ready = 0;  // in a row: a stop may be damaged too, two of them are not
      for (int i = 0; i < 1000; ++i) {
        not_ready = bench.step(kAhead) == CommandStatus::kTaken ? 0 : not_ready + 1;
        ready += not_ready == 0 ? 1 : 0;
        if (bench.driver.state() == State::kResting) {
          bench.start();
        }
        CHECK((not_ready < 2 || bench.stopped()));
      }
      const std::uint64_t credited = bench.driver.counts().acknowledged - before;
      CHECK(ready > 100);
      CHECK(credited > 100);
      CHECK(credited <= in_time);
      CHECK(credited <= bench.box.accepted - told);
    }
  }
}

TEST_CASE("T6: one late acknowledge costs a moment of neutral, and no more", "[roboclaw]") {
  RoboClawBench bench;
  REQUIRE(bench.start());
  for (int i = 0; i < 9; ++i) {
    bench.step(kAhead);
  }
  bool once = true;
  bench.damage = [&](Bytes& reply) {
    return reply.size() == 1 && std::exchange(once, false) ? 170 : 0;
  };
  int not_ready = 0;
  for (int i = 0; i < 40; ++i) {
    if (bench.step(kAhead) == CommandStatus::kNotReady) {
      ++not_ready;
      CHECK(bench.stopped());
    }
  }
  CHECK(not_ready > 0);
  CHECK(not_ready <= 8);
  CHECK(bench.status == CommandStatus::kTaken);
  CHECK(bench.box.duties[0] == kAheadDuty);
}

TEST_CASE("T7: a lost reply to a question costs nothing", "[roboclaw]") {
  RoboClawBench bench;
  REQUIRE(bench.start());
  bool once = true;
  bench.damage = [&](Bytes& reply) {
    if (reply.size() > 1 && std::exchange(once, false)) {
      reply.pop_back();
    }
    return 0;
  };
  for (int i = 0; i < 60; ++i) {
    CHECK(bench.step(kAhead) == CommandStatus::kTaken);
  }
  CHECK_FALSE(once);
  CHECK(bench.driver.counts().lost == 1);
}

TEST_CASE("T7: after the third loss in a row it is stopped and not ready", "[roboclaw]") {
  RoboClawBench bench;
  REQUIRE(bench.start());
  bench.damage = [](Bytes& reply) {
    reply.clear();
    return 0;
  };
  int steps = 0;
  while (bench.driver.state() != State::kResting) {
    bench.step(kAhead);
    REQUIRE(++steps < 60);
  }
  CHECK(bench.driver.fault() == DeviceFault::kNoAnswer);
  CHECK(bench.stopped());
  bench.damage = nullptr;
  CHECK(bench.start());
}

TEST_CASE("T7: two losses in a row cost a stop, the third one makes a fault", "[roboclaw]") {
  for (const std::uint64_t losses : {1U, 2U, 3U}) {
    for (const bool questions_alone : {false, true}) {
      INFO(losses << (questions_alone ? " answers" : " of all replies"));
      RoboClawBench bench;
      REQUIRE(bench.start());
      bench.damage = [&](Bytes& reply) {
        if (bench.driver.counts().lost < losses && (reply.size() > 1 || !questions_alone)) {
          reply.clear();
        }
        return 0;
      };
      bool rested = false;
      for (int i = 0; i < 60; ++i) {
        bench.step(kAhead);
        rested = rested || bench.driver.state() == State::kResting;
      }
      CHECK(bench.driver.counts().lost == losses);
      CHECK(rested == (losses == 3));
      CHECK(bench.driver.fault() == (losses == 3 ? DeviceFault::kNoAnswer : DeviceFault::kNone));
      CHECK((bench.status == CommandStatus::kTaken) == (losses < 3));
      CHECK(bench.stopped() == (losses == 3));
    }
  }
}

TEST_CASE("T7: questions alone that are never answered are a fault too", "[roboclaw]") {
  RoboClawBench bench;
  REQUIRE(bench.start());
  bench.damage = [](Bytes& reply) {
    if (reply.size() > 1) {
      reply.clear();
    }
    return 0;
  };
  for (int i = 0; i < 60 && bench.step(kAhead) == CommandStatus::kTaken; ++i) {
  }
  CHECK(bench.driver.fault() == DeviceFault::kNoAnswer);
  CHECK(bench.stopped());
}

TEST_CASE("T8: a status of either length starts the box alike", "[roboclaw]") {
  for (const bool long_status : {false, true}) {
    RoboClawBench bench{{.long_status = long_status}};
    REQUIRE(bench.start());
    CHECK(bench.driver.status_word() == 0x1234);
    CHECK(bench.driver.counts().lost == 0);
  }
}

TEST_CASE("T10: a reversal pauses at zero, and stop is never delayed", "[roboclaw]") {
  ThrustShapeOptions shape;
  shape.zero_pause = from_seconds(0.3);
  RoboClawBench bench{{}, {}, shape};
  REQUIRE(bench.start());
  bench.step({255, 255});
  bench.step({255, 255});
  REQUIRE(bench.box.duties[0] == 32767);
  int stopped = 0;
  for (bench.step({0, 0}); bench.box.duties[0] >= 0; bench.step({0, 0})) {
    stopped += bench.stopped() ? 1 : 0;
    REQUIRE(stopped < 20);
  }
  CHECK(stopped >= 5);
  bench.step(kNeutralThrust);
  CHECK(bench.stopped());
}

TEST_CASE(
    "T13: a command that is there from the beginning waits until neutral was commanded, of "
    "a roboclaw too",
    "[roboclaw]") {
  RoboClawBench bench;
  for (int i = 0; i < 200; ++i) {
    CHECK(bench.step(kAhead) == CommandStatus::kNotReady);
    CHECK(bench.stopped());
  }
  REQUIRE(bench.start(4));
  bench.step(kAhead);
  CHECK(bench.step(kAhead) == CommandStatus::kTaken);
  CHECK(bench.box.duties[1] == kAheadDuty);

  RoboClawOptions options;
  options.neutral_first = false;
  RoboClawBench other{{}, options};
  for (int i = 0; i < 60 && other.step(kAhead) != CommandStatus::kTaken; ++i) {
    CHECK(other.stopped());
  }
  CHECK(other.status == CommandStatus::kTaken);
}

TEST_CASE("T15: a roboclaw that has forgotten its time-out is found out within a second",
          "[roboclaw]") {
  for (int phase = 0; phase < 20; ++phase) {
    RoboClawBench bench;
    REQUIRE(bench.start());
    for (int i = 0; i < 20 + phase; ++i) {
      REQUIRE(bench.step(kAhead) == CommandStatus::kTaken);
    }
    bench.box.reset();
    int steps = 0;
    while (bench.step(kAhead) == CommandStatus::kTaken) {
      REQUIRE(++steps < 20);
    }
    CHECK(bench.driver.fault() == DeviceFault::kBoxReset);
    CHECK(bench.stopped());
    CHECK(bench.start());
    CHECK(bench.box.time_out == 5);
  }
}

TEST_CASE("S5: a roboclaw that is gone says so at once, and begins anew when it is back",
          "[roboclaw]") {
  RoboClawBench bench;
  REQUIRE(bench.start());
  bench.step(kAhead);
  bench.line->unplug();
  CHECK(bench.step(kAhead) == CommandStatus::kDisconnected);
  CHECK(bench.driver.fault() == DeviceFault::kUnplugged);
  bench.pass(600);
  bench.line->plug();
  for (int i = 0; i < 60; ++i) {
    CHECK(bench.step(kAhead) == CommandStatus::kNotReady);
    CHECK(bench.stopped());
  }
  CHECK(bench.start());
  CHECK(bench.driver.counts().starts == 2);
}

TEST_CASE("S6: a full line moves no motor by a torn packet, and goes on", "[roboclaw]") {
  for (std::size_t room = 0; room <= 16; ++room) {
    INFO("room for " << room);
    RoboClawBench bench;
    REQUIRE(bench.start());
    bench.step(kAhead);
    bench.step(kAhead);
    bench.answers = false;
    bench.line->set_outward_room(room);
    bool full = false;
    for (int i = 0; i < 5; ++i) {
      full = bench.step({200, 200}) == CommandStatus::kNotReady || full;
    }
    CHECK(full);
    bench.answers = true;
    bench.line->set_outward_room(1000);
    bench.pass(20);
    const std::array<int, 2> held = bench.box.duties;
    CHECK((held == std::array{kAheadDuty, kAheadDuty} || held == std::array{0, 0} ||
           held == std::array{18577, 18577}));
    for (int i = 0; i < 30; ++i) {
      const bool taken = bench.step({60, 60}) == CommandStatus::kTaken;
      CHECK((taken || bench.stopped()));
    }
    CHECK(bench.status == CommandStatus::kTaken);
    CHECK(bench.box.duties[0] == -17287);
    CHECK(bench.box.duties[1] == -17287);
  }
}

TEST_CASE("U3: another device on the port is not taken for a roboclaw, nor moved", "[roboclaw]") {
  RoboClawBench bench{{.address = 0x81}};
  for (int i = 0; i < 100; ++i) {
    for (int byte = 0; byte < 39; ++byte) {
      bench.line->send(static_cast<std::uint8_t>(byte * 7), bench.now + from_seconds(0.001 * byte));
    }
    CHECK(bench.step() == CommandStatus::kNotReady);
    CHECK((bench.sent.empty() || bench.sent == Bytes{0x80, 0x15}));
  }
  CHECK(bench.driver.fault() == DeviceFault::kWrongDevice);
}

TEST_CASE("U6: a roboclaw that slept begins anew, stopped", "[roboclaw]") {
  RoboClawBench bench;
  REQUIRE(bench.start());
  bench.step(kAhead);
  bench.answers = false;
  for (int i = 0; i < 60; ++i) {
    bench.step(kAhead);
  }
  CHECK(bench.status == CommandStatus::kNotReady);
  CHECK(bench.driver.fault() == DeviceFault::kNoAnswer);
  bench.box.reset();
  bench.answers = true;
  for (int i = 0; i < 200; ++i) {
    CHECK(bench.step(kAhead) == CommandStatus::kNotReady);
  }
  CHECK(bench.stopped());
  CHECK(bench.start());
}

}  // namespace
}  // namespace lodesman
