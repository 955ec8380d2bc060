// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "tests/support/catch.h"
#include "tests/unit/nav440/scripted_unit.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

[[nodiscard]] Nav440Options wanted(Nav440Packet packet, int rate_hz = 50, int baud = 57600) {
  Nav440Options options;
  options.packet = packet;
  options.rate_hz = rate_hz;
  options.baud = baud;
  return options;
}

TEST_CASE("nav440 start-up: a unit is asked who it is, set, and read back", "[nav440]") {
  UnitBench bench;
  bench.unit.stored_divider = 1;
  bench.unit.power_cycle();
  bench.step();
  CHECK(bench.fault() == DeviceFault::kStarting);
  REQUIRE(bench.comes_up(0.5));
  CHECK(bench.fault() == DeviceFault::kNone);
  CHECK(bench.driver->identity().known);
  CHECK(bench.driver->identity().serial == 440123456);
  CHECK(std::string{bench.driver->identity().model.data()} == "NAV440 2.0.1 8350-2000");
  CHECK(bench.driver->identity().version.major == 20);
  CHECK(bench.driver->packet() == nav440::kA1);
  CHECK(bench.unit.type() == "A1");
  CHECK(bench.unit.divider() == 2);
  CHECK(bench.unit.pings == 1);
  CHECK(bench.unit.sets == 2);  // silence, and what is wanted
  CHECK(bench.unit.writes == 0);
  bench.run(1.0);
  CHECK(bench.samples.size() >= 49);
  CHECK(bench.corrupt == 0);
  CHECK(bench.unit.sets == 2);
}

TEST_CASE("nav440 start-up: every packet and rate comes from a unit of any speed and setting",
          "[nav440]") {
  for (const Nav440Packet packet :
       {Nav440Packet::kA0, Nav440Packet::kA1, Nav440Packet::kN0, Nav440Packet::kN1}) {
    for (const int baud : {9600, 19200, 38400, 57600}) {
      for (const int rate_hz : {2, 20, 100}) {
        INFO(static_cast<int>(packet) << " at " << rate_hz << " Hz from " << baud);
        UnitBench bench{wanted(packet, rate_hz)};
        bench.unit.stored_baud = baud;
        bench.unit.stored_type = "N0";
        bench.unit.stored_divider = 10;
        bench.unit.power_cycle();
        REQUIRE(bench.comes_up(rate_hz == 2 ? 8.0 : 4.0));
        CHECK(bench.unit.divider() == 100 / rate_hz);
        CHECK(bench.unit.baud() == bench.driver->baud());
        // It is left at its speed where that will do.
        const bool will_do = rate_hz <= nav440::most_packets_hz(nav440::first_choice(packet), baud);
        CHECK(bench.unit.baud() == (will_do ? baud : 57600));
        CHECK(bench.unit.writes == 0);
      }
    }
  }
}

TEST_CASE("nav440 start-up: F5: a unit that says it took a new speed and did not is found again",
          "[nav440]") {
  UnitBench bench;
  bench.unit.stored_baud = 9600;
  bench.unit.power_cycle();
  bench.unit.ignores_speed = true;
  bench.run(8.0);
  CHECK(bench.samples.empty());
  CHECK(bench.fault() == DeviceFault::kSettingRefused);
  bench.unit.ignores_speed = false;
  REQUIRE(bench.comes_up());
  CHECK(bench.unit.baud() == 57600);
  CHECK(bench.fault() == DeviceFault::kNone);
}

TEST_CASE("nav440 start-up: F5: a unit whose answer to a new speed is lost is found there",
          "[nav440]") {
  UnitBench bench;
  bench.unit.stored_baud = 19200;
  bench.unit.power_cycle();
  bench.options.rate_hz = 100;
  bench.unit.reply_delay = milliseconds{90};  // it comes when nobody listens at that speed yet
  REQUIRE(bench.comes_up());
  CHECK(bench.unit.baud() == 57600);
}

TEST_CASE("nav440 start-up: F7b: any of its replies may be lost", "[nav440]") {
  for (int drops = 2; drops <= 10; ++drops) {
    INFO("each " << drops << "th");
    UnitBench bench{wanted(Nav440Packet::kN1, 20)};
    bench.unit.stored_divider = 2;
    bench.unit.power_cycle();
    bench.unit.drops_reply = drops;
    REQUIRE(bench.comes_up(6.0));
    CHECK(bench.unit.type() == "N1");
    CHECK(bench.unit.divider() == 5);
    CHECK(bench.driver->identity().known);
  }
}

TEST_CASE("nav440 start-up: F7b: a reply that is late is no answer to the next request",
          "[nav440]") {
  for (const int delay_ms : {0, 1, 20, 100, 240, 300, 400, 600}) {
    INFO(delay_ms << " ms");
    UnitBench bench;
    bench.unit.reply_delay = milliseconds{delay_ms};
    REQUIRE(bench.comes_up(10.0));
    CHECK(bench.unit.type() == "A1");
    CHECK(bench.unit.divider() == 2);
    CHECK(bench.driver->identity().serial == 440123456);
  }
}

TEST_CASE("nav440 start-up: a packet that the unit has not is a refused setting", "[nav440]") {
  UnitBench bench{wanted(Nav440Packet::kN1)};
  bench.unit.refuses_type = "N1";
  bench.run(3.0);
  CHECK(bench.samples.empty());
  CHECK(bench.fault() == DeviceFault::kSettingRefused);
  CHECK(bench.disconnected == 0);
  bench.unit.refuses_type.clear();
  REQUIRE(bench.comes_up());
  CHECK(bench.fault() == DeviceFault::kNone);
}

TEST_CASE("nav440 start-up: where nothing was said of the packet, A0 does for A1", "[nav440]") {
  UnitBench bench;
  bench.unit.refuses_type = "A1";
  REQUIRE(bench.comes_up());
  CHECK(bench.unit.type() == "A0");
  CHECK(bench.driver->packet() == nav440::kA0);
}

TEST_CASE("nav440 start-up: another device is refused, and the unit taken when it is there",
          "[nav440]") {
  UnitBench bench;
  bench.unit.is_foreign = true;
  bench.run(3.0);
  CHECK(bench.fault() == DeviceFault::kWrongDevice);
  CHECK(bench.samples.empty());
  CHECK(bench.corrupt == 0);
  bench.unit.is_foreign = false;
  REQUIRE(bench.comes_up());
  CHECK(bench.fault() == DeviceFault::kNone);
}

// Damage can make a small letter of a type's first one.
TEST_CASE("nav440 start-up: one frame of another family does not make another device, two do",
          "[nav440]") {
  for (const int foreign : {1, 2}) {
    INFO(foreign);
    UnitBench bench;
    bench.unit.drops_reply = 1;  // so that what it streams is all that is heard
    int left = foreign;
    bench.unit.damage = [&left](ByteList& frame) {
      if (left > 0) {
        --left;
        frame = frame_of("a1", ByteList(32, 0x3C));
      }
    };
    bench.run(0.04);
    bench.unit.drops_reply = 0;
    CHECK(bench.comes_up(0.9) == (foreign == 1));
    CHECK(bench.fault() == (foreign == 1 ? DeviceFault::kNone : DeviceFault::kWrongDevice));
  }
}

TEST_CASE("nav440 start-up: one that does not say who it is is another device", "[nav440]") {
  UnitBench bench;
  bench.unit.has_identity = false;
  bench.run(2.0);
  CHECK(bench.fault() == DeviceFault::kWrongDevice);
  CHECK(bench.samples.empty());
}

TEST_CASE("nav440 start-up: a version is asked for and not needed", "[nav440]") {
  UnitBench bench;
  bench.unit.has_version = false;
  REQUIRE(bench.comes_up(1.0));
  CHECK(bench.driver->identity().version.major == 0);
}

TEST_CASE("nav440 start-up: S11: a unit that is still waking up is waited for", "[nav440]") {
  UnitBench bench;
  bench.unit.is_dead = true;
  bench.run(1.0);
  CHECK(bench.fault() == DeviceFault::kStarting);
  bench.run(3.0);
  CHECK(bench.fault() == DeviceFault::kNoAnswer);
  CHECK(bench.disconnected == 0);
  bench.unit.is_dead = false;
  REQUIRE(bench.comes_up(4.0));
  CHECK(bench.fault() == DeviceFault::kNone);
}

TEST_CASE("nav440 start-up: S9: what is said at once after a request is heard, a hundred times",
          "[nav440]") {
  for (int i = 0; i < 100; ++i) {
    UnitBench bench;
    bench.unit.reply_delay = std::chrono::microseconds{20 * i};
    REQUIRE(bench.comes_up(0.5));
    CHECK(bench.unit.pings == 1);
    CHECK(bench.unit.sets == 2);
  }
}

TEST_CASE("nav440 start-up: S8: what was said before the connection is not given", "[nav440]") {
  UnitBench bench;
  bench.unit.go_on_to(after(5.0));
  bench.now = after(5.0);
  REQUIRE(bench.comes_up());
  CHECK(bench.samples.front().measured > after(5.0));
}

TEST_CASE("nav440 start-up: S8: what has waited while nobody polled is not given", "[nav440]") {
  UnitBench bench;
  REQUIRE(bench.comes_up());
  bench.run(1.0);
  const std::size_t before = bench.samples.size();
  bench.now += std::chrono::seconds{5};
  const Time resumed = bench.now;
  REQUIRE(bench.comes_up());
  CHECK(bench.samples[before].measured > resumed);
}

TEST_CASE("nav440 start-up: S4: half a frame of one connection is no half of one of the next",
          "[nav440]") {
  UnitBench bench;
  REQUIRE(bench.comes_up());
  const ByteList frame = vector_bytes("A-21");
  const auto send = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      REQUIRE(bench.line->send(frame[i], bench.now));
    }
  };
  bench.unit.is_dead = true;
  bench.run(0.1);
  send(0, 20);
  bench.run(0.05);
  const std::uint64_t frames = bench.driver->counts().framing.frames;
  bench.line->unplug();
  bench.step();
  CHECK(bench.disconnected == 1);
  CHECK(bench.fault() == DeviceFault::kUnplugged);
  bench.line->plug();
  bench.step();
  send(20, frame.size());
  bench.run(0.1);
  CHECK(bench.driver->counts().framing.frames == frames);
  bench.unit.is_dead = false;
  REQUIRE(bench.comes_up());
  CHECK(bench.fault() == DeviceFault::kNone);
}

TEST_CASE("nav440 start-up: without a port it is gone, and says so", "[nav440]") {
  UnitBench bench;
  bench.line->unplug();
  bench.run(0.5);
  CHECK(bench.disconnected == 100);
  CHECK(bench.fault() == DeviceFault::kNoPort);
  bench.line->plug();
  REQUIRE(bench.comes_up());
}

TEST_CASE("nav440 start-up: a line that takes nothing is told, and used when it does", "[nav440]") {
  UnitBench bench;
  bench.unit.is_dead = true;  // it hears nothing either
  bench.run(0.1);
  bench.line->set_outward_room(0);
  bench.run(3.0);
  CHECK(bench.fault() == DeviceFault::kLineFull);
  bench.line->set_outward_room(TimedBytes::kCapacity);
  bench.unit.is_dead = false;
  REQUIRE(bench.comes_up());
}

TEST_CASE("nav440 start-up: U5: a unit that another program set to another speed is found again",
          "[nav440]") {
  UnitBench bench;
  REQUIRE(bench.comes_up());
  bench.run(1.0);
  bench.unit.speak_at(9600);
  bench.run(2.0);
  CHECK(bench.fault() != DeviceFault::kNone);
  REQUIRE(bench.comes_up());
  CHECK(bench.unit.baud() == 57600);
  CHECK(bench.driver->counts().streams == 2);
}

TEST_CASE("nav440 start-up: a unit whose power was gone for a while is set anew", "[nav440]") {
  UnitBench bench;
  bench.unit.stored_baud = 38400;
  bench.unit.stored_type = "N1";
  bench.unit.stored_divider = 5;
  bench.unit.power_cycle();
  REQUIRE(bench.comes_up());
  bench.run(1.0);
  bench.unit.is_dead = true;
  bench.run(0.2);
  const std::size_t before = bench.samples.size();
  bench.run(0.7);
  CHECK(bench.samples.size() == before);
  CHECK(bench.driver->streaming());
  bench.run(0.5);
  CHECK_FALSE(bench.driver->streaming());  // more than a second without a packet
  bench.unit.power_cycle();
  bench.unit.is_dead = false;
  const Time on = bench.now;
  REQUIRE(bench.comes_up());
  CHECK(bench.samples[before].measured > on);
  CHECK(bench.unit.type() == "A1");
}

TEST_CASE("nav440 start-up: a unit that comes back with other packets is set at once", "[nav440]") {
  UnitBench bench;
  bench.unit.stored_type = "N1";
  REQUIRE(bench.comes_up());
  bench.run(0.5);
  bench.unit.power_cycle();
  REQUIRE(bench.comes_up());
  const Time last = bench.samples.back().measured;
  bench.run(0.6);
  CHECK(bench.samples.back().measured > last + milliseconds{400});
  CHECK(bench.unit.type() == "A1");
  CHECK(bench.driver->counts().streams == 2);
}

// Within half a second, where its silence would be noticed after one.
TEST_CASE("nav440 start-up: two packets that nobody asked for cost nothing, a stream of them does",
          "[nav440]") {
  UnitBench bench;
  bench.unit.stored_type = "N1";
  REQUIRE(bench.comes_up());
  bench.run(0.5);
  int others = 2;
  bench.unit.damage = [&others](ByteList& frame) {
    if (others > 0) {
      --others;
      frame = frame_of("N0", ByteList(32, 0));
    }
  };
  const std::size_t before = bench.samples.size();
  bench.run(0.5);
  CHECK(bench.driver->counts().streams == 1);
  CHECK(bench.samples.size() >= before + 22);
  bench.unit.power_cycle();
  REQUIRE(bench.comes_up(0.5));
  CHECK(bench.driver->counts().streams == 2);
  CHECK(bench.unit.type() == "A1");
}

TEST_CASE("nav440 start-up: one that comes back at another rate is set again", "[nav440]") {
  UnitBench bench;
  bench.unit.stored_divider = 1;
  bench.unit.power_cycle();
  REQUIRE(bench.comes_up());
  bench.run(1.0);
  bench.unit.power_cycle();
  bench.run(4.0);
  CHECK(bench.unit.divider() == 2);
  CHECK(bench.fault() == DeviceFault::kNone);
  CHECK(bench.driver->counts().streams == 2);
}

}  // namespace
}  // namespace lodesman::testing
