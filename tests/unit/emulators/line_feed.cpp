// SPDX-License-Identifier: Apache-2.0
// Device, wire and line together, as a world drives them.
#include "hal_sim/emulators/line_feed.h"

#include <memory>

#include "hal_sim/emulators/maestro_box.h"
#include "hal_sim/emulators/nav440_unit.h"
#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

// A NAV440 at the far end, and a host that reads every 10 ms while the world steps every 20.
struct FedLine {
  std::unique_ptr<MemoryLine> line = std::make_unique<MemoryLine>();
  Nav440Unit unit;
  EmulatedWire wire;
  LineFeed feed{unit, wire, *line};
  FaultTimetable timetable;
  std::int64_t ms = 0;
  std::vector<std::pair<Time, std::uint8_t>> read;
  std::uint64_t connections = 0;

  explicit FedLine(const std::vector<Fault>& faults = {}, std::uint64_t seed = 1)
      : unit{options(seed), at_ms(0), std::chrono::minutes{1}},
        wire{"ahrs", seed},
        timetable{faults, FaultDevice::kAhrs} {}
  [[nodiscard]] static Nav440UnitOptions options(std::uint64_t seed) {
    Nav440UnitOptions options;
    options.packet_type = 0x4131;
    options.seed = seed;
    return options;
  }
  void run_until(std::int64_t until_ms) {
    for (; ms < until_ms; ms += 10) {
      if (ms % 20 == 0) {
        timetable.advance(static_cast<double>(ms) * 1e-3, at_ms(ms), unit, wire);
        feed.pump(at_ms(ms));
      }
      connections = line->near_end().connection(at_ms(ms));
      std::array<std::uint8_t, 1> byte{};
      for (;;) {
        const Received received = line->near_end().read(byte, at_ms(ms));
        if (received.count == 0) {
          break;
        }
        read.emplace_back(received.at, byte[0]);
      }
    }
  }
  void write(const Bytes& bytes) {
    CHECK(line->near_end().write(bytes, at_ms(ms)) == bytes.size());
  }
  [[nodiscard]] Bytes bytes() const {
    Bytes all;
    for (const auto& [at, byte] : read) {
      all.push_back(byte);
    }
    return all;
  }
};

TEST_CASE("line feed: a stream arrives at its speed, and orders are obeyed when they are whole",
          "[hal_sim][emulators]") {
  FedLine fed;
  fed.line->near_end().reconnect(38400);
  fed.run_until(1010);
  CHECK(fed.read.size() == 49 * 39);
  for (std::size_t i = 1; i < fed.read.size(); ++i) {
    REQUIRE(fed.read[i].first >= fed.read[i - 1].first);
  }
  CHECK(fed.read[38].first == at_ms(20) + 39 * (Duration{std::chrono::seconds{10}} / 38400));
  fed.read.clear();
  fed.write(hex("55 55 53 46 05 01 00 01 00 00 40 81"));  // quiet
  fed.run_until(2000);
  REQUIRE(fed.read.size() == 39 + 10);
  const Bytes answer = fed.bytes();
  CHECK(Bytes(answer.end() - 10, answer.end()) == hex("55 55 53 46 03 01 00 01 EF 6A"));
}

TEST_CASE("line feed: at another speed there is no answer, at the new one there is",
          "[hal_sim][emulators]") {
  FedLine fed;
  fed.line->near_end().reconnect(38400);
  fed.run_until(20);
  fed.write(hex("55 55 53 46 05 01 00 01 00 00 40 81"));
  fed.run_until(100);
  fed.write(emulated::uu_frame(0x5346, hex("01 00 02 00 03")));
  fed.read.clear();
  fed.run_until(200);
  CHECK(fed.read.size() == 10);  // told at 57600 and heard at 38400
  CHECK(fed.bytes() != emulated::uu_frame(0x5346, hex("01 00 02")));
  CHECK(fed.wire.garbled() == 10);
  fed.line->near_end().reconnect(57600);
  fed.run_until(220);
  fed.read.clear();
  fed.write(hex("55 55 50 4B 00 9E F4"));
  fed.run_until(300);
  CHECK(fed.bytes() == hex("55 55 50 4B 00 9E F4"));
}

TEST_CASE("line feed: faults begin and end at their time, and the line is another afterwards",
          "[hal_sim][emulators]") {
  const std::vector<Fault> faults{{FaultDevice::kAhrs, FaultKind::kDisconnect, 1.0, 0.5},
                                  {FaultDevice::kThruster, FaultKind::kDisconnect, 0.0, 9.0},
                                  {FaultDevice::kAhrs, FaultKind::kStall, 2.0, 0.5},
                                  {FaultDevice::kAhrs, FaultKind::kPower, 3.0, 0.5}};
  FedLine fed{faults};
  fed.run_until(1000);
  CHECK(fed.connections == 1);
  CHECK(fed.read.size() > 45 * 39);
  fed.run_until(1040);
  fed.read.clear();
  fed.run_until(1500);
  CHECK(fed.connections == 0);
  CHECK(fed.read.empty());
  fed.run_until(2020);
  CHECK(fed.connections == 2);
  CHECK(fed.read.size() > 20 * 39);
  fed.read.clear();
  fed.run_until(2500);
  CHECK(fed.read.empty());
  CHECK(fed.connections == 2);
  fed.run_until(3040);
  fed.read.clear();
  fed.run_until(3500);
  CHECK(fed.read.empty());
  fed.run_until(4000);
  CHECK(fed.read.size() > 20 * 39);
  CHECK(fed.connections == 2);
  CHECK(fed.unit.injections().of(FaultKind::kPower).count == 1);
  CHECK(fed.wire.injections().of(FaultKind::kStall).count == 1);
}

TEST_CASE("line feed: the same seed gives the same bytes at the same times",
          "[hal_sim][emulators]") {
  const auto run = [](std::uint64_t seed) {
    FedLine fed{{{FaultDevice::kAhrs, FaultKind::kFlip, 0.0, 9.0, 0.01, 0.0},
                 {FaultDevice::kAhrs, FaultKind::kReplug, 0.0, 9.0, 60.0, 0.0},
                 {FaultDevice::kAhrs, FaultKind::kSpike, 2.0, 5.0, 0.1, 30.0}},
                seed};
    fed.run_until(10'000);
    return fed.read;
  };
  const auto one = run(1);
  CHECK(one.size() > 5000);
  CHECK(one == run(1));
  CHECK(one != run(2));
}

TEST_CASE("line feed: a fault is added while it runs, and taken back", "[hal_sim][emulators]") {
  FedLine fed;
  fed.run_until(100);
  CHECK_FALSE(fed.timetable.add(box_fault(FaultKind::kStall), fed.unit, fed.wire));
  CHECK_FALSE(fed.timetable.add(ahrs_fault(FaultKind::kError), fed.unit, fed.wire));
  CHECK(fed.timetable.add(ahrs_fault(FaultKind::kStall), fed.unit, fed.wire));
  fed.run_until(160);
  fed.read.clear();
  fed.run_until(500);
  CHECK(fed.read.empty());
  fed.timetable.clear();
  fed.run_until(1000);
  CHECK(fed.read.size() > 20 * 39);
}

TEST_CASE("line feed: a box whose line stalls stops by itself", "[hal_sim][emulators]") {
  const auto line = std::make_unique<MemoryLine>();
  MaestroBoxOptions options;
  options.time_out_10ms = 50;
  options.channel[0].home = MaestroHome::kGoTo;
  MaestroBox box{options, at_ms(0)};
  EmulatedWire wire{"thruster", 1};
  LineFeed feed{box, wire, *line};
  FaultTimetable timetable{{{FaultDevice::kThruster, FaultKind::kStall, 1.0, 3.0}},
                           FaultDevice::kThruster};
  std::int64_t stopped_ms = 0;
  for (std::int64_t ms = 0; ms < 3000; ms += 20) {
    timetable.advance(static_cast<double>(ms) * 1e-3, at_ms(ms), box, wire);
    feed.pump(at_ms(ms));
    REQUIRE(line->near_end().connection(at_ms(ms)) == 1);
    CHECK(line->near_end().write(hex("84 00 14 32"), at_ms(ms)) == 4);
    if (ms > 100 && stopped_ms == 0 && box.pulse_quarter_us(0) == 6000) {
      stopped_ms = ms;
    }
  }
  CHECK(stopped_ms == 1460);  // half a second after the last order that came through
}

}  // namespace
}  // namespace lodesman
